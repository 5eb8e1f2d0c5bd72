// GLB containers that are not as they should be: each defect has its code.
#include <gtest/gtest.h>

#include <string>

#include "gltf/glb_container.h"
#include "gltf/gltf_document.h"
#include "gltf/progressive_writer.h"
#include "sample_assets.h"

namespace zerotree::gltf {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;

void append(Bytes& bytes, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8)
    bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

void put(Bytes& bytes, std::size_t at, std::uint32_t value) {
  Bytes four;
  append(four, value);
  std::copy(four.begin(), four.end(), bytes.begin() + std::ptrdiff_t(at));
}

void append_chunk(Bytes& bytes, std::uint32_t type, std::uint32_t length) {
  append(bytes, length);
  append(bytes, type);
  bytes.resize(bytes.size() + length, type == kJson ? ' ' : 0);
  put(bytes, 8, static_cast<std::uint32_t>(bytes.size()));
}

// JSON in 28 bytes from byte 20 on, 8 bytes of data from byte 56 on.
Bytes small_glb() {
  const std::string json = R"({"asset":{"version":"2.0"}} )";
  Bytes bytes = glb_head(json, 8);
  bytes.resize(bytes.size() + 8);
  return bytes;
}

// Codes in their order; the one that ends the reading comes last.
std::vector<std::string> codes(const Bytes& bytes) {
  Issues issues;
  std::vector<std::string> ids;
  try {
    GltfDocument("a.glb", bytes, issues);
  } catch (const IssueFound& found) {
    issues.push_back(found.issue());
  }
  for (const Issue& issue : issues) {
    EXPECT_EQ(issue.pointer, "");
    ids.push_back(issue_text(issue.code).id);
  }
  return ids;
}

using Ids = std::vector<std::string>;

TEST(HostileGlb, TheSmallOneIsRight) {
  EXPECT_EQ(small_glb().size(), 64u);
  EXPECT_EQ(codes(small_glb()), Ids{});
}

TEST(HostileGlb, HeaderDefectsHaveCodes) {
  const auto changed = [](std::size_t at, std::uint32_t value) {
    Bytes bytes = small_glb();
    put(bytes, at, value);
    return codes(bytes);
  };
  EXPECT_EQ(changed(4, 1), Ids{"GLB_INVALID_VERSION"});
  EXPECT_EQ(changed(8, 12), (Ids{"GLB_EXTRA_DATA", "GLB_LENGTH_TOO_SMALL"}));
  EXPECT_EQ(changed(8, 60), (Ids{"GLB_CHUNK_TOO_BIG", "GLB_LENGTH_MISMATCH"}));
  EXPECT_EQ(changed(8, 68), Ids{"GLB_LENGTH_MISMATCH"});
  EXPECT_EQ(changed(12, 1 << 30), (Ids{"GLB_CHUNK_TOO_BIG", "GLB_UNEXPECTED_END_OF_CHUNK_DATA"}));
  EXPECT_EQ(changed(48, 4), Ids{"GLB_UNEXPECTED_END_OF_CHUNK_HEADER"});
  EXPECT_EQ(changed(48, 12), (Ids{"GLB_CHUNK_TOO_BIG", "GLB_UNEXPECTED_END_OF_CHUNK_DATA"}));
  EXPECT_EQ(changed(16, 0), (Ids{"GLB_UNKNOWN_CHUNK_TYPE", "GLB_UNEXPECTED_FIRST_CHUNK"}));
  EXPECT_EQ(changed(52, kJson), Ids{"GLB_DUPLICATE_CHUNK"});
  EXPECT_EQ(changed(52, 0), Ids{"GLB_UNKNOWN_CHUNK_TYPE"});
}

TEST(HostileGlb, ChunksBeyondTheTwoHaveCodes) {
  Bytes bytes = small_glb();
  append_chunk(bytes, 7, 4);
  EXPECT_EQ(codes(bytes), Ids{"GLB_UNKNOWN_CHUNK_TYPE"});
  append_chunk(bytes, kBinary, 4);
  EXPECT_EQ(codes(bytes), (Ids{"GLB_UNKNOWN_CHUNK_TYPE", "GLB_DUPLICATE_CHUNK"}));
  bytes = small_glb();
  bytes.resize(48);
  append_chunk(bytes, 7, 4);
  append_chunk(bytes, kBinary, 4);
  EXPECT_EQ(codes(bytes), (Ids{"GLB_UNKNOWN_CHUNK_TYPE", "GLB_UNEXPECTED_BIN_CHUNK"}));
  bytes = small_glb();
  bytes.push_back(0);
  EXPECT_EQ(codes(bytes), Ids{"GLB_EXTRA_DATA"});
  bytes = small_glb();
  append_chunk(bytes, 7, 3);
  EXPECT_EQ(codes(bytes), (Ids{"GLB_CHUNK_LENGTH_UNALIGNED", "GLB_UNKNOWN_CHUNK_TYPE"}));
}

TEST(HostileGlb, AnEmptyJsonChunkIsNamed) {
  Bytes bytes = glb_head("", 0);
  EXPECT_EQ(codes(bytes), (Ids{"GLB_EMPTY_CHUNK", "INVALID_JSON"}));
}

TEST(HostileGlb, EveryCutHasACode) {
  const Bytes whole = small_glb();
  for (std::size_t length = 4; length < whole.size(); ++length) {
    const Ids found = codes({whole.begin(), whole.begin() + std::ptrdiff_t(length)});
    const char* expected = length < 12                    ? "GLB_UNEXPECTED_END_OF_HEADER"
                           : length == 12 || length == 48 ? "GLB_LENGTH_MISMATCH"
                           : length < 20 || (length > 48 && length < 56)
                               ? "GLB_UNEXPECTED_END_OF_CHUNK_HEADER"
                               : "GLB_UNEXPECTED_END_OF_CHUNK_DATA";
    EXPECT_EQ(found, Ids{expected}) << length;
  }
}

// A file of nothing but bad chunks must not fill memory with issues.
TEST(HostileGlb, ManyBadChunksAreOneIssueOfEachKind) {
  Bytes bytes = small_glb();
  for (int i = 0; i < 100000; ++i) append_chunk(bytes, 7, 0);
  EXPECT_EQ(codes(bytes), Ids{"GLB_UNKNOWN_CHUNK_TYPE"});
}

// What decodes a file takes one that is cut off, and nothing else that is wrong.
TEST(HostileGlb, ReadersRefuseAllButCuts) {
  Bytes bytes = small_glb();
  bytes.resize(60);
  EXPECT_TRUE(GltfDocument("a.glb", bytes).is_truncated());
  bytes = small_glb();
  append_chunk(bytes, kBinary, 4);
  EXPECT_THROW(GltfDocument("a.glb", bytes), IssueFound);
}

}  // namespace
}  // namespace zerotree::gltf
