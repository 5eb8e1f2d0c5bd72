#include "gltf/packed_view.h"

#include <meshoptimizer.h>

#include <string>

#include "mesh/error.h"

namespace zerotree::gltf {
namespace {

constexpr std::uint64_t kLargestStride = 256;
// Vertices are packed 16 at a time, and each byte of them takes at least two bits for all 16.
constexpr std::uint64_t kMostExpansion = 64;

struct Unpacked {
  std::vector<std::uint8_t> bytes;
  std::uint64_t count = 0, stride = 0;
};

bool decode(const std::string& mode, std::span<const std::uint8_t> packed, Unpacked& out) {
  if (mode == "ATTRIBUTES")
    return out.stride % 4 == 0 &&
           meshopt_decodeVertexBuffer(out.bytes.data(), out.count, out.stride, packed.data(),
                                      packed.size()) == 0;
  if (out.stride != 2 && out.stride != 4) return false;
  if (mode == "TRIANGLES")
    return out.count % 3 == 0 && meshopt_decodeIndexBuffer(out.bytes.data(), out.count, out.stride,
                                                           packed.data(), packed.size()) == 0;
  return mode == "INDICES" && meshopt_decodeIndexSequence(out.bytes.data(), out.count, out.stride,
                                                          packed.data(), packed.size()) == 0;
}

}  // namespace

JsonCursor packing_of(const JsonCursor& view) {
  return view.member("extensions").member(kPackingExtension);
}

std::vector<std::uint8_t> unpack_view(const JsonCursor& packing,
                                      std::span<const std::uint8_t> packed) {
  Unpacked out;
  out.count = packing.member("count").unsigned_integer();
  out.stride = packing.member("byteStride").unsigned_integer();
  const std::string mode = packing.member("mode").string();
  const JsonCursor filter = packing.member("filter");
  if (filter.exists() && filter.string() != "NONE")
    filter.fail(IssueCode::accessor_unsupported, "filters round; a base mesh has none");
  if (out.stride == 0 || out.stride > kLargestStride)
    packing.member("byteStride").fail(IssueCode::value_not_in_range, "1 to 256 bytes are expected");
  // Divided: the product of both may overflow.
  if (out.count == 0 || out.count > kMostExpansion * packed.size() / out.stride)
    packing.member("count").fail(IssueCode::packing_broken,
                                 std::to_string(packed.size()) + " bytes cannot stand for " +
                                     std::to_string(out.count) + " elements of " +
                                     std::to_string(out.stride));
  out.bytes.resize(out.count * out.stride);
  if (!decode(mode, packed, out))
    packing.fail(IssueCode::packing_broken,
                 "mode " + mode + ", " + std::to_string(packed.size()) + " bytes");
  return std::move(out.bytes);
}

std::vector<std::uint8_t> pack_attributes(std::span<const std::uint8_t> data, std::size_t stride) {
  const std::size_t count = data.size() / stride;
  std::vector<std::uint8_t> packed(meshopt_encodeVertexBufferBound(count, stride));
  packed.resize(
      meshopt_encodeVertexBuffer(packed.data(), packed.size(), data.data(), count, stride));
  if (packed.empty()) throw Error(ExitCode::internal, "progressive glTF: vertices do not pack");
  return packed;
}

}  // namespace zerotree::gltf
