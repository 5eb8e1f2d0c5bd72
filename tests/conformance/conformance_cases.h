// What extension-spec/conformance holds: streams, streams that are broken, and glTF files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bitstream/base_topology.h"

namespace zerotree::conformance {

using Bytes = std::vector<std::uint8_t>;

/// A base mesh that a stream is bound to.
struct Base {
  std::string name;
  bitstream::BaseTopology topology;  ///< without tags: these are the stream's
  std::vector<float> positions;      ///< x, y, z per vertex
};

/// A valid stream and the prefixes of which the folder holds what they decode to.
struct StreamCase {
  std::string name;
  std::vector<std::string> shows;
  int levels = 0;
  std::optional<Base> base;  ///< none: embedded
  Bytes bytes;
  std::vector<std::size_t> prefixes;  ///< lengths, ascending
  bool with_normals = false;
};

/// A stream that every decoder must call broken.
struct BrokenCase {
  std::string name;
  std::string rule;       ///< the place of the specification that it breaks
  std::string complaint;  ///< what our decoder says, exactly
  std::optional<Base> base;
  int levels = 0;  ///< with a base only
  Bytes bytes;
};

/// A file that comes with a glTF file, such as a buffer of its own.
struct SideFile {
  std::string name;
  Bytes bytes;
};

/// A file for validators.
struct FileCase {
  std::string name;                ///< in the folder files/
  std::vector<std::string> codes;  ///< each as often as it is found; any order
  int exit_code = 0;               ///< of `zerotree validate`
  Bytes bytes;
  std::vector<SideFile> side_files;
};

std::vector<StreamCase> stream_cases();
std::vector<BrokenCase> broken_cases();
std::vector<FileCase> file_cases();

}  // namespace zerotree::conformance
