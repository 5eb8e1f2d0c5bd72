// A stream as it is written, with its measured errors, and the glTF mesh that carries it.
#pragma once

#include <string>
#include <vector>

#include "convert/prefix_table.h"
#include "decode/stream_file.h"
#include "gltf/progressive_asset.h"

namespace zerotree::convert {

/// A stream as it goes into a file, with the errors of its prefixes.
struct MeasuredStream {
  decode::StreamFile file;
  PrefixTable table;
  /// The error that was asked for, relative to the diagonal; 0: none was.
  double asked_error = 0;
};

/// The glTF mesh that carries `payload`. `normals` are the base's limit normals, or empty. Its
/// lengths have few digits: errors are rounded up (an error that was asked for is not passed by
/// that), bounds outwards.
gltf::ProgressiveAsset make_asset(const MeasuredStream& payload, int levels, double diagonal,
                                  const std::vector<Eigen::Vector3f>& normals,
                                  const std::string& name);

}  // namespace zerotree::convert
