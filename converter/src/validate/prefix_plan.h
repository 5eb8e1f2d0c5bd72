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

/// Vertices that the surfaces of a plan have at most, all together; if one surface alone has more,
/// there is only the whole payload.
inline constexpr std::uint64_t kMostPlannedVertices = std::uint64_t{1} << 27;

/// Prefixes of `payload` to decode: all of it, the entries of the table (`entries`, ascending), no
/// byte, and `random` lengths of all magnitudes, in this order of preference as long as the
/// surfaces of `vertices` vertices each keep within kMostPlannedVertices. Of a table too long
/// entries evenly spread are taken. The random lengths depend on the payload's bytes and nothing
/// else. A nanosecond a byte.
PrefixPlan plan_prefixes(std::span<const std::uint8_t> payload,
                         std::span<const gltf::PrefixEntry> entries, std::size_t random,
                         std::uint64_t vertices);

}  // namespace zerotree::validate
