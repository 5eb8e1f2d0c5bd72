// The header of a PLY file: what its elements and properties are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace zerotree::importer {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of a binary value of `type`.
std::size_t ply_type_size(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  /// Type of a list's length.
  PlyType count_type = PlyType::uint8;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyEncoding { ascii, little_endian, big_endian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  /// Where the data begins: byte, and line for ASCII.
  std::size_t data_offset = 0;
  std::size_t data_line = 1;
};

/// Reads the header at the beginning of `bytes` and checks every element's count against the bytes
/// that follow. Throws Error(unreadable_input) with the line.
PlyHeader read_ply_header(const std::string& bytes, const std::string& file);

}  // namespace zerotree::importer
