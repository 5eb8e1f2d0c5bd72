// The C functions of zerotree/zerotree.h: argument checks, and no exception leaves.
#include <algorithm>
#include <chrono>
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
  std::vector<zt_prefix_error> errors;
};

namespace {

using zerotree::bitstream::BaseTopology;
using zerotree::bitstream::DecodeStatus;
using zerotree::bitstream::Limits;
using zerotree::surface::Positions;
using zerotree::surface::StridedVectors;
using zerotree::surface::SubdivisionLevel;

constexpr std::size_t kPackedStride = 3 * sizeof(float);
// 65535 restarts a primitive in 16 bit indices.
constexpr std::uint32_t kMostShortVertices = 65535;
// About 50 microseconds of decoding.
constexpr std::size_t kPieceOfBudget = 64;

/// The caller's options as far as it knows them; zeros beyond.
zt_options complete(const zt_options* options) {
  zt_options result{};
  if (options) std::memcpy(&result, options, std::min(options->struct_size, sizeof result));
  return result;
}

Limits limits_from(const zt_options& options) {
  Limits limits;
  if (options.max_vertices != 0) limits.max_vertices = options.max_vertices;
  // OpenSubdiv counts in 32 bit integers, and so do a level's indices.
  limits.max_vertices = std::min<std::uint64_t>(limits.max_vertices, std::uint64_t{1} << 30);
  if (options.max_levels != 0)
    limits.max_levels = std::clamp(options.max_levels, 0, limits.max_levels);
  if (options.max_memory != 0) limits.max_memory = options.max_memory;
  return limits;
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

/// By the table of measured errors; negative where it tells nothing.
float error_after(const zt_decoder& decoder, std::uint64_t bytes) {
  float error = -1.0f;
  for (const zt_prefix_error& row : decoder.errors)
    if (row.bytes <= bytes) error = row.error;
  return error;
}

zt_info info_of(const zt_decoder* decoder) {
  zt_info info{};
  info.error = -1.0f;
  if (!decoder) return info;
  const auto& stream = decoder->surface.decoder();
  info.bytes_consumed = stream.bytes_consumed();
  info.error = error_after(*decoder, info.bytes_consumed);
  if (stream.header_ready()) {
    info.header_ready = 1;
    info.levels = stream.header().levels;
    info.base_vertex_count = stream.header().vertex_count;
    info.base_triangle_count = stream.header().face_count;
  }
  if (!decoder->surface.is_ready()) return info;
  info.base_ready = 1;
  info.levels = decoder->surface.levels();
  info.detailed_levels = stream.detailed_levels();
  info.base_vertex_count = decoder->surface.base().vertex_count;
  info.base_triangle_count = static_cast<std::uint32_t>(decoder->surface.base().triangles.size());
  return info;
}

template <class Index>
void write_indices(const SubdivisionLevel& level, Index* indices) {
  for (const auto& triangle : level.triangles)
    for (const std::uint32_t vertex : triangle) *indices++ = static_cast<Index>(vertex);
}

}  // namespace

extern "C" {

zt_decoder* zt_create(const zt_options* options) {
  if (options && options->struct_size == 0) return nullptr;
  try {
    return new zt_decoder{
        zerotree::surface::ProgressiveSurface(limits_from(complete(options))), false, {}};
  } catch (...) {
    return nullptr;
  }
}

zt_decoder* zt_create_for_base(const void* positions, size_t position_stride, uint32_t vertex_count,
                               const uint32_t* indices, uint32_t triangle_count, int32_t levels,
                               const zt_options* options) {
  if (!positions || !indices || (options && options->struct_size == 0)) return nullptr;
  try {
    return new zt_decoder{
        zerotree::surface::ProgressiveSurface(
            {base_from(vertex_count, indices, triangle_count),
             gather_positions(positions, packed_unless(position_stride), vertex_count), levels},
            limits_from(complete(options))),
        false,
        {}};
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

zt_status zt_feed_for(zt_decoder* decoder, const void* bytes, size_t size, uint32_t budget_us,
                      size_t* taken) {
  if (!taken) return ZT_BROKEN;
  *taken = 0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::microseconds(budget_us);
  const auto* next = static_cast<const std::uint8_t*>(bytes);
  zt_status status = zt_get_status(decoder);
  while (status == ZT_MORE_BYTES_WANTED && *taken < size) {
    const std::size_t piece = std::min(kPieceOfBudget, size - *taken);
    status = zt_feed(decoder, next + *taken, piece);
    *taken += piece;
    if (std::chrono::steady_clock::now() >= end) return status;
  }
  *taken = size;
  return status;
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

void zt_get_info(const zt_decoder* decoder, zt_info* info, size_t info_size) {
  if (!info) return;
  const zt_info all = info_of(decoder);
  std::memset(info, 0, info_size);
  std::memcpy(info, &all, std::min(info_size, sizeof all));
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

zt_result zt_reconstruct_for(zt_decoder* decoder, int32_t level, void* positions,
                             size_t position_stride, void* normals, size_t normal_stride,
                             uint32_t vertex_capacity, uint32_t) {
  return zt_reconstruct(decoder, level, positions, position_stride, normals, normal_stride,
                        vertex_capacity);
}

zt_result zt_get_level_error(zt_decoder*, int32_t, float*) {
  return ZT_INVALID_ARGUMENT;
}

zt_result zt_choose_level(zt_decoder* decoder, float, int32_t* level) {
  *level = decoder->surface.levels();
  return ZT_OK;
}

zt_result zt_get_indices(zt_decoder* decoder, int32_t level, void* indices, uint32_t index_size,
                         uint32_t triangle_capacity) {
  const zt_result possible = check_request(decoder, level);
  if (possible != ZT_OK) return possible;
  if (!indices || triangle_capacity < zt_triangle_count(decoder, level)) return ZT_INVALID_ARGUMENT;
  const bool is_short = index_size == sizeof(std::uint16_t);
  if (is_short ? zt_vertex_count(decoder, level) > kMostShortVertices
               : index_size != sizeof(std::uint32_t))
    return ZT_INVALID_ARGUMENT;
  return guarded([&] {
    const SubdivisionLevel* topology = decoder->surface.topology(level);
    if (!topology) return ZT_BROKEN_STREAM;
    if (is_short)
      write_indices(*topology, static_cast<std::uint16_t*>(indices));
    else
      write_indices(*topology, static_cast<std::uint32_t*>(indices));
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

zt_result zt_set_prefix_errors(zt_decoder* decoder, const zt_prefix_error* rows, uint32_t count) {
  if (!decoder || (!rows && count > 0)) return ZT_INVALID_ARGUMENT;
  return guarded([&] {
    decoder->errors.assign(rows, rows + count);
    return ZT_OK;
  });
}

uint64_t zt_bytes_for_error(const zt_decoder* decoder, float max_error) {
  if (!decoder || decoder->errors.empty()) return 0;
  for (const zt_prefix_error& row : decoder->errors)
    if (row.error <= max_error) return row.bytes;
  return decoder->errors.back().bytes;
}

const char* zt_version(void) {
  return ZEROTREE_VERSION;
}

}  // extern "C"
