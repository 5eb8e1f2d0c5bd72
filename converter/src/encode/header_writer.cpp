#include "encode/header_writer.h"

#include <bit>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace zerotree::encode {
namespace {

constexpr int kScaleCodes = 256;

class FieldWriter {
 public:
  void byte(std::uint8_t value) { bytes_.push_back(value); }
  template <class Word>
  void word(Word value) {
    for (std::size_t i = 0; i < sizeof(Word); ++i) {
      byte(static_cast<std::uint8_t>((value >> (8 * i)) & 0xff));
    }
  }
  void varint(std::uint64_t value) {
    for (; value > 0x7f; value >>= 7) byte(static_cast<std::uint8_t>((value & 0x7f) | 0x80));
    byte(static_cast<std::uint8_t>(value));
  }
  void signed_varint(std::int64_t value) {
    const auto twice = static_cast<std::uint64_t>(value) << 1;
    varint(value < 0 ? ~twice : twice);
  }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
};

std::uint16_t upper_half(float step) {
  const auto bits = std::bit_cast<std::uint32_t>(step);
  if ((bits & 0xffffu) != 0) throw std::invalid_argument("write_header: the step is not storable");
  return static_cast<std::uint16_t>(bits >> 16);
}

std::uint8_t code_of_scale(const bitstream::StreamHeader& header) {
  for (int code = 0; code < kScaleCodes; ++code) {
    const auto byte = static_cast<std::uint8_t>(code);
    if (bitstream::scale_of(header.finest_step, byte) == header.positions.scale) return byte;
  }
  throw std::invalid_argument("write_header: the position scale is not storable");
}

std::uint8_t kind(const bitstream::StreamHeader& header) {
  const unsigned transform = header.transform << bitstream::kTransformShift;
  return static_cast<std::uint8_t>(
      bitstream::kFormatVersion | (header.external_base ? bitstream::kFlagExternalBase : 0) |
      (header.has_sharp_tags ? bitstream::kFlagSharpTags : 0) | transform);
}

}  // namespace

float storable_step(double step) {
  const auto single = static_cast<float>(step);
  if (!(single > 0.0f)) return 0.0f;
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(single) & 0xffff0000u);
}

float storable_scale(float finest_step, double length) {
  int code = kScaleCodes - 1;
  const auto scale = [&] {
    return bitstream::scale_of(finest_step, static_cast<std::uint8_t>(code));
  };
  while (code > 0 && !(double{scale()} <= length)) --code;
  return scale();
}

std::vector<std::uint8_t> write_header(const bitstream::StreamHeader& header) {
  FieldWriter out;
  for (const std::uint8_t letter : bitstream::kMagic) out.byte(letter);
  out.byte(kind(header));
  out.byte(static_cast<std::uint8_t>(header.levels | header.tangent_ratio_log2 << 4));
  const bitstream::PositionQuantisation& positions = header.positions;
  if (header.external_base) {
    out.byte(static_cast<std::uint8_t>(header.planes));
  } else {
    out.word(static_cast<std::uint16_t>(header.planes | positions.bits << 5 |
                                        positions.initial_planes << 10));
  }
  out.word(upper_half(header.finest_step));
  if (header.external_base) {
    out.word(header.base_hash);
    return out.take();
  }
  out.byte(code_of_scale(header));
  for (const std::int32_t x : positions.origin) out.signed_varint(x);
  out.varint(header.vertex_count);
  out.signed_varint(std::int64_t{header.face_count} - 2 * std::int64_t{header.vertex_count} + 4);
  return out.take();
}

}  // namespace zerotree::encode
