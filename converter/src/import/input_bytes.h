// A whole input file in memory, gunzipped if need be.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>

namespace zerotree::importer {

/// A file's content and the name it has in messages.
struct InputBytes {
  std::filesystem::path path;
  /// The file's name as the user gave it.
  std::string name;
  /// Lower-case extension without ".gz": ".ply".
  std::string extension;
  std::string bytes;
};

/// Reads `path`; a gzip stream is unpacked, whatever the file is called. Throws
/// Error(unreadable_input) if the file cannot be read, is empty, is damaged, or holds more than
/// `max_bytes` before or after unpacking.
InputBytes read_input(const std::filesystem::path& path, std::uint64_t max_bytes);

/// The bytes of the file `path`, as they are, empty or not; `name` is what messages call it.
std::string read_whole_file(const std::filesystem::path& path, const std::string& name,
                            std::uint64_t max_bytes);

/// The T whose bytes lie at `from`, in the byte order told; `from` needs no alignment.
template <class T>
T load_scalar(const char* from, bool big_endian) {
  char bytes[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes[i] = from[big_endian ? sizeof(T) - 1 - i : i];
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

}  // namespace zerotree::importer
