// The committed folder extension-spec/conformance is what the generator makes, what our decoder
// and validator say of it, and what the specification shows.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <zerotree/zerotree.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "conformance_folder.h"
#include "sample_assets.h"

namespace zerotree::conformance {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kSpec = ZEROTREE_SPEC_DIR;
const fs::path kFolder = kSpec / "conformance";

Bytes read_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in.is_open()) throw std::runtime_error("cannot read " + path.string());
  return {std::istreambuf_iterator<char>(in), {}};
}

json read_json(const fs::path& path) {
  const Bytes bytes = read_file(path);
  return json::parse(bytes.begin(), bytes.end());
}

// What an empty list would make of every loop below.
const json& list_of(const char* name) {
  static const json index = read_json(kFolder / "index.json");
  const json& list = index.at(name);
  if (list.empty()) throw std::runtime_error(std::string("index.json has no ") + name);
  return list;
}

std::vector<std::string> committed_files() {
  std::vector<std::string> paths;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kFolder))
    if (entry.is_regular_file())
      paths.push_back(fs::relative(entry.path(), kFolder).generic_string());
  return paths;
}

TEST(fresh, CommittedFilesAreTheGenerators) {
  const char* const how = "; run: build/release/bin/write_conformance extension-spec/conformance";
  const Folder made = conformance_folder();
  for (const auto& [path, bytes] : made) {
    ASSERT_TRUE(fs::exists(kFolder / path)) << path << " is missing" << how;
    EXPECT_TRUE(read_file(kFolder / path) == bytes) << path << " is another" << how;
  }
  for (const std::string& path : committed_files())
    EXPECT_TRUE(made.contains(path)) << path << " is one too many: remove it";
}

TEST(size, IsBelowTwoMegabytes) {
  std::uintmax_t size = 0;
  for (const std::string& path : committed_files()) size += fs::file_size(kFolder / path);
  EXPECT_GT(size, 100'000u);
  EXPECT_LT(size, 2'000'000u);
}

TEST(example, HexBlockIsTheStream) {
  const Bytes text = read_file(kSpec / "EXAMPLE.md");
  const std::string page(text.begin(), text.end());
  const std::string open = "```hex\n";
  const std::size_t begin = page.find(open);
  ASSERT_NE(begin, std::string::npos) << "EXAMPLE.md has no ```hex block";
  const std::size_t end = page.find("```", begin + open.size());
  ASSERT_NE(end, std::string::npos) << "the ```hex block of EXAMPLE.md does not end";
  std::istringstream block(page.substr(begin + open.size(), end - begin - open.size()));
  Bytes shown;
  for (std::string word; block >> word;) {
    ASSERT_TRUE(word.size() == 2 && word.find_first_not_of("0123456789abcdef") == word.npos)
        << word;
    shown.push_back(static_cast<std::uint8_t>(std::stoi(word, nullptr, 16)));
  }
  EXPECT_EQ(shown, read_file(kFolder / "tetrahedron.zt"));
}

struct FreeDecoder {
  void operator()(zt_decoder* decoder) const { zt_free(decoder); }
};
using Decoder = std::unique_ptr<zt_decoder, FreeDecoder>;

std::vector<float> floats_of(const json& vectors) {
  std::vector<float> values;
  for (const json& vector : vectors)
    for (const json& value : vector) values.push_back(static_cast<float>(value.get<double>()));
  return values;
}

Decoder decoder_for(const json& entry) {
  if (entry["base"].is_null()) return Decoder(zt_create(nullptr));
  const json base = read_json(kFolder / entry["base"].get<std::string>());
  const std::vector<float> positions = floats_of(base["positions"]);
  std::vector<std::uint32_t> indices;
  for (const json& triangle : base["triangles"])
    for (const json& corner : triangle) indices.push_back(corner.get<std::uint32_t>());
  return Decoder(zt_create_for_base(
      positions.data(), 0, static_cast<std::uint32_t>(positions.size() / 3), indices.data(),
      static_cast<std::uint32_t>(indices.size() / 3), entry["levels"].get<int>(), nullptr));
}

constexpr std::size_t kPieces[] = {1, 3, std::size_t{1} << 30};

zt_status feed_in_pieces(zt_decoder* decoder, std::span<const std::uint8_t> bytes,
                         std::size_t piece) {
  for (std::size_t at = 0; at < bytes.size(); at += std::min(piece, bytes.size() - at))
    zt_feed(decoder, bytes.data() + at, std::min(piece, bytes.size() - at));
  return zt_get_status(decoder);
}

// Largest difference of a coordinate over the diagonal of the box of `expected`.
double relative_difference(const std::vector<float>& found, const std::vector<float>& expected) {
  double low[3], high[3], largest = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double value = double{expected[i]};
    low[i % 3] = i < 3 ? value : std::min(low[i % 3], value);
    high[i % 3] = i < 3 ? value : std::max(high[i % 3], value);
    largest = std::max(largest, std::abs(double{found[i]} - value));
  }
  const double diagonal = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  return largest == 0 ? 0 : largest / diagonal;
}

void expect_surface(zt_decoder* decoder, const json& expected, int levels) {
  const std::vector<float> positions = floats_of(expected["positions"]);
  const std::uint32_t count = zt_vertex_count(decoder, levels);
  ASSERT_EQ(count, positions.size() / 3);
  std::vector<float> found(positions.size()), normals(positions.size());
  ASSERT_EQ(zt_reconstruct(decoder, levels, found.data(), 0, normals.data(), 0, count), ZT_OK);
  EXPECT_LT(relative_difference(found, positions), 1e-5);
  if (!expected.contains("normals")) return;
  ASSERT_EQ(expected["normals"].size(), count);
  for (std::size_t v = 0; v < count; ++v) {
    if (expected["normals"][v].is_null()) continue;
    const std::vector<float> normal = floats_of({expected["normals"][v]});
    const float* const n = normals.data() + 3 * v;
    EXPECT_LT(std::hypot(n[0] - normal[0], n[1] - normal[1], n[2] - normal[2]), 1e-3f) << v;
  }
}

TEST(runtime, EveryPrefixDecodesToWhatIsExpected) {
  for (const json& stream : list_of("streams")) {
    const Bytes bytes = read_file(kFolder / stream["file"].get<std::string>());
    ASSERT_FALSE(stream["prefixes"].empty());
    for (const json& prefix : stream["prefixes"]) {
      const std::string name = prefix["expected"];
      const json expected = read_json(kFolder / name);
      for (const std::size_t piece : kPieces) {
        SCOPED_TRACE(name + " in pieces of " + std::to_string(piece));
        const Decoder decoder = decoder_for(stream);
        const zt_status status =
            feed_in_pieces(decoder.get(), std::span(bytes).first(prefix["byteLength"]), piece);
        EXPECT_EQ(status, expected["status"] == "done" ? ZT_DONE : ZT_MORE_BYTES_WANTED);
        if (!expected["positions"].is_null()) {
          expect_surface(decoder.get(), expected, stream["levels"]);
        } else {
          EXPECT_EQ(zt_reconstruct(decoder.get(), 0, nullptr, 0, nullptr, 0, 0), ZT_NOT_READY);
        }
      }
    }
  }
}

// Also where the last bytes decide nothing and the stream is done before they come.
TEST(runtime, PiecesOfAStreamHaveItsLength) {
  for (const json& stream : list_of("streams")) {
    SCOPED_TRACE(stream["name"].get<std::string>());
    const Bytes bytes = read_file(kFolder / stream["file"].get<std::string>());
    std::set<std::uint64_t> lengths;
    for (const std::size_t piece : kPieces) {
      const Decoder decoder = decoder_for(stream);
      feed_in_pieces(decoder.get(), bytes, piece);
      zt_info info;
      zt_get_info(decoder.get(), &info, sizeof info);
      lengths.insert(info.bytes_consumed);
    }
    EXPECT_EQ(lengths.size(), 1u) << *lengths.begin() << " and " << *lengths.rbegin();
  }
}

TEST(runtime, BrokenStreamsAreBrokenForTheReasonStated) {
  for (const json& broken : list_of("broken")) {
    const Bytes bytes = read_file(kFolder / broken["file"].get<std::string>());
    for (const std::size_t piece : kPieces) {
      SCOPED_TRACE(broken["name"].get<std::string>() + " in pieces of " + std::to_string(piece));
      const Decoder decoder = decoder_for(broken);
      EXPECT_EQ(feed_in_pieces(decoder.get(), bytes, piece), ZT_BROKEN);
      EXPECT_EQ(zt_reason(decoder.get()), broken["complaint"].get<std::string>());
    }
  }
}

// The table of section A.8, and what is broken on purpose, name the same rules.
TEST(rules, AreThoseOfTheSpecification) {
  const Bytes text = read_file(kSpec / "BITSTREAM.md");
  std::istringstream page(std::string(text.begin(), text.end()));
  std::set<std::string> stated, broken;
  bool is_there = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## ")) is_there = line.starts_with("## A.8 ");
    const bool is_row = line.starts_with("| A.") || line.starts_with("| README");
    if (is_there && is_row) stated.insert(line.substr(2, line.find(" |", 2) - 2));
  }
  for (const json& entry : list_of("broken")) broken.insert(entry["rule"]);
  EXPECT_EQ(broken, stated);
}

struct Verdict {
  int exit_code = -1;
  std::vector<std::string> codes;
};

Verdict validate(const fs::path& file) {
  const test::TemporaryFolder folder;
  const std::string report = (folder / "report.json").string();
  const std::string command = std::string(ZEROTREE_COMMAND) + " validate \"" + file.string() +
                              "\" -o \"" + report + "\" > /dev/null";
  const int status = std::system(command.c_str());
  Verdict verdict{WIFEXITED(status) ? WEXITSTATUS(status) : -1, {}};
  const json messages = read_json(report)["issues"]["messages"];
  for (const json& message : messages) verdict.codes.push_back(message["code"]);
  return verdict;
}

TEST(validator, FindsExactlyTheCodesListed) {
  for (const json& entry : list_of("files")) {
    SCOPED_TRACE(entry["file"].get<std::string>());
    Verdict found = validate(kFolder / entry["file"].get<std::string>());
    auto codes = entry["codes"].get<std::vector<std::string>>();
    std::sort(codes.begin(), codes.end());
    std::sort(found.codes.begin(), found.codes.end());
    EXPECT_EQ(found.codes, codes);
    EXPECT_EQ(found.exit_code, entry["exit"].get<int>());
  }
}

}  // namespace
}  // namespace zerotree::conformance
