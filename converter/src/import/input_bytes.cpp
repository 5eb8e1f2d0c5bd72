#include "import/input_bytes.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <fstream>

#include "import/import_error.h"

namespace zerotree::importer {
namespace {

static_assert(std::endian::native == std::endian::little, "load_scalar assumes little endian");

std::string too_large(std::uint64_t max_bytes) {
  return "holds more than " + std::to_string(max_bytes >> 20) +
         " MiB; raise the limit or simplify the mesh first";
}

bool is_gzip(const std::string& bytes) {
  return bytes.size() > 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b';
}

// Owns zlib's state, also when a refusal is thrown.
struct Inflater {
  z_stream state{};
  Inflater() { inflateInit2(&state, 15 + 16); }  // 16: a gzip header is expected
  ~Inflater() { inflateEnd(&state); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
};

std::string gunzip(const std::string& packed, const std::string& name, std::uint64_t max_bytes) {
  Inflater inflater;
  z_stream& state = inflater.state;
  std::string bytes;
  std::size_t written = 0, fed = 0;
  int status = Z_OK;
  while (status != Z_STREAM_END) {
    if (state.avail_in == 0) {  // zlib counts input in 32 bits
      const std::size_t piece = std::min<std::size_t>(packed.size() - fed, 1u << 30);
      state.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + fed));
      state.avail_in = static_cast<uInt>(piece);
      fed += piece;
    }
    if (written == bytes.size()) bytes.resize(std::max<std::size_t>(1 << 16, bytes.size() * 2));
    const std::size_t room = std::min<std::size_t>(bytes.size() - written, 1u << 30);
    state.next_out = reinterpret_cast<Bytef*>(bytes.data() + written);
    state.avail_out = static_cast<uInt>(room);
    status = inflate(&state, Z_NO_FLUSH);
    written += room - state.avail_out;
    const std::size_t place = fed - state.avail_in;
    if (status == Z_BUF_ERROR)
      refuse_at_byte(name, place, "the gzip stream ends early; fetch or pack the file again");
    if (status != Z_OK && status != Z_STREAM_END)
      refuse_at_byte(name, place, "the gzip stream is damaged; fetch or pack the file again");
    if (written > max_bytes) refuse(name, too_large(max_bytes));
  }
  bytes.resize(written);
  return bytes;
}

std::string lower_case_extension(std::filesystem::path path) {
  if (path.extension() == ".gz") path.replace_extension();
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

}  // namespace

std::string read_whole_file(const std::filesystem::path& path, const std::string& name,
                            std::uint64_t max_bytes) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) refuse(name, "no such file; check the path");
  if (!std::filesystem::is_regular_file(path, error))
    refuse(name, "is not a file; give the path of a mesh file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  std::ifstream stream(path, std::ios::binary);
  if (error || !stream) refuse(name, "cannot be opened; check its permissions");
  if (size > max_bytes) refuse(name, too_large(max_bytes));
  std::string bytes(static_cast<std::size_t>(size), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (static_cast<std::uintmax_t>(stream.gcount()) != size)
    refuse_at_byte(name, static_cast<std::size_t>(stream.gcount()),
                   "reading stopped early; check the disk");
  return bytes;
}

InputBytes read_input(const std::filesystem::path& path, std::uint64_t max_bytes) {
  InputBytes input;
  input.path = path;
  input.name = path.string();
  input.extension = lower_case_extension(path);
  input.bytes = read_whole_file(path, input.name, max_bytes);
  if (is_gzip(input.bytes)) input.bytes = gunzip(input.bytes, input.name, max_bytes);
  if (input.bytes.empty()) refuse(input.name, "the file is empty; export the mesh again");
  return input;
}

}  // namespace zerotree::importer
