#include "encode/header_writer.h"

#include <bit>
#include <cstddef>
#include <utility>

namespace zerotree::encode {
namespace {

class FieldWriter {
 public:
  void byte(std::uint8_t value) { bytes_.push_back(value); }
  template <class Word>
  void word(Word value) {
    for (std::size_t i = 0; i < sizeof(Word); ++i) {
      byte(static_cast<std::uint8_t>((value >> (8 * i)) & 0xff));
    }
  }
  void real(float value) { word(std::bit_cast<std::uint32_t>(value)); }
  void varint(std::uint32_t value) {
    for (; value > 0x7f; value >>= 7) byte(static_cast<std::uint8_t>((value & 0x7f) | 0x80));
    byte(static_cast<std::uint8_t>(value));
  }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

std::vector<std::uint8_t> write_header(const bitstream::StreamHeader& header) {
  FieldWriter out;
  for (const std::uint8_t letter : bitstream::kMagic) out.byte(letter);
  out.byte(bitstream::kFormatVersion);
  out.byte(static_cast<std::uint8_t>((header.external_base ? bitstream::kFlagExternalBase : 0) |
                                     (header.has_sharp_tags ? bitstream::kFlagSharpTags : 0)));
  out.varint(header.transform);
  out.varint(static_cast<std::uint32_t>(header.levels));
  out.varint(header.vertex_count);
  out.varint(header.face_count);
  out.varint(static_cast<std::uint32_t>(header.planes));
  out.real(header.finest_step);
  out.varint(static_cast<std::uint32_t>(header.tangent_ratio_log2));
  if (header.external_base) {
    out.word(header.base_hash);
    return out.take();
  }
  for (const float x : header.positions.origin) out.real(x);
  out.real(header.positions.scale);
  out.varint(static_cast<std::uint32_t>(header.positions.bits));
  out.varint(static_cast<std::uint32_t>(header.positions.initial_planes));
  out.varint(header.connectivity_bytes);
  return out.take();
}

}  // namespace zerotree::encode
