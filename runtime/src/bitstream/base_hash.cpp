#include "bitstream/base_hash.h"

#include <bit>

namespace zerotree::bitstream {
namespace {

class Fnv1a {
 public:
  void add(std::uint32_t word) {
    for (int shift = 0; shift < 32; shift += 8) {
      hash_ = (hash_ ^ ((word >> shift) & 0xffu)) * 0x100000001b3u;
    }
  }
  std::uint32_t folded() const { return static_cast<std::uint32_t>(hash_ ^ (hash_ >> 32)); }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace

std::uint32_t hash_base(const BaseTopology& base, std::span<const float> positions) {
  Fnv1a hash;
  hash.add(base.vertex_count);
  hash.add(static_cast<std::uint32_t>(base.triangles.size()));
  for (const auto& t : base.triangles) {
    for (const std::uint32_t v : t) hash.add(v);
  }
  for (const float x : positions) hash.add(std::bit_cast<std::uint32_t>(x));
  return hash.folded();
}

}  // namespace zerotree::bitstream
