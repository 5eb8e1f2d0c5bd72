// A stream, cut to its targets and measured.
#pragma once

#include <cstdint>
#include <vector>

#include "convert/convert.h"
#include "convert/prefix_table.h"
#include "decode/stream_file.h"
#include "gltf/progressive_asset.h"
#include "gltf/progressive_writer.h"

namespace zerotree::convert {

/// A stream as it goes into a file, with the errors of its prefixes.
struct MeasuredStream {
  decode::StreamFile file;
  PrefixTable table;
  /// The error that was asked for, relative to the diagonal; 0: none was.
  double asked_error = 0;
};

/// Cuts `file` where the options' error target is met and to at most `size_limit` bytes (0: no
/// limit), then measures its prefixes. Throws Error(target_not_reachable) if the targets exclude
/// each other or leave not even a base mesh.
MeasuredStream cut_and_measure(decode::StreamFile file, const ConvertOptions& options,
                               std::uint64_t size_limit, const PrefixMeasurement& how,
                               const Progress& progress);

/// The glTF mesh that carries `payload`. `normals` are the base's limit normals, or empty. Its
/// lengths have few digits: errors are rounded up (an error that was asked for is not passed by
/// that), bounds outwards.
gltf::ProgressiveAsset make_asset(const MeasuredStream& payload, int levels, double diagonal,
                                  const std::vector<Eigen::Vector3f>& normals,
                                  const std::string& name);

/// Bytes of payload that a GLB file of at most `file_size` bytes around `asset`'s base, written so,
/// can hold. Throws Error(target_not_reachable) if it holds none.
std::uint64_t payload_limit(const gltf::ProgressiveAsset& asset, const gltf::WriteOptions& how,
                            std::uint64_t file_size);

}  // namespace zerotree::convert
