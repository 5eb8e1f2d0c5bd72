// What encoder and decoder know about every detail while coding, and what follows from it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory_resource>
#include <vector>

#include "bitstream/base_edges.h"
#include "bitstream/cell_blocks.h"
#include "bitstream/coefficient_layout.h"
#include "bitstream/edge_image.h"
#include "bitstream/level_values.h"
#include "bitstream/raw_memory.h"
#include "bitstream/stream_header.h"

namespace zerotree::bitstream {

/// Coding state of one channel of one level, indexed by cell within the level, in whole blocks: the
/// cells that fill the last one are absent.
struct ChannelCells {
  std::uint8_t* flags = nullptr;
  /// Significant coefficients around: edges of the same small triangles and the six closest
  /// parallel ones (and two farther ones).
  std::uint8_t* around = nullptr;
  /// Significance of the parent and of the other channels of the same edge.
  std::uint8_t* above = nullptr;
  /// Expected sign; normal channel only, null otherwise.
  std::int8_t* lean = nullptr;
  /// Per block, whether one of its cells has been significant or next to one that was. In a block
  /// that has not been touched everything is zero but the flags of absent cells.
  std::uint8_t* touched = nullptr;
};

/// Neighbourhood sums are kept up to date by scattering: a coefficient that becomes significant
/// adds to its neighbours' sums, which is rare; gathering would cost at every decision.
///
/// All memory is taken at once but written level by level: a level costs nothing before something
/// in it becomes significant, or next to it or above. Only widened values take memory later.
class DetailState {
 public:
  DetailState() = default;
  /// `planes` is that of the header. The numbering must be valid.
  DetailState(const BaseEdges& base, int levels, int planes = kMostPlanes,
              std::pmr::memory_resource* resource = std::pmr::new_delete_resource());

  int levels() const { return static_cast<int>(levels_.size()); }
  std::size_t base_edge_count() const { return sides_.size(); }
  /// First cell of a level in a CoefficientSet.
  std::size_t level_begin(int level) const { return level_offset(base_edge_count(), level); }
  std::size_t level_size(int level) const { return base_edge_count() << (2 * level); }
  std::size_t block_count(int level) const {
    return (level_size(level) + kBlockCells - 1) / kBlockCells;
  }

  /// So many levels of a channel, from the coarsest one on, have a state that can be read. In the
  /// others every cell is as at the beginning.
  int active_levels(int c) const { return active_levels_[c]; }
  /// Makes `level` and all coarser ones active.
  void activate(int c, int level) {
    while (active_levels_[c] <= level) write_level(c, active_levels_[c]++);
  }
  /// The state of an active level.
  const ChannelCells& cells(int c, int level) const { return levels_[level].cells[c]; }

  /// Something in the level has become significant. Otherwise all its values are zero and must
  /// not be read.
  bool has_details(int c, int level) const { return ((detailed_[c] >> level) & 1) != 0; }
  const LevelValues& values(int c, int level) const { return levels_[level].values[c]; }
  LevelValues& values(int c, int level) { return levels_[level].values[c]; }
  std::int32_t value(int c, int level, std::size_t index) const {
    return has_details(c, level) ? values(c, level).get(index) : 0;
  }
  /// Copy of all values.
  CoefficientSet coefficients() const;

  /// One more than the finest level that has details in some channel.
  int detailed_levels() const;
  /// The lowest level with a value that has changed since `forget_changes`; INT_MAX if none has.
  int changed_from() const { return changed_from_; }
  void forget_changes() { changed_from_ = std::numeric_limits<int>::max(); }
  /// The caller has changed values of `level`.
  void note_change(int level) { changed_from_ = std::min(changed_from_, level); }

  /// Doubles the sums, which count in sixteenths of the plane's threshold, and forgets which cells
  /// have been visited.
  void begin_plane();
  /// Finds the closed cells of all channels and levels but the finest, where they are those with
  /// any flag.
  void begin_cleanup();
  /// A cell of `level` is closed if it has one of these flags.
  std::uint8_t closed_flags(int level) const {
    return level + 1 == levels() ? kSignificant | kVisited | kAbsent : kClosed | kAbsent;
  }
  /// Cell `index` of `level`, which is active, becomes significant in bit plane `plane`.
  void set_significant(int c, int level, std::size_t index, int plane, bool negative);

  /// Most memory that a state of this size ever takes, in bytes.
  static std::uint64_t memory(std::uint64_t base_edge_count, int levels, int planes = kMostPlanes);

 private:
  // One side of a base edge: the numbers of the two base edges that come after this one in its
  // face, each with the side on which it sees that face in bit 0.
  struct Side {
    std::array<std::uint32_t, 2> next;
    bool exists() const { return next[0] != kNone; }
  };
  struct SmallTriangle;
  struct Level {
    RawMemory memory;
    std::array<ChannelCells, kChannelCount> cells;
    std::array<LevelValues, kChannelCount> values;
  };

  void number_sides(const BaseEdges& base);
  void allocate(Level& level, int number, bool wide, std::pmr::memory_resource* resource);
  void write_level(int c, int level);
  void mark_absent(int level, std::uint8_t* flags) const;
  void set_value(int c, int level, std::size_t index, int plane, bool negative);
  template <bool kNormalChannel>
  void scatter_to_triangle(const ChannelCells& cells, int level, const Side& side,
                           const SmallTriangle& triangle, int sign);
  template <bool kNormalChannel>
  void scatter(const ChannelCells& cells, int level, std::size_t index, int sign);

  std::pmr::vector<std::array<Side, 2>> sides_;
  std::pmr::vector<Level> levels_;
  std::array<int, kChannelCount> active_levels_{};
  std::array<std::uint32_t, kChannelCount> detailed_{};  // bit per level
  int changed_from_ = std::numeric_limits<int>::max();
};

}  // namespace zerotree::bitstream
