// The feature curves of a mesh by their length.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "domain/domain.h"
#include "relax/surface_walk.h"

namespace zerotree::test {

/// Places on the feature curves of a mesh. A curve runs from one vertex that is no `chain` to the
/// next one, or is closed.
class InputCurves {
 public:
  /// Refers to the parts of the surface.
  InputCurves(const relax::InputSurface& surface, const std::vector<domain::VertexKind>& kinds);

  /// The length of all curves.
  double length() const { return length_; }
  /// How far two points lie apart along a curve that both lie on, the shorter way if it is closed;
  /// none if there is no such curve.
  std::optional<double> distance(const relax::SurfacePoint& a, const relax::SurfacePoint& b) const;

 private:
  struct Place {
    std::size_t curve;
    double at;
  };
  std::vector<Place> places_of(const relax::SurfacePoint& point) const;
  void trace(std::uint32_t start, std::uint32_t next, const std::vector<domain::VertexKind>& kinds);

  using Edge = std::array<std::uint32_t, 2>;
  relax::InputSurface surface_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> neighbours_;
  // Of each edge (lower, higher vertex) its curve and the places of its ends there.
  std::map<Edge, std::pair<Place, double>> edges_;
  std::vector<double> lengths_;
  std::vector<bool> is_closed_;
  double length_ = 0;
};

}  // namespace zerotree::test
