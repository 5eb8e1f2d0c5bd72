// What encoder and decoder know about every detail while coding, and what follows from it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bitstream/base_edges.h"
#include "bitstream/coefficient_layout.h"
#include "bitstream/edge_image.h"

namespace zerotree::bitstream {

/// Bits of a cell's flags. A cell with none can become significant in the current pass.
enum CellFlag : std::uint8_t {
  kSignificant = 1,
  kVisited = 2,  ///< coded in this bit plane
  kAbsent = 4,   ///< beyond a boundary
};

/// Coding state of one channel, indexed like the coefficients.
struct ChannelState {
  std::vector<std::uint8_t> flags;
  /// Significant coefficients around: edges of the same small triangles and the six closest
  /// parallel ones (and two farther ones).
  std::vector<std::uint8_t> around;
  /// Significance of the parent and of the other channels of the same edge.
  std::vector<std::uint8_t> above;
  /// Expected sign; normal channel only, empty otherwise.
  std::vector<std::int8_t> lean;
  /// In the cleanup pass: this cell or one below it is still to be coded.
  std::vector<std::uint8_t> open;
};

/// Neighbourhood sums are kept up to date by scattering: a coefficient that becomes significant
/// adds to its neighbours' sums, which is rare; gathering would cost at every decision.
class DetailState {
 public:
  DetailState() = default;
  /// Takes about 9 bytes per channel and cell. The numbering must be valid.
  DetailState(const BaseEdges& base, int levels);

  int levels() const { return coefficients_.levels; }
  std::size_t base_edge_count() const { return sides_.size(); }
  std::size_t level_begin(int level) const { return level_offset(base_edge_count(), level); }
  std::size_t level_size(int level) const { return base_edge_count() << (2 * level); }
  const CoefficientSet& coefficients() const { return coefficients_; }
  ChannelState& channel(int c) { return channels_[c]; }
  const ChannelState& channel(int c) const { return channels_[c]; }
  std::int32_t value(int c, std::size_t cell) const { return coefficients_.channels[c][cell]; }
  int detailed_levels() const { return detailed_levels_; }

  /// Doubles the sums, which count in sixteenths of the plane's threshold, and forgets which cells
  /// have been visited.
  void begin_plane();
  /// Fills `open` of all channels.
  void begin_cleanup();
  /// Cell `index` of `level` becomes significant in bit plane `plane`.
  void set_significant(int c, int level, std::size_t index, int plane, bool negative);
  /// The cell's bit of `plane` becomes known.
  void refine(int c, std::size_t cell, int plane, bool bit) {
    std::int32_t& v = coefficients_.channels[c][cell];
    const std::int32_t half = std::int32_t{1} << plane;
    v += (v < 0) == bit ? -half : half;
  }

  /// Memory that a state of this size takes, in bytes.
  static std::uint64_t memory(std::uint64_t base_edge_count, int levels);

 private:
  // One side of a base edge: the numbers of the base edges of its face, counted from this one, each
  // with the side on which it sees that face in bit 0.
  struct Side {
    std::array<std::uint32_t, 3> edges;
    bool exists;
  };

  void mark_absent();
  void scatter_to_faces(int c, int level, const EdgeCell& cell, int sign);
  void scatter_to_triangle(int c, int level, const Side& side, std::array<std::uint32_t, 3> corner,
                           std::uint32_t row_offset, int sign);
  void scatter_to_ring(int c, int level, const EdgeCell& cell, int sign);

  CoefficientSet coefficients_;
  std::array<ChannelState, kChannelCount> channels_;
  std::vector<std::array<Side, 2>> sides_;
  int detailed_levels_ = 0;
};

}  // namespace zerotree::bitstream
