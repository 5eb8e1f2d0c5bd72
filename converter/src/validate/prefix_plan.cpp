#include "validate/prefix_plan.h"

#include <algorithm>
#include <bit>
#include <map>
#include <random>

namespace zerotree::validate {
namespace {

// FNV-1a: any change of the payload draws other lengths.
std::uint64_t seed_of(std::span<const std::uint8_t> payload) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (std::uint8_t byte : payload) hash = (hash ^ byte) * 0x100000001b3u;
  return hash;
}

// Checkpoints by their length.
class Checkpoints {
 public:
  explicit Checkpoints(std::uint64_t payload_bytes) : payload_bytes_(payload_bytes) {}

  std::size_t size() const { return by_bytes_.size(); }
  // Lengths beyond the payload are that of the payload.
  void add(std::uint64_t bytes, std::optional<std::size_t> entry = {}) {
    bytes = std::min(bytes, payload_bytes_);
    std::optional<std::size_t>& known = by_bytes_[bytes];
    if (!known) known = entry;
  }
  std::vector<Checkpoint> list() const {
    std::vector<Checkpoint> list;
    for (const auto& [bytes, entry] : by_bytes_) list.push_back({bytes, entry});
    return list;
  }

 private:
  std::uint64_t payload_bytes_;
  std::map<std::uint64_t, std::optional<std::size_t>> by_bytes_;
};

}  // namespace

PrefixPlan plan_prefixes(std::span<const std::uint8_t> payload,
                         std::span<const gltf::PrefixEntry> entries, std::size_t random,
                         std::uint64_t cost) {
  const auto room = [&](std::uint64_t most) { return most / std::max<std::uint64_t>(1, cost); };
  Checkpoints checkpoints(payload.size());
  checkpoints.add(payload.size());
  // From the last entry down, which is the whole payload.
  const std::size_t taken =
      std::min<std::uint64_t>(entries.size(), std::max<std::uint64_t>(1, room(kMostTableCost)));
  for (std::size_t k = 0; k < taken; ++k) {
    const std::size_t entry = entries.size() - 1 - k * entries.size() / taken;
    checkpoints.add(entries[entry].byte_length, entry);
  }
  const auto has_room = [&] { return checkpoints.size() < room(kMostCost); };
  if (has_room()) checkpoints.add(0);
  std::mt19937_64 generator(seed_of(payload));
  const auto magnitudes = static_cast<std::uint64_t>(std::bit_width(payload.size()));
  for (std::size_t k = 0; k < random && has_room() && magnitudes > 0; ++k) {
    const std::uint64_t below = std::uint64_t{2} << generator() % magnitudes;
    checkpoints.add(generator() % std::min<std::uint64_t>(payload.size() + 1, below));
  }
  return {checkpoints.list(), entries.size() - taken};
}

}  // namespace zerotree::validate
