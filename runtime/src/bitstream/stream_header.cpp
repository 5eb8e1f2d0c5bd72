#include "bitstream/stream_header.h"

#include <bit>
#include <cmath>

#include "bitstream/coefficient_layout.h"
#include "bitstream/detail_state.h"

namespace zerotree::bitstream {
namespace {

/// Reads little-endian fields; after the first that does not fit into what is there `short_` is
/// set and every field reads as zero.
class FieldReader {
 public:
  explicit FieldReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint8_t byte() {
    if (next_ >= bytes_.size()) {
      short_ = true;
      return 0;
    }
    return bytes_[next_++];
  }
  template <class Word>
  Word word() {
    Word value = 0;
    for (std::size_t i = 0; i < sizeof(Word); ++i) {
      value = static_cast<Word>(value | (static_cast<Word>(byte()) << (8 * i)));
    }
    return short_ ? Word{0} : value;
  }
  float real() { return std::bit_cast<float>(word<std::uint32_t>()); }
  /// Seven bits a byte, low ones first, the top bit says that more follow; at most 32 bits and in
  /// the shortest form.
  std::uint32_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 35; shift += 7) {
      const std::uint8_t b = byte();
      value |= static_cast<std::uint64_t>(b & 0x7f) << shift;
      if ((b & 0x80) != 0) continue;
      if (value > 0xffffffffu || (b == 0 && shift > 0 && !short_)) malformed_ = true;
      return short_ ? 0 : static_cast<std::uint32_t>(value);
    }
    malformed_ = true;
    return 0;
  }

  bool is_short() const { return short_; }
  bool malformed() const { return malformed_; }
  std::size_t size() const { return next_; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t next_ = 0;
  bool short_ = false;
  bool malformed_ = false;
};

HeaderResult broken(const char* reason) {
  return {DecodeStatus::broken, reason, 0};
}

bool in_range(std::uint32_t value, int low, int high) {
  return value >= static_cast<std::uint32_t>(low) && value <= static_cast<std::uint32_t>(high);
}

bool positive(float x) {
  return std::isfinite(x) && x > 0.0f;
}

// Triangles, edges and the lists that number them, roughly.
constexpr std::uint64_t kBaseBytesPerFace = 200;

/// Empty, or what is wrong with counts that are within the format's own ranges.
const char* check_size(const StreamHeader& header, const Limits& limits) {
  if (header.levels > limits.max_levels) return "the stream has more levels than the limit";
  // Every edge has one or two faces, and every vertex is on a face.
  const std::uint64_t fewest_edges = (std::uint64_t{header.face_count} * 3 + 1) / 2;
  if (header.vertex_count > std::uint64_t{header.face_count} * 3) {
    return "the header has more base vertices than base faces can use";
  }
  if (header.vertex_count + fewest_edges * cells_below(header.levels) > limits.max_vertices) {
    return "the stream has more vertices than the limit";
  }
  if (header.face_count * kBaseBytesPerFace + DetailState::memory(fewest_edges, header.levels) >
      limits.max_memory) {
    return "the stream needs more memory than the limit";
  }
  return nullptr;
}

const char* read_embedded(FieldReader& in, StreamHeader& header) {
  PositionQuantisation& positions = header.positions;
  for (float& x : positions.origin) x = in.real();
  positions.scale = in.real();
  const std::uint32_t bits = in.varint(), initial = in.varint();
  header.connectivity_bytes = in.varint();
  if (in.is_short()) return nullptr;
  for (const float x : positions.origin) {
    if (!std::isfinite(x)) return "the header's origin is not finite";
  }
  if (!positive(positions.scale)) return "the header's position scale is not positive";
  if (!in_range(bits, 1, kMostPositionBits)) return "the header's position bits are out of range";
  if (initial > bits) return "the header has more initial planes than position bits";
  if (header.connectivity_bytes == 0) return "the header's connectivity is empty";
  positions.bits = static_cast<int>(bits);
  positions.initial_planes = static_cast<int>(initial);
  return nullptr;
}

const char* read_common(FieldReader& in, StreamHeader& header) {
  header.transform = in.varint();
  const std::uint32_t levels = in.varint();
  header.vertex_count = in.varint();
  header.face_count = in.varint();
  const std::uint32_t planes = in.varint();
  header.finest_step = in.real();
  const std::uint32_t ratio = in.varint();
  if (in.is_short()) return nullptr;
  if (!in_range(levels, 0, kMostLevels)) return "the header's levels are out of range";
  if (header.vertex_count < 3) return "the header has fewer than 3 base vertices";
  if (!in_range(header.face_count, 1, 0x3fffffff)) return "the header's face count is out of range";
  if (!in_range(planes, 0, kMostPlanes)) return "the header's bit planes are out of range";
  if (levels == 0 && planes != 0) return "the header has bit planes but no levels";
  if (!positive(header.finest_step)) return "the header's finest step is not positive";
  if (!in_range(ratio, 0, kMostTangentRatioLog2)) {
    return "the header's tangential ratio is out of range";
  }
  header.levels = static_cast<int>(levels);
  header.planes = static_cast<int>(planes);
  header.tangent_ratio_log2 = static_cast<int>(ratio);
  return nullptr;
}

const char* read_fields(FieldReader& in, StreamHeader& header) {
  for (const std::uint8_t letter : kMagic) {
    if (in.byte() != letter && !in.is_short()) return "this is not a Zerotree stream";
  }
  const std::uint8_t version = in.byte(), flags = in.byte();
  if (in.is_short()) return nullptr;
  if (version != kFormatVersion) return "the stream has a format version this reader lacks";
  if ((flags & ~(kFlagExternalBase | kFlagSharpTags)) != 0) return "the header has unknown flags";
  header.external_base = (flags & kFlagExternalBase) != 0;
  header.has_sharp_tags = (flags & kFlagSharpTags) != 0;
  if (const char* problem = read_common(in, header)) return problem;
  if (!header.external_base) return read_embedded(in, header);
  header.base_hash = in.word<std::uint64_t>();
  return nullptr;
}

}  // namespace

HeaderResult read_header(std::span<const std::uint8_t> bytes, const Limits& limits,
                         StreamHeader& header) {
  header = {};
  FieldReader in(bytes);
  const char* problem = read_fields(in, header);
  if (problem != nullptr) return broken(problem);
  if (in.malformed()) return broken("the header has a malformed number");
  if (in.is_short()) return {};
  problem = check_size(header, limits);
  if (problem != nullptr) return broken(problem);
  return {DecodeStatus::done, {}, in.size()};
}

}  // namespace zerotree::bitstream
