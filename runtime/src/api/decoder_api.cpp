// The C functions of zerotree/zerotree.h: argument checks, and no exception leaves.
#include <algorithm>
#include <cstring>
#include <limits>
#include <new>
#include <utility>
#include <vector>

#include "surface/progressive_surface.h"
#include "zerotree/zerotree.h"

struct zt_decoder {
  zerotree::surface::ProgressiveSurface surface;
  /// Said instead of the stream's own reason when memory ran out while feeding.
  bool is_out_of_memory = false;
};

namespace {

using zerotree::bitstream::BaseTopology;
using zerotree::bitstream::DecodeStatus;
using zerotree::bitstream::Limits;
using zerotree::surface::Positions;
using zerotree::surface::StridedVectors;
using zerotree::surface::SubdivisionLevel;

constexpr std::size_t kPackedStride = 3 * sizeof(float);

Limits limits_from(const zt_limits* limits) {
  const zt_limits given = limits ? *limits : zt_default_limits();
  Limits result;
  // OpenSubdiv counts in 32 bit integers, and so do a level's indices.
  result.max_vertices = std::min<std::uint64_t>(given.max_vertices, std::uint64_t{1} << 30);
  result.max_levels = std::clamp(given.max_levels, 0, result.max_levels);
  result.max_memory = given.max_memory;
  return result;
}

std::size_t packed_unless(std::size_t stride) {
  return stride == 0 ? kPackedStride : stride;
}

bool has_level(const zt_decoder& decoder, std::int32_t level) {
  return decoder.surface.is_ready() && level >= 0 && level <= decoder.surface.levels();
}

/// Whether a request for `level` can be met at all.
zt_result check_request(const zt_decoder* decoder, std::int32_t level) {
  if (!decoder) return ZT_INVALID_ARGUMENT;
  if (zt_get_status(decoder) == ZT_BROKEN) return ZT_BROKEN_STREAM;
  if (!decoder->surface.is_ready()) return ZT_NOT_READY;
  return has_level(*decoder, level) ? ZT_OK : ZT_INVALID_ARGUMENT;
}

/// Runs a request that allocates.
template <class Request>
zt_result guarded(const Request& request) {
  try {
    return request();
  } catch (const std::bad_alloc&) {
    return ZT_OUT_OF_MEMORY;
  } catch (...) {
    // Nothing else is thrown by design; a caller in C must not see it in any case.
    return ZT_BROKEN_STREAM;
  }
}

BaseTopology base_from(std::uint32_t vertex_count, const std::uint32_t* indices,
                       std::uint32_t triangle_count) {
  BaseTopology base;
  base.vertex_count = vertex_count;
  base.triangles.resize(triangle_count);
  for (std::size_t face = 0; face < triangle_count; ++face)
    base.triangles[face] = {indices[3 * face], indices[3 * face + 1], indices[3 * face + 2]};
  return base;
}

std::vector<float> gather_positions(const void* positions, std::size_t stride,
                                    std::uint32_t vertex_count) {
  std::vector<float> packed(std::size_t{3} * vertex_count);
  for (std::size_t vertex = 0; vertex < vertex_count; ++vertex)
    std::memcpy(&packed[3 * vertex], static_cast<const char*>(positions) + vertex * stride,
                kPackedStride);
  return packed;
}

}  // namespace

extern "C" {

zt_limits zt_default_limits(void) {
  const Limits defaults;
  return {defaults.max_vertices, defaults.max_memory, defaults.max_levels};
}

zt_decoder* zt_create(const zt_limits* limits) {
  try {
    return new zt_decoder{zerotree::surface::ProgressiveSurface(limits_from(limits))};
  } catch (...) {
    return nullptr;
  }
}

zt_decoder* zt_create_for_base(const void* positions, size_t position_stride, uint32_t vertex_count,
                               const uint32_t* indices, uint32_t triangle_count, int32_t levels,
                               const zt_limits* limits) {
  if (!positions || !indices) return nullptr;
  try {
    return new zt_decoder{zerotree::surface::ProgressiveSurface(
        {base_from(vertex_count, indices, triangle_count),
         gather_positions(positions, packed_unless(position_stride), vertex_count), levels},
        limits_from(limits))};
  } catch (...) {
    return nullptr;
  }
}

void zt_free(zt_decoder* decoder) {
  delete decoder;
}

zt_status zt_feed(zt_decoder* decoder, const void* bytes, size_t size) {
  if (!decoder || (!bytes && size > 0)) return ZT_BROKEN;
  try {
    if (!decoder->is_out_of_memory && size > 0)
      decoder->surface.feed({static_cast<const std::uint8_t*>(bytes), size});
  } catch (...) {
    decoder->is_out_of_memory = true;
  }
  return zt_get_status(decoder);
}

zt_status zt_get_status(const zt_decoder* decoder) {
  if (!decoder || decoder->is_out_of_memory) return ZT_BROKEN;
  switch (decoder->surface.status()) {
    case DecodeStatus::done:
      return ZT_DONE;
    case DecodeStatus::more_bytes_wanted:
      return ZT_MORE_BYTES_WANTED;
    case DecodeStatus::broken:
      break;
  }
  return ZT_BROKEN;
}

const char* zt_reason(const zt_decoder* decoder) {
  if (!decoder) return "there is no decoder";
  if (decoder->is_out_of_memory) return "out of memory while decoding";
  return decoder->surface.reason().c_str();
}

void zt_get_info(const zt_decoder* decoder, zt_info* info) {
  if (!info) return;
  *info = {};
  if (!decoder) return;
  const auto& stream = decoder->surface.decoder();
  info->bytes_consumed = stream.bytes_consumed();
  if (stream.header_ready()) {
    info->header_ready = 1;
    info->levels = stream.header().levels;
    info->base_vertex_count = stream.header().vertex_count;
    info->base_triangle_count = stream.header().face_count;
  }
  if (!decoder->surface.is_ready()) return;
  info->base_ready = 1;
  info->levels = decoder->surface.levels();
  info->detailed_levels = stream.detailed_levels();
  info->base_vertex_count = decoder->surface.base().vertex_count;
  info->base_triangle_count = static_cast<std::uint32_t>(decoder->surface.base().triangles.size());
}

uint32_t zt_vertex_count(const zt_decoder* decoder, int32_t level) {
  if (!decoder || !has_level(*decoder, level)) return 0;
  return static_cast<std::uint32_t>(decoder->surface.counts(level).vertices);
}

uint32_t zt_triangle_count(const zt_decoder* decoder, int32_t level) {
  if (!decoder || !has_level(*decoder, level)) return 0;
  return static_cast<std::uint32_t>(decoder->surface.counts(level).triangles);
}

zt_result zt_reconstruct(zt_decoder* decoder, int32_t level, void* positions,
                         size_t position_stride, void* normals, size_t normal_stride,
                         uint32_t vertex_capacity) {
  const zt_result possible = check_request(decoder, level);
  if (possible != ZT_OK) return possible;
  if (vertex_capacity < zt_vertex_count(decoder, level)) return ZT_INVALID_ARGUMENT;
  return guarded([&] {
    const SubdivisionLevel* topology = decoder->surface.topology(level);
    if (!topology) return ZT_BROKEN_STREAM;
    const Positions control_points = decoder->surface.control_points(level);
    zerotree::surface::limit_surface(*topology, control_points,
                                     StridedVectors{positions, packed_unless(position_stride)},
                                     StridedVectors{normals, packed_unless(normal_stride)});
    return ZT_OK;
  });
}

zt_result zt_get_indices(zt_decoder* decoder, int32_t level, uint32_t* indices,
                         uint32_t triangle_capacity) {
  const zt_result possible = check_request(decoder, level);
  if (possible != ZT_OK) return possible;
  if (!indices || triangle_capacity < zt_triangle_count(decoder, level)) return ZT_INVALID_ARGUMENT;
  return guarded([&] {
    const SubdivisionLevel* topology = decoder->surface.topology(level);
    if (!topology) return ZT_BROKEN_STREAM;
    for (const auto& triangle : topology->triangles)
      indices = std::copy(triangle.begin(), triangle.end(), indices);
    return ZT_OK;
  });
}

zt_result zt_get_bounds(zt_decoder* decoder, float low[3], float high[3]) {
  if (!decoder || !low || !high) return ZT_INVALID_ARGUMENT;
  const int level = decoder->surface.decoder().detailed_levels();
  const zt_result possible = check_request(decoder, level);
  if (possible != ZT_OK) return possible;
  return guarded([&] {
    if (!decoder->surface.topology(level)) return ZT_BROKEN_STREAM;
    const Positions points = decoder->surface.control_points(level);
    std::fill_n(low, 3, std::numeric_limits<float>::max());
    std::fill_n(high, 3, std::numeric_limits<float>::lowest());
    for (std::size_t k = 0; k < points.size(); ++k) {
      low[k % 3] = std::min(low[k % 3], points[k]);
      high[k % 3] = std::max(high[k % 3], points[k]);
    }
    return ZT_OK;
  });
}

const char* zt_version(void) {
  return ZEROTREE_VERSION;
}

}  // extern "C"
