#include "surface/quadrature_mirror_filter.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace zerotree::surface {

namespace {

/// Taps over 16 at an end point of the edge, by edge counted counter-clockwise from the 10. The
/// tap opposite the 10 is one vertex at valence 6 and two half taps elsewhere.
struct FanTap {
  int offset;
  float weight;
};
constexpr std::array<FanTap, 6> kFanTaps = {
    {{1, 6.0f}, {2, -2.0f}, {3, 0.5f}, {-3, 0.5f}, {-2, 2.0f}, {-1, -6.0f}}};
constexpr float kCentre = 10.0f, kEndPoint = -6.0f, kOpposite = -2.0f, kBeside = 1.0f;
constexpr float kCurveCentre = 12.0f, kCurveEndPoint = -8.0f, kCurveNext = 2.0f;

/// The taps of one detail; taps that fall on the same vertex add up.
class Taps {
 public:
  void clear() {
    vertices_.clear();
    weights_.clear();
  }
  void add(int vertex, float weight) {
    const auto key = static_cast<std::uint32_t>(vertex);
    const auto found = std::find(vertices_.begin(), vertices_.end(), key);
    if (found != vertices_.end()) {
      weights_[static_cast<std::size_t>(found - vertices_.begin())] += weight / 16.0f;
    } else {
      vertices_.push_back(key);
      weights_.push_back(weight / 16.0f);
    }
  }
  void append_to(SharedStencilBuilder& builder) const { builder.add_row(vertices_, weights_); }

 private:
  std::vector<std::uint32_t> vertices_;
  std::vector<float> weights_;
};

class FilterBuilder {
 public:
  explicit FilterBuilder(const RefinerLevel& level)
      : level_(level), first_odd_(level.GetNumVertices()) {}

  SharedStencils build() {
    SharedStencilBuilder builder;
    builder.reserve(static_cast<std::size_t>(level_.GetNumEdges()), 19);
    for (int edge = 0; edge < level_.GetNumEdges(); ++edge) {
      taps_.clear();
      if (is_sharp(level_, edge))
        add_curve_taps(edge);
      else
        add_surface_taps(edge);
      taps_.append_to(builder);
    }
    return builder.take();
  }

 private:
  void add_odd(int edge, float weight) { taps_.add(first_odd_ + edge, weight); }

  void add_surface_taps(int edge) {
    add_odd(edge, kCentre);
    for (const int end : level_.GetEdgeVertices(edge)) {
      taps_.add(end, kEndPoint);
      add_fan_taps(edge, end);
    }
    const auto faces = level_.GetEdgeFaces(edge);
    const auto locals = level_.GetEdgeFaceLocalIndices(edge);
    for (int side = 0; side < faces.size(); ++side) add_opposite_taps(faces[side], locals[side]);
  }

  /// Taps on the odd vertices around an end point. The fan ends at sharp edges and reflects there.
  void add_fan_taps(int edge, int end) {
    const auto fan = level_.GetVertexEdges(end);
    const int valence = fan.size();
    const int here = static_cast<int>(std::find(fan.begin(), fan.end(), edge) - fan.begin());
    const bool is_closed = count_sharp(fan) < 2 && !level_.IsVertexBoundary(end);
    if (is_closed) {
      for (const FanTap& tap : kFanTaps)
        add_odd(fan[(here + tap.offset + 6 * valence) % valence], tap.weight);
      return;
    }
    int before = 0, after = 0;
    while (!is_sharp(level_, fan[(here - before + valence) % valence])) ++before;
    while (!is_sharp(level_, fan[(here + after) % valence])) ++after;
    const int sector = before + after;
    for (const FanTap& tap : kFanTaps) {
      int place = (before + tap.offset + 6 * sector) % (2 * sector);
      if (place > sector) place = 2 * sector - place;
      add_odd(fan[(here - before + place + valence) % valence], tap.weight);
    }
  }

  /// Taps on the vertex opposite the edge in `face` and on the two edges beside it there.
  void add_opposite_taps(int face, int local) {
    taps_.add(level_.GetFaceVertices(face)[(local + 2) % 3], kOpposite);
    for (const int turn : {1, 2}) {
      const int side = level_.GetFaceEdges(face)[(local + turn) % 3];
      if (is_sharp(level_, side)) {
        // Reflected at the sharp side, the edge beyond it is the face's third edge.
        add_odd(level_.GetFaceEdges(face)[(local + 3 - turn) % 3], kBeside);
        continue;
      }
      const auto faces = level_.GetEdgeFaces(side);
      const int other = faces[0] == face ? 1 : 0;
      const int back = level_.GetEdgeFaceLocalIndices(side)[other];
      add_odd(level_.GetFaceEdges(faces[other])[(back + 3 - turn) % 3], kBeside);
    }
  }

  void add_curve_taps(int edge) {
    add_odd(edge, kCurveCentre);
    for (const int end : level_.GetEdgeVertices(edge)) {
      taps_.add(end, kCurveEndPoint);
      const auto fan = level_.GetVertexEdges(end);
      const auto on_curve = [&](int other) { return other != edge && is_sharp(level_, other); };
      const bool is_crease = level_.GetVertexRule(end) == OpenSubdiv::Sdc::Crease::RULE_CREASE;
      // Where the curve ends, in a corner or a dart, it reflects onto the edge itself.
      const auto next = std::find_if(fan.begin(), fan.end(), on_curve);
      add_odd(is_crease && next != fan.end() ? *next : edge, kCurveNext);
    }
  }

  int count_sharp(const OpenSubdiv::Far::ConstIndexArray& fan) const {
    return static_cast<int>(
        std::count_if(fan.begin(), fan.end(), [&](int edge) { return is_sharp(level_, edge); }));
  }

  const RefinerLevel& level_;
  const int first_odd_;
  Taps taps_;
};

}  // namespace

SharedStencils quadrature_mirror_stencils(const RefinerLevel& level) {
  return FilterBuilder(level).build();
}

}  // namespace zerotree::surface
