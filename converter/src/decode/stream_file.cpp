#include "decode/stream_file.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <system_error>

#include "bitstream/stream_header.h"
#include "gltf/progressive_reader.h"
#include "mesh/error.h"

namespace zerotree::decode {
namespace {

std::ifstream open_bytes(const std::filesystem::path& path) {
  std::error_code error;
  const bool is_file = std::filesystem::is_regular_file(path, error);
  std::ifstream in(path, std::ios::binary);
  if (!is_file || !in)
    throw Error(ExitCode::unreadable_input,
                path.string() + ": cannot be opened: name an existing .glb, .gltf or .zt file");
  return in;
}

bool starts_as_elementary_stream(const std::filesystem::path& path) {
  std::ifstream in = open_bytes(path);
  std::array<char, bitstream::kMagic.size()> first{};
  in.read(first.data(), first.size());
  return in && std::equal(first.begin(), first.end(), bitstream::kMagic.begin(),
                          [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

StreamFile from_asset(gltf::ProgressiveAsset asset) {
  StreamFile file;
  file.bytes = std::move(asset.payload);
  file.external_base = true;
  file.base = std::move(asset.base);
  file.levels = asset.levels;
  file.base_positions.reserve(asset.control_points.size() * 3);
  for (const Eigen::Vector3f& p : asset.control_points)
    file.base_positions.insert(file.base_positions.end(), {p.x(), p.y(), p.z()});
  file.placement = asset.placement;
  file.source_diagonal = asset.source_diagonal * asset.placement.scale;
  for (const gltf::PrefixEntry& entry : asset.prefixes)
    file.prefixes.push_back({entry.byte_length, entry.geometric_error / asset.source_diagonal});
  return file;
}

}  // namespace

StreamFile open_stream_file(const std::filesystem::path& path) {
  if (!starts_as_elementary_stream(path)) return from_asset(gltf::read_progressive(path));
  std::ifstream in = open_bytes(path);
  StreamFile file;
  file.bytes.assign(std::istreambuf_iterator<char>(in), {});
  return file;
}

}  // namespace zerotree::decode
