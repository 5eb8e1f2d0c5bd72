#include "conformance_folder.h"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "expected_json.h"

namespace zerotree::conformance {
namespace {

using nlohmann::ordered_json;

constexpr const char* kReadme = R"(# Conformance streams

Small streams of every sort, and what they decode to: with these a decoder of [the
specification](../README.md) can be tested without any other program. All files are made by
`tests/conformance`; nobody edits them.

| file | |
|---|---|
| `index.json` | the list of everything |
| `NAME.zt` | a stream: elementary, or a payload for an external base |
| `NAME.base.json` | an external base: `positions`, `triangles`. Numbers are the shortest decimals that read back as the same f32: read them as double and round to f32 |
| `NAME.BYTES.json` | what the first BYTES bytes of `NAME.zt` decode to |
| `files/` | valid and broken glTF files, for validators |

`index.json` holds three lists.

* **streams**: `name`, `file`, `base` (null, or the file of an external base), `levels` (of an
  external base as the extension object says it, else that of the header), `shows` (what it is there
  for), `prefixes` (`byteLength`, and the file `expected`).
* **broken**: `name`, `file`, `base`, `levels`; `rule`, the rule that the stream breaks, by its name
  in section A.8 of [BITSTREAM.md](../BITSTREAM.md); `complaint`, what this project's decoder says
  of it. A decoder must answer *broken* to each, except where the rule is *A.2 limits* and its
  limits are larger; the wording is its own. `levels` is null where there is no external base.
* **files**: `file`, the `codes` that a validator finds ([VALIDATION.md](../VALIDATION.md), each as
  often as it is found, in any order), and `exit`, the exit code of this project's validator: 1 if
  one of the codes is an error, else 0.

An expected file holds

* `status`: `done` or `more bytes wanted`;
* `base`: null while the bytes do not determine an embedded base, else `positions` (control points
  as far as the bytes determine them), `triangles`, `creases` (numbers of base edges) and `corners`
  (numbers of base vertices). An external base is known at every length, 0 included, and has creases
  and corners when its tags are there;
* `details`: per level `normal`, `tangent1` and `tangent2`, the `value` (section A.5 of
  [BITSTREAM.md](../BITSTREAM.md)) of each cell in order of its index, absent ones included; empty
  where `base` is null or there are no levels;
* `positions`: limit positions at the finest level in the numbering of
  [RECONSTRUCTION.md](../RECONSTRUCTION.md), null where `base` is null;
* `normals`: of some streams; null at creases inside the surface, at corners and where the tangents
  vanish.

Numbers with a fraction are the shortest decimals of f32 values, as in bases. Details are integers
and must be equal, and so must the positions of the base; creases and corners are sets. Positions
may differ from the expected ones by as much as section B.9 of
[RECONSTRUCTION.md](../RECONSTRUCTION.md) says, and so may normals. `all_ones`, `early_end` and
`trailing_bytes` are valid streams that no encoder writes (A.3). The bytes may be fed in pieces of
any size.
)";

Bytes bytes_of(const std::string& text) {
  return {text.begin(), text.end()};
}

class FolderMaker {
 public:
  Folder make() {
    add("README.md", bytes_of(kReadme));
    for (const StreamCase& stream : stream_cases()) add_stream(stream);
    for (const BrokenCase& broken : broken_cases()) add_broken(broken);
    for (const FileCase& file : file_cases()) add_file(file);
    add("index.json", bytes_of("{\"streams\":[" + streams_ + "\n],\n\"broken\":[" + broken_ +
                               "\n],\n\"files\":[" + files_ + "\n]}\n"));
    return std::move(folder_);
  }

 private:
  void add(const std::string& path, Bytes bytes) {
    if (!folder_.emplace(path, std::move(bytes)).second)
      throw std::runtime_error(path + " is made twice");
  }

  // Bases may be shared; the same name must mean the same base.
  ordered_json add_base(const std::optional<Base>& base) {
    if (!base) return nullptr;
    const std::string path = base->name + ".base.json";
    const auto [it, is_new] = folder_.emplace(path, bytes_of(base_json(*base)));
    if (!is_new && it->second != bytes_of(base_json(*base)))
      throw std::runtime_error(path + " is two bases");
    return path;
  }

  static void append(std::string& list, const ordered_json& entry) {
    list.append(list.empty() ? "\n" : ",\n").append(entry.dump());
  }

  void add_stream(const StreamCase& stream) {
    ordered_json entry = {{"name", stream.name},           {"file", stream.name + ".zt"},
                          {"base", add_base(stream.base)}, {"levels", stream.levels},
                          {"shows", stream.shows},         {"prefixes", ordered_json::array()}};
    for (const std::size_t length : stream.prefixes) {
      const std::string path = stream.name + "." + std::to_string(length) + ".json";
      add(path, expected(stream, length, path));
      entry["prefixes"].push_back({{"byteLength", length}, {"expected", path}});
    }
    add(stream.name + ".zt", stream.bytes);
    append(streams_, entry);
  }

  static Bytes expected(const StreamCase& stream, std::size_t length, const std::string& path) {
    try {
      return bytes_of(expected_json(stream, length));
    } catch (const std::exception& error) {
      throw std::runtime_error(path + ": " + error.what());
    }
  }

  void add_broken(const BrokenCase& broken) {
    const std::string complaint = complaint_about(broken);
    if (complaint != broken.complaint)
      throw std::runtime_error(broken.name + ": \"" + complaint + "\" instead of \"" +
                               broken.complaint + "\"");
    const std::string path = "broken-" + broken.name + ".zt";
    add(path, broken.bytes);
    ordered_json entry = {{"name", broken.name}, {"file", path}, {"base", add_base(broken.base)}};
    entry["levels"] = broken.base ? ordered_json(broken.levels) : ordered_json(nullptr);
    entry["rule"] = broken.rule;
    entry["complaint"] = broken.complaint;
    append(broken_, entry);
  }

  void add_file(const FileCase& file) {
    add("files/" + file.name, file.bytes);
    for (const SideFile& side : file.side_files) add("files/" + side.name, side.bytes);
    append(files_,
           {{"file", "files/" + file.name}, {"codes", file.codes}, {"exit", file.exit_code}});
  }

  Folder folder_;
  std::string streams_, broken_, files_;
};

}  // namespace

Folder conformance_folder() {
  return FolderMaker().make();
}

}  // namespace zerotree::conformance
