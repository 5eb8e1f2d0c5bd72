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

std::string chunk_name(std::uint32_t type) {
  if (type == kJsonChunk) return "the JSON chunk";
  return type == kBinaryChunk ? "the binary chunk" : "a chunk of type " + std::to_string(type);
}

// Walks through the chunks as glTF-Validator does: a defect is noted and the walk goes on.
class ChunkReader {
 public:
  ChunkReader(std::span<const std::uint8_t> file, Issues& issues) : file_(file), issues_(issues) {}

  GlbChunks read() {
    read_header();
    chunks_.is_truncated = file_.size() < length_;
    std::size_t at = kHeaderSize;
    for (int index = 0; at != file_.size(); ++index) {
      if (at == length_) {
        add(IssueCode::glb_extra_data, std::to_string(file_.size() - at) + " bytes");
        break;
      }
      if (file_.size() - at < kChunkHeaderSize) {
        add(IssueCode::glb_unexpected_end_of_chunk_header, "at byte " + std::to_string(at));
        break;
      }
      at = read_chunk(at, index);
    }
    if (at == file_.size() && !ends_inside_chunk_ && at != length_)
      add(IssueCode::glb_length_mismatch,
          std::to_string(at) + " bytes instead of " + std::to_string(length_));
    if (!has_json_) throw IssueFound(last_error());
    return chunks_;
  }

 private:
  void read_header() {
    if (file_.size() < kHeaderSize)
      fail(IssueCode::glb_unexpected_end_of_header,
           "it has " + std::to_string(file_.size()) + " bytes");
    if (read_u32(file_, 4) != 2)
      fail(IssueCode::glb_invalid_version, "version " + std::to_string(read_u32(file_, 4)));
    length_ = read_u32(file_, 8);
    if (length_ <= kHeaderSize)
      add(IssueCode::glb_length_too_small, std::to_string(length_) + " bytes");
  }

  // Returns where the next chunk begins.
  std::size_t read_chunk(std::size_t at, int index) {
    const std::uint64_t length = read_u32(file_, at);
    const std::uint32_t type = read_u32(file_, at + 4);
    const std::string what = chunk_name(type) + ", " + std::to_string(length) + " bytes";
    at += kChunkHeaderSize;
    if (padding_of(length) != 0) add(IssueCode::glb_chunk_length_unaligned, what);
    if (at + length > length_) add(IssueCode::glb_chunk_too_big, what);
    if (index == 0 && type != kJsonChunk) add(IssueCode::glb_unexpected_first_chunk, what);
    if (index > 1 && type == kBinaryChunk && !chunks_.has_binary)
      add(IssueCode::glb_unexpected_bin_chunk, what);
    const auto data = file_.subspan(at, std::min<std::uint64_t>(length, file_.size() - at));
    if (data.size() < length) {
      ends_inside_chunk_ = true;
      add(IssueCode::glb_unexpected_end_of_chunk_data,
          what + ", of which " + std::to_string(data.size()) + " are there");
    }
    take_chunk(type, length, data, what);
    return at + data.size();
  }

  void take_chunk(std::uint32_t type, std::uint64_t length, std::span<const std::uint8_t> data,
                  const std::string& what) {
    if (type != kJsonChunk && type != kBinaryChunk) {
      add(IssueCode::glb_unknown_chunk_type, what);
      return;
    }
    if (type == kJsonChunk && length == 0) add(IssueCode::glb_empty_chunk, what);
    bool& has_one = type == kJsonChunk ? has_json_ : chunks_.has_binary;
    if (has_one) {
      add(IssueCode::glb_duplicate_chunk, what);
      return;
    }
    // JSON that is cut off cannot be read.
    if (type == kJsonChunk && data.size() < length) return;
    has_one = true;
    if (type == kBinaryChunk) {
      chunks_.binary = data;
      chunks_.binary_length = length;
    } else {
      chunks_.json = {reinterpret_cast<const char*>(data.data()), data.size()};
    }
  }

  // Once per code: a hostile file may consist of nothing but bad chunks.
  void add(IssueCode code, std::string detail) {
    for (const Issue& issue : issues_)
      if (issue.code == code) return;
    issues_.push_back({code, "", std::move(detail)});
  }

  // It goes on its way as an exception, so it must not be in the list, too.
  Issue last_error() {
    for (std::size_t i = issues_.size(); i-- > 0;)
      if (is_error(issues_[i])) {
        Issue issue = issues_[i];
        issues_.erase(issues_.begin() + static_cast<std::ptrdiff_t>(i));
        return issue;
      }
    return {IssueCode::glb_unexpected_end_of_chunk_header, "", "there is no JSON chunk"};
  }

  std::span<const std::uint8_t> file_;
  Issues& issues_;
  GlbChunks chunks_;
  std::uint64_t length_ = 0;
  bool has_json_ = false, ends_inside_chunk_ = false;
};

}  // namespace

bool is_glb(std::span<const std::uint8_t> file) {
  return file.size() >= 4 && read_u32(file, 0) == kMagic;
}

GlbChunks split_glb(std::span<const std::uint8_t> file, Issues& issues) {
  return ChunkReader(file, issues).read();
}

GlbChunks split_glb(std::span<const std::uint8_t> file) {
  Issues issues;
  const GlbChunks chunks = split_glb(file, issues);
  const Issue* wrong = first_error(issues);
  if (wrong != nullptr && !chunks.is_truncated) throw IssueFound(*wrong);
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
