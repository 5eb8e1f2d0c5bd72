// From a progressive mesh to glTF files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "gltf/progressive_asset.h"

namespace zerotree::gltf {

/// The prefixes table for measured errors in any order of bytes: sorted, and each entry's error
/// raised to the largest one measured at the same or more bytes, so that errors never rise and
/// each entry is a promise for every longer entry.
std::vector<PrefixEntry> monotone_prefixes(std::vector<PrefixEntry> measured);

/// How the base mesh is written.
struct WriteOptions {
  /// Uses KHR_mesh_quantization and EXT_meshopt_compression where each makes the file smaller; the
  /// former only if the control points are integers of 16 bits. What is used is then required.
  bool compress_base = false;
};

/// The bytes of `asset` as one GLB file. Throws Error(internal) if a rule of the extension is
/// broken (see ProgressiveAsset), Error(target_not_reachable) beyond 4 GiB.
std::vector<std::uint8_t> glb_bytes(const ProgressiveAsset& asset,
                                    const WriteOptions& options = {});

/// Writes one GLB file with the payload as its last bytes. The file appears complete or not at
/// all. Throws Error as glb_bytes does and if the file cannot be written.
void write_glb(const std::filesystem::path& path, const ProgressiveAsset& asset,
               const WriteOptions& options = {});

/// Writes the payload into NAME.zt.bin beside `path` (NAME.glb or NAME.gltf), and for .gltf the
/// base mesh into NAME.bin. All files appear complete; on failure none is left behind and files
/// that were there stay as they were. Throws Error as write_glb, usage for another extension.
void write_split(const std::filesystem::path& path, const ProgressiveAsset& asset,
                 const WriteOptions& options = {});

/// Bytes of all files that write_split makes of `asset`, together. Throws as that.
std::uint64_t split_size(const std::filesystem::path& path, const ProgressiveAsset& asset,
                         const WriteOptions& options = {});

}  // namespace zerotree::gltf
