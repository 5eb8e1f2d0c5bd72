// Where limit positions and normals go.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace zerotree::surface {

/// Three floats per vertex, those of vertex v `v * stride` bytes from `data`, which needs no
/// alignment. Null: not asked for.
struct StridedVectors {
  void* data = nullptr;
  std::size_t stride = 3 * sizeof(float);

  /// `value` points to three floats.
  void write(std::size_t vertex, const void* value) const {
    std::memcpy(static_cast<char*>(data) + vertex * stride, value, 3 * sizeof(float));
  }
  friend bool operator==(const StridedVectors&, const StridedVectors&) = default;
};

/// The caller's buffers.
struct LimitOutput {
  StridedVectors positions, normals;
  friend bool operator==(const LimitOutput&, const LimitOutput&) = default;
};

}  // namespace zerotree::surface
