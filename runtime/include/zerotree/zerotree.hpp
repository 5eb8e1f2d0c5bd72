// Thin C++ ownership around zerotree.h, where the contracts are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <vector>

#include "zerotree/zerotree.h"

namespace zerotree {

/// Positions and normals: x, y, z of each vertex in a row.
struct SurfaceSamples {
  std::vector<float> positions, normals;
  std::vector<std::uint32_t> indices;
};

/// Options that say nothing: the defaults of zerotree.h.
inline zt_options default_options() {
  zt_options options{};
  options.struct_size = sizeof options;
  return options;
}

/// A decoder that frees itself. Throws std::bad_alloc when out of memory.
class Decoder {
 public:
  explicit Decoder(const zt_options& options = default_options()) : handle_(zt_create(&options)) {
    if (!handle_) throw std::bad_alloc();
  }
  /// For a stream of `levels` levels bound to this base: x, y, z of each vertex, three indices a
  /// triangle.
  Decoder(std::span<const float> positions, std::span<const std::uint32_t> indices, int levels,
          const zt_options& options = default_options())
      : handle_(zt_create_for_base(
            positions.data(), 0, static_cast<std::uint32_t>(positions.size() / 3), indices.data(),
            static_cast<std::uint32_t>(indices.size() / 3), levels, &options)) {
    if (!handle_) throw std::bad_alloc();
  }

  zt_status feed(std::span<const std::uint8_t> bytes) {
    return zt_feed(handle_.get(), bytes.data(), bytes.size());
  }
  zt_status status() const { return zt_get_status(handle_.get()); }
  const char* reason() const { return zt_reason(handle_.get()); }
  zt_info info() const {
    zt_info info;
    zt_get_info(handle_.get(), &info, sizeof info);
    return info;
  }

  /// The surface at `level`, in memory of its own.
  zt_result reconstruct(int level, SurfaceSamples& surface) {
    const std::uint32_t vertices = zt_vertex_count(handle_.get(), level);
    const std::uint32_t triangles = zt_triangle_count(handle_.get(), level);
    surface.positions.resize(std::size_t{3} * vertices);
    surface.normals.resize(std::size_t{3} * vertices);
    surface.indices.resize(std::size_t{3} * triangles);
    const zt_result result = zt_reconstruct(handle_.get(), level, surface.positions.data(), 0,
                                            surface.normals.data(), 0, vertices);
    if (result != ZT_OK) return result;
    return zt_get_indices(handle_.get(), level, surface.indices.data(), 4, triangles);
  }

  zt_decoder* get() const { return handle_.get(); }

 private:
  struct Free {
    void operator()(zt_decoder* decoder) const { zt_free(decoder); }
  };
  std::unique_ptr<zt_decoder, Free> handle_;
};

}  // namespace zerotree
