#include "bitstream/detail_state.h"

#include <bit>
#include <cstring>

namespace zerotree::bitstream {
namespace {

constexpr std::size_t kBytesPerBlock = kBlockCells * (3 * kChannelCount + 1) + kChannelCount;

// Where bit planes are many, the coarse levels, which hold the large details, begin wide.
bool begins_wide(int level, int levels, int planes) {
  return planes > LevelValues::kNarrowPlanes && level <= levels - 3;
}

}  // namespace

DetailState::DetailState(const BaseEdges& base, int levels, int planes,
                         std::pmr::memory_resource* resource)
    : sides_(base.edges.size(), resource), levels_(resource) {
  number_sides(base);
  levels_.resize(levels);
  for (int level = 0; level < levels; ++level) {
    allocate(levels_[level], level, begins_wide(level, levels, planes), resource);
  }
}

void DetailState::number_sides(const BaseEdges& base) {
  const auto edge_and_side = [&](std::uint32_t face, int local) {
    const std::uint32_t e = base.face_edges[face][local];
    const bool first = base.edges[e].faces[0] == face && base.edges[e].local[0] == local;
    return (e << 1) | (first ? 0u : 1u);
  };
  for (std::size_t e = 0; e < base.edges.size(); ++e) {
    for (int s = 0; s < 2; ++s) {
      const std::uint32_t face = base.edges[e].faces[s];
      sides_[e][s].next = {kNone, kNone};
      for (int j = 0; j < 2 && face != kNone; ++j) {
        sides_[e][s].next[j] = edge_and_side(face, (base.edges[e].local[s] + j + 1) % 3);
      }
    }
  }
}

void DetailState::allocate(Level& level, int number, bool wide,
                           std::pmr::memory_resource* resource) {
  const std::size_t blocks = block_count(number);
  level.memory = RawMemory(blocks * kBytesPerBlock, resource);
  auto* next = static_cast<std::uint8_t*>(level.memory.data());
  const auto take = [&next](std::size_t size) { return std::exchange(next, next + size); };
  for (int c = 0; c < kChannelCount; ++c) {
    ChannelCells& cells = level.cells[c];
    for (std::uint8_t** bytes : {&cells.flags, &cells.around, &cells.above}) {
      *bytes = take(blocks * kBlockCells);
    }
    if (c == kNormal) cells.lean = reinterpret_cast<std::int8_t*>(take(blocks * kBlockCells));
    level.values[c] = LevelValues(level_size(number), wide, resource);
  }
  for (ChannelCells& cells : level.cells) cells.touched = take(blocks);
}

std::uint64_t DetailState::memory(std::uint64_t base_edge_count, int levels, int planes) {
  const bool may_widen = planes > LevelValues::kNarrowPlanes;
  std::uint64_t bytes = base_edge_count * sizeof(std::array<Side, 2>) + levels * sizeof(Level);
  for (int level = 0; level < levels; ++level) {
    const std::uint64_t size = base_edge_count << (2 * level);
    bytes += (size + kBlockCells - 1) / kBlockCells * kBytesPerBlock;
    bytes += size * kChannelCount * (may_widen ? sizeof(std::int32_t) : sizeof(std::int16_t));
    // While values are widened, both sorts are there.
    if (may_widen && level + 1 == levels) bytes += size * sizeof(std::int16_t);
  }
  return bytes;
}

void DetailState::write_level(int c, int level) {
  const ChannelCells& cells = levels_[level].cells[c];
  const std::size_t blocks = block_count(level);
  for (std::uint8_t* bytes : {cells.flags, cells.around, cells.above}) {
    std::memset(bytes, 0, blocks * kBlockCells);
  }
  if (cells.lean != nullptr) std::memset(cells.lean, 0, blocks * kBlockCells);
  std::memset(cells.touched, 0, blocks);
  mark_absent(level, cells.flags);
}

void DetailState::mark_absent(int level, std::uint8_t* flags) const {
  const std::size_t size = level_size(level);
  std::fill(flags + size, flags + block_count(level) * kBlockCells, kAbsent);
  const std::size_t image = std::size_t{1} << (2 * level);
  for (std::size_t e = 0; e < sides_.size(); ++e) {
    if (sides_[e][1].exists()) continue;
    for (std::size_t i = e * image; i < (e + 1) * image; ++i) {
      const SpreadCell cell = spread_cell_at(level, i);
      if (cell.p < cell.q) flags[i] = kAbsent;
    }
  }
}

void DetailState::begin_plane() {
  for (int c = 0; c < kChannelCount; ++c) {
    for (int level = 0; level < active_levels(c); ++level) {
      const ChannelCells cells = levels_[level].cells[c];
      const std::size_t blocks = block_count(level);
      for (std::size_t block = 0; block < blocks; ++block) {
        if (cells.touched[block] == 0) continue;
        const std::size_t begin = block * kBlockCells;
        forget_visits(cells.flags + begin);
        double_sums(cells.around + begin);
        double_sums(cells.above + begin);
        if (cells.lean != nullptr) double_leans(cells.lean + begin);
      }
    }
  }
}

void DetailState::begin_cleanup() {
  for (int c = 0; c < kChannelCount; ++c) {
    // Below the last active level everything is open, so it has no closed cell but absent ones.
    for (int level = active_levels(c) - 2; level >= 0; --level) {
      const ChannelCells cells = levels_[level].cells[c];
      const std::uint8_t* children = levels_[level + 1].cells[c].flags;
      const std::size_t blocks = block_count(level);
      for (std::size_t block = 0; block < blocks; ++block) {
        if (cells.touched[block] == 0) continue;
        const std::size_t begin = block * kBlockCells;
        close_cells(cells.flags + begin, children + 4 * begin,
                    std::min(kBlockCells, level_size(level) - begin), closed_flags(level + 1));
      }
    }
  }
}

CoefficientSet DetailState::coefficients() const {
  CoefficientSet set{base_edge_count(), levels(), {}};
  for (int c = 0; c < kChannelCount; ++c) {
    set.channels[c].assign(level_begin(levels()), 0);
    for (int level = 0; level < levels(); ++level) {
      if (!has_details(c, level)) continue;
      std::int32_t* target = set.channels[c].data() + level_begin(level);
      const LevelValues& values = levels_[level].values[c];
      for (std::size_t i = 0; i < level_size(level); ++i) target[i] = values.get(i);
    }
  }
  return set;
}

int DetailState::detailed_levels() const {
  return static_cast<int>(std::bit_width(detailed_[0] | detailed_[1] | detailed_[2]));
}

}  // namespace zerotree::bitstream
