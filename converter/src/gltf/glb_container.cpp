#include "gltf/glb_container.h"

#include <algorithm>
#include <limits>
#include <string>

#include "gltf/json_cursor.h"
#include "mesh/error.h"

namespace zerotree::gltf {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;        // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;  // "BIN\0"
constexpr std::size_t kHeaderSize = 12;
constexpr std::size_t kChunkHeaderSize = 8;

std::uint32_t read_u32(std::span<const std::uint8_t> bytes, std::size_t at) {
  return bytes[at] | std::uint32_t{bytes[at + 1]} << 8 | std::uint32_t{bytes[at + 2]} << 16 |
         std::uint32_t{bytes[at + 3]} << 24;
}

void append_u32(std::vector<std::uint8_t>& bytes, std::uint64_t value) {
  for (int shift = 0; shift < 32; shift += 8)
    bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

[[noreturn]] void fail(IssueCode code, const std::string& detail) {
  throw IssueFound({code, "", detail});
}

std::uint64_t padding_of(std::uint64_t length) {
  return (4 - length % 4) % 4;
}

}  // namespace

bool is_glb(std::span<const std::uint8_t> file) {
  return file.size() >= 4 && read_u32(file, 0) == kMagic;
}

GlbChunks split_glb(std::span<const std::uint8_t> file) {
  if (file.size() < kHeaderSize + kChunkHeaderSize)
    fail(IssueCode::glb_truncated,
         "it ends inside its header, at byte " + std::to_string(file.size()));
  if (read_u32(file, 4) != 2)
    fail(IssueCode::glb_malformed,
         "container version " + std::to_string(read_u32(file, 4)) + " instead of 2");
  const std::uint64_t length = read_u32(file, 8);
  const std::uint64_t json_end = kHeaderSize + kChunkHeaderSize + read_u32(file, 12);
  if (read_u32(file, 16) != kJsonChunk)
    fail(IssueCode::glb_malformed, "the first chunk is not JSON");
  if (json_end > length) fail(IssueCode::glb_malformed, "the JSON chunk is longer than the file");
  if (json_end > file.size())
    fail(IssueCode::glb_truncated, "it has " + std::to_string(file.size()) + " of the " +
                                       std::to_string(json_end) + " bytes up to the end of JSON");
  GlbChunks chunks;
  chunks.is_truncated = file.size() < length;
  // Bytes beyond the stated length are not part of the container.
  file = file.first(static_cast<std::size_t>(std::min<std::uint64_t>(length, file.size())));
  const std::size_t json_begin = kHeaderSize + kChunkHeaderSize;
  chunks.json = {reinterpret_cast<const char*>(file.data()) + json_begin,
                 static_cast<std::size_t>(json_end) - json_begin};
  if (file.size() < json_end + kChunkHeaderSize) return chunks;
  if (read_u32(file, json_end + 4) != kBinaryChunk) return chunks;
  chunks.binary_length = read_u32(file, json_end);
  if (json_end + kChunkHeaderSize + chunks.binary_length > length)
    fail(IssueCode::glb_malformed, "the binary chunk is longer than the file");
  const auto rest = file.subspan(json_end + kChunkHeaderSize);
  chunks.binary = rest.first(std::min<std::size_t>(rest.size(), chunks.binary_length));
  return chunks;
}

std::vector<std::uint8_t> glb_head(std::string_view json, std::uint64_t binary_length) {
  const std::uint64_t json_length = json.size() + padding_of(json.size());
  const std::uint64_t padded_binary = binary_length + padding_of(binary_length);
  const std::uint64_t length = kHeaderSize + 2 * kChunkHeaderSize + json_length + padded_binary;
  if (length > std::numeric_limits<std::uint32_t>::max())
    throw Error(ExitCode::target_not_reachable,
                "a GLB file holds at most 4 GiB: write the payload beside it with --split");
  std::vector<std::uint8_t> head;
  append_u32(head, kMagic);
  append_u32(head, 2);
  append_u32(head, length);
  append_u32(head, json_length);
  append_u32(head, kJsonChunk);
  head.insert(head.end(), json.begin(), json.end());
  head.insert(head.end(), padding_of(json.size()), ' ');
  append_u32(head, padded_binary);
  append_u32(head, kBinaryChunk);
  return head;
}

}  // namespace zerotree::gltf
