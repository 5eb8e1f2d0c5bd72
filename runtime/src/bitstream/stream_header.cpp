#include "bitstream/stream_header.h"

#include <bit>
#include <cmath>
#include <limits>
#include <utility>

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
  /// The upper half of a float.
  float half() {
    return std::bit_cast<float>(static_cast<std::uint32_t>(word<std::uint16_t>()) << 16);
  }
  /// Seven bits a byte, low ones first, the top bit says that more follow; at most five bytes and
  /// in the shortest form.
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 35; shift += 7) {
      const std::uint8_t b = byte();
      value |= static_cast<std::uint64_t>(b & 0x7f) << shift;
      if ((b & 0x80) != 0) continue;
      if (b == 0 && shift > 0 && !short_) malformed_ = true;
      return short_ ? 0 : value;
    }
    malformed_ = true;
    return 0;
  }
  /// Numbers near 0 of either sign: 0, -1, 1, -2 ... as 0, 1, 2, 3 ...
  std::int64_t signed_varint() {
    const std::uint64_t folded = varint();
    const auto half_way = static_cast<std::int64_t>(folded >> 1);
    return (folded & 1) != 0 ? -half_way - 1 : half_way;
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

HeaderResult broken(std::string reason) {
  return {DecodeStatus::broken, std::move(reason), 0};
}

template <class Integer>
bool in_range(Integer value, std::int64_t low, std::int64_t high) {
  return static_cast<std::int64_t>(value) >= low && static_cast<std::int64_t>(value) <= high;
}

bool positive(float x) {
  return std::isfinite(x) && x > 0.0f;
}

// Triangles, edges and the lists that number them, roughly.
constexpr std::uint64_t kBaseBytesPerFace = 200;

/// Whether no coordinate in the cube is beyond the floats.
bool is_finite(const PositionQuantisation& positions) {
  double farthest = 0.0;
  for (const std::int32_t x : positions.origin)
    farthest = std::max(farthest, std::abs(static_cast<double>(x)));
  const double units =
      std::ldexp(farthest + 1.0, origin_shift(positions.bits)) + std::ldexp(1.0, positions.bits);
  return units * double{positions.scale} <= double{std::numeric_limits<float>::max()};
}

const char* read_counts(FieldReader& in, StreamHeader& header) {
  const std::uint64_t vertices = in.varint();
  const std::int64_t excess_faces = in.signed_varint();
  if (in.is_short() || in.malformed()) return nullptr;
  // A closed base without handles has 2 V - 4 faces.
  const std::int64_t faces = 2 * static_cast<std::int64_t>(vertices) - 4 + excess_faces;
  if (!in_range(faces, 1, kMostFaces)) return "the header's face count is out of range";
  if (vertices < 3) return "the header has fewer than 3 base vertices";
  if (!in_range(vertices, 3, 3 * faces)) {
    return "the header has more base vertices than base faces can use";
  }
  header.vertex_count = static_cast<std::uint32_t>(vertices);
  header.face_count = static_cast<std::uint32_t>(faces);
  return nullptr;
}

const char* read_embedded(FieldReader& in, StreamHeader& header) {
  PositionQuantisation& positions = header.positions;
  positions.scale = scale_of(header.finest_step, in.byte());
  for (std::int32_t& x : positions.origin) {
    const std::int64_t units = in.signed_varint();
    if (!in_range(units, std::numeric_limits<std::int32_t>::min(),
                  std::numeric_limits<std::int32_t>::max())) {
      return "the header's origin is out of range";
    }
    x = static_cast<std::int32_t>(units);
  }
  if (in.is_short() || in.malformed()) return nullptr;
  if (!positive(positions.scale)) return "the header's position scale is out of range";
  if (!is_finite(positions)) return "the header's positions are not finite";
  return read_counts(in, header);
}

// Planes of the details and, of an embedded base, of its positions: five bits each.
const char* read_plane_counts(FieldReader& in, StreamHeader& header) {
  const std::uint16_t packed = header.external_base ? in.byte() : in.word<std::uint16_t>();
  if (in.is_short()) return nullptr;
  header.planes = packed & 31;
  header.positions.bits = (packed >> 5) & 31;
  header.positions.initial_planes = packed >> 10;
  if (header.planes > kMostPlanes) return "the header's bit planes are out of range";
  if (header.levels == 0 && header.planes != 0) return "the header has bit planes but no levels";
  if (header.external_base) {
    return packed > 31 ? "the header has position planes but no base" : nullptr;
  }
  if (!in_range(header.positions.bits, 1, kMostPositionBits)) {
    return "the header's position bits are out of range";
  }
  if (header.positions.initial_planes > header.positions.bits) {
    return "the header has more initial planes than position bits";
  }
  return nullptr;
}

const char* read_fields(FieldReader& in, StreamHeader& header) {
  for (const std::uint8_t letter : kMagic) {
    if (in.byte() != letter && !in.is_short()) return "this is not a Zerotree stream";
  }
  const std::uint8_t kind = in.byte();
  if (in.is_short()) return nullptr;
  if ((kind & kVersionMask) != kFormatVersion) {
    return "the stream has a format version this reader lacks";
  }
  header.external_base = (kind & kFlagExternalBase) != 0;
  header.has_sharp_tags = (kind & kFlagSharpTags) != 0;
  header.transform = kind >> kTransformShift;
  const std::uint8_t depth = in.byte();
  header.levels = depth & 15;
  header.tangent_ratio_log2 = depth >> 4;
  if (header.levels > kMostLevels) return "the header's levels are out of range";
  if (const char* problem = read_plane_counts(in, header)) return problem;
  header.finest_step = in.half();
  if (in.is_short()) return nullptr;
  if (!positive(header.finest_step)) return "the header's finest step is not positive";
  if (!header.external_base) return read_embedded(in, header);
  header.base_hash = in.word<std::uint32_t>();
  return nullptr;
}

}  // namespace

float scale_of(float finest_step, std::uint8_t code) {
  return static_cast<float>(std::ldexp(double{finest_step} * (4 + code % 4), code / 4 - 34));
}

std::string check_size(const StreamHeader& header, const Limits& limits) {
  if (header.levels > limits.max_levels) return "the stream has more levels than the limit";
  // Every edge has one or two faces.
  const std::uint64_t fewest_edges = (std::uint64_t{header.face_count} * 3 + 1) / 2;
  if (header.vertex_count + fewest_edges * cells_below(header.levels) > limits.max_vertices) {
    return "the stream has more vertices than the limit";
  }
  if (header.face_count * kBaseBytesPerFace +
          DetailState::memory(fewest_edges, header.levels, header.planes) >
      limits.max_memory) {
    return "the stream needs more memory than the limit";
  }
  return {};
}

HeaderResult read_header(std::span<const std::uint8_t> bytes, const Limits& limits,
                         StreamHeader& header) {
  header = {};
  FieldReader in(bytes);
  const char* problem = read_fields(in, header);
  if (problem != nullptr) return broken(problem);
  if (in.malformed()) return broken("the header has a malformed number");
  if (in.is_short()) return {};
  std::string beyond = check_size(header, limits);
  if (!beyond.empty()) return broken(std::move(beyond));
  return {DecodeStatus::done, {}, in.size()};
}

}  // namespace zerotree::bitstream
