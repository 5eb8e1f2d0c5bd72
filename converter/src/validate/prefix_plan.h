// Which prefixes of a payload a validator decodes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gltf/progressive_asset.h"

namespace zerotree::validate {

/// A prefix whose surface is looked at.
struct Checkpoint {
  std::uint64_t bytes = 0;
  /// Its entry in the prefixes table; empty for a prefix the table does not list.
  std::optional<std::size_t> entry;
};

struct PrefixPlan {
  /// Strictly ascending in bytes; the whole payload is the last one.
  std::vector<Checkpoint> checkpoints;
  /// Entries of the table that were left out to bound the time.
  std::size_t entries_left_out = 0;
};

/// What looking at one surface costs, in vertices of a finest level far from the base: base
/// vertices are made one by one, and cost about 12 times as much as others.
constexpr std::uint64_t surface_cost(std::uint64_t base_vertices, std::uint64_t finest_vertices) {
  return finest_vertices + 12 * base_vertices;
}

/// What all surfaces of a plan cost at most: those of the table, and all together before another is
/// added to these. About ten seconds and five, on one thread.
inline constexpr std::uint64_t kMostTableCost = std::uint64_t{1} << 28;
inline constexpr std::uint64_t kMostCost = std::uint64_t{1} << 27;

/// Prefixes of `payload` to decode: all of it, the entries of the table (`entries`, ascending), no
/// byte, and `random` lengths of all magnitudes, in this order of preference as long as surfaces of
/// this `cost` each keep within the limits above. Of a table too long entries evenly spread are
/// taken. The random lengths depend on the payload's bytes and nothing else. A nanosecond a byte.
PrefixPlan plan_prefixes(std::span<const std::uint8_t> payload,
                         std::span<const gltf::PrefixEntry> entries, std::size_t random,
                         std::uint64_t cost);

}  // namespace zerotree::validate
