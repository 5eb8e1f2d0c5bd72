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

// Checkpoints by their length, at most `room` of them.
class Checkpoints {
 public:
  Checkpoints(std::uint64_t payload_bytes, std::uint64_t room)
      : payload_bytes_(payload_bytes), room_(room) {}

  bool is_full() const { return by_bytes_.size() >= room_; }
  // Lengths beyond the payload are that of the payload.
  void add(std::uint64_t bytes, std::optional<std::size_t> entry = {}) {
    bytes = std::min(bytes, payload_bytes_);
    const auto found = by_bytes_.find(bytes);
    if (found != by_bytes_.end())
      found->second = found->second ? found->second : entry;
    else if (!is_full())
      by_bytes_[bytes] = entry;
  }
  std::vector<Checkpoint> list() const {
    std::vector<Checkpoint> list;
    for (const auto& [bytes, entry] : by_bytes_) list.push_back({bytes, entry});
    return list;
  }

 private:
  std::uint64_t payload_bytes_, room_;
  std::map<std::uint64_t, std::optional<std::size_t>> by_bytes_;
};

}  // namespace

PrefixPlan plan_prefixes(std::span<const std::uint8_t> payload,
                         std::span<const gltf::PrefixEntry> entries, std::size_t random,
                         std::uint64_t vertices) {
  const std::uint64_t room =
      std::max<std::uint64_t>(1, kMostPlannedVertices / std::max<std::uint64_t>(1, vertices));
  Checkpoints checkpoints(payload.size(), room);
  checkpoints.add(payload.size());
  // From the last entry down, which is the whole payload.
  const std::size_t taken = std::min<std::uint64_t>(entries.size(), room);
  for (std::size_t k = 0; k < taken; ++k) {
    const std::size_t entry = entries.size() - 1 - k * entries.size() / taken;
    checkpoints.add(entries[entry].byte_length, entry);
  }
  checkpoints.add(0);
  std::mt19937_64 generator(seed_of(payload));
  const auto magnitudes = static_cast<std::uint64_t>(std::bit_width(payload.size()));
  for (std::size_t k = 0; k < random && !checkpoints.is_full() && magnitudes > 0; ++k) {
    const std::uint64_t below = std::uint64_t{2} << generator() % magnitudes;
    checkpoints.add(generator() % std::min<std::uint64_t>(payload.size() + 1, below));
  }
  return {checkpoints.list(), entries.size() - taken};
}

}  // namespace zerotree::validate
