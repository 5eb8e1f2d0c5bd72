// The C functions of zerotree/zerotree.h: argument checks, and no exception leaves.
#include <algorithm>
#include <chrono>
#include <cstring>
#include <new>
#include <utility>
#include <vector>

#include "api/decoder_memory.h"
#include "progressive/progressive_surface.h"
#include "zerotree/zerotree.h"

namespace {

using zerotree::api::DecoderMemory;
using zerotree::bitstream::BaseTopology;
using zerotree::bitstream::DecodeStatus;
using zerotree::bitstream::Limits;
using zerotree::surface::Deadline;
using zerotree::surface::ExternalBase;
using zerotree::surface::LimitOutput;
using zerotree::surface::SurfaceOutcome;
using zerotree::surface::SurfaceResources;

constexpr std::size_t kPackedStride = 3 * sizeof(float);
// 65535 restarts a primitive in 16 bit indices.
constexpr std::uint32_t kMostShortVertices = 65535;
// Some 50 microseconds of decoding.
constexpr std::size_t kPieceOfBudget = 128;

SurfaceResources resources_of(const zt_options& options, DecoderMemory& memory) {
  return {&memory,
          {options.jobs.parallel_for, options.jobs.user, std::max(options.jobs.thread_count, 1u)}};
}

}  // namespace

struct zt_decoder {
  zt_decoder(const zt_options& options, const Limits& limits)
      : allocator(options.allocator),
        outward(options.sampling == ZT_SAMPLE_BALANCED ? zerotree::surface::kBalanced : 0.0f),
        memory(options.allocator),
        surface(limits, resources_of(options, memory)) {}
  zt_decoder(const zt_options& options, const Limits& limits, ExternalBase base)
      : allocator(options.allocator),
        outward(options.sampling == ZT_SAMPLE_BALANCED ? zerotree::surface::kBalanced : 0.0f),
        memory(options.allocator),
        surface(std::move(base), limits, resources_of(options, memory)) {}

  zt_allocator allocator;
  float outward;
  DecoderMemory memory;
  zerotree::surface::ProgressiveSurface surface;
  /// Said instead of the stream's own reason when memory ran out while feeding.
  bool is_out_of_memory = false;
  std::vector<zt_prefix_error> errors;
};

namespace {

/// The caller's options as far as it knows them; zeros beyond.
zt_options complete(const zt_options* options) {
  zt_options result{};
  if (options) std::memcpy(&result, options, std::min(options->struct_size, sizeof result));
  return result;
}

bool are_usable(const zt_options* options) {
  if (!options) return true;
  const zt_options all = complete(options);
  return options->struct_size >= sizeof options->struct_size &&
         (all.sampling == ZT_SAMPLE_LIMIT || all.sampling == ZT_SAMPLE_BALANCED) &&
         !all.allocator.allocate == !all.allocator.release;
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

/// A decoder in the caller's memory; null when there is none.
template <class... Base>
zt_decoder* make_decoder(const zt_options* options, Base&&... base) {
  const zt_options all = complete(options);
  void* memory = DecoderMemory::take(all.allocator, sizeof(zt_decoder));
  if (!memory) return nullptr;
  try {
    return new (memory) zt_decoder(all, limits_from(all), std::forward<Base>(base)...);
  } catch (...) {
    DecoderMemory::give_back(all.allocator, memory, sizeof(zt_decoder));
    return nullptr;
  }
}

std::size_t packed_unless(std::size_t stride) {
  return stride == 0 ? kPackedStride : stride;
}

bool is_ready(const zt_decoder& decoder) {
  return !decoder.is_out_of_memory && decoder.surface.is_ready();
}

bool has_level(const zt_decoder& decoder, std::int32_t level) {
  return is_ready(decoder) && level >= 0 && level <= decoder.surface.levels();
}

/// Whether a request for `level` can be met at all.
zt_result check_request(const zt_decoder* decoder, std::int32_t level) {
  if (!decoder) return ZT_INVALID_ARGUMENT;
  if (zt_get_status(decoder) == ZT_BROKEN) return ZT_BROKEN_STREAM;
  if (!is_ready(*decoder)) return ZT_NOT_READY;
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
  info.memory = sizeof(zt_decoder) + decoder->memory.bytes_held();
  if (stream.header_ready()) {
    info.header_ready = 1;
    info.levels = stream.header().levels;
    info.base_vertex_count = stream.header().vertex_count;
    info.base_triangle_count = stream.header().face_count;
  }
  if (!is_ready(*decoder)) return info;
  info.base_ready = 1;
  info.levels = decoder->surface.levels();
  info.detailed_levels = stream.detailed_levels();
  info.base_vertex_count = decoder->surface.base().vertex_count;
  info.base_triangle_count = static_cast<std::uint32_t>(decoder->surface.base().triangles.size());
  return info;
}

Deadline deadline_in(std::uint32_t microseconds) {
  return std::chrono::steady_clock::now() + std::chrono::microseconds(microseconds);
}

struct VertexBuffers {
  LimitOutput output;
  std::uint32_t capacity;
};

zt_result reconstruct(zt_decoder* decoder, std::int32_t level, const VertexBuffers& buffers,
                      const Deadline& deadline) {
  const zt_result possible = check_request(decoder, level);
  if (possible != ZT_OK) return possible;
  if (buffers.capacity < zt_vertex_count(decoder, level)) return ZT_INVALID_ARGUMENT;
  return guarded([&] {
    LimitOutput output = buffers.output;
    output.outward = decoder->outward;
    switch (decoder->surface.write_limits(level, output, deadline)) {
      case SurfaceOutcome::done:
        return ZT_OK;
      case SurfaceOutcome::unfinished:
        return ZT_UNFINISHED;
      case SurfaceOutcome::broken:
        break;
    }
    return ZT_BROKEN_STREAM;
  });
}

}  // namespace

extern "C" {

zt_decoder* zt_create(const zt_options* options) {
  return are_usable(options) ? make_decoder(options) : nullptr;
}

zt_decoder* zt_create_for_base(const void* positions, size_t position_stride, uint32_t vertex_count,
                               const uint32_t* indices, uint32_t triangle_count, int32_t levels,
                               const zt_options* options) {
  if (!positions || !indices || !are_usable(options)) return nullptr;
  try {
    return make_decoder(
        options,
        ExternalBase{base_from(vertex_count, indices, triangle_count),
                     gather_positions(positions, packed_unless(position_stride), vertex_count),
                     levels});
  } catch (...) {
    return nullptr;
  }
}

void zt_free(zt_decoder* decoder) {
  if (!decoder) return;
  const zt_allocator allocator = decoder->allocator;
  decoder->~zt_decoder();
  DecoderMemory::give_back(allocator, decoder, sizeof(zt_decoder));
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
  if (!decoder || !taken || (!bytes && size > 0)) return ZT_BROKEN;
  *taken = 0;
  const Deadline deadline = deadline_in(budget_us);
  const auto* next = static_cast<const std::uint8_t*>(bytes);
  zt_status status = zt_get_status(decoder);
  while (status == ZT_MORE_BYTES_WANTED && *taken < size) {
    const std::size_t piece = std::min(kPieceOfBudget, size - *taken);
    status = zt_feed(decoder, next + *taken, piece);
    *taken += piece;
    if (status == ZT_MORE_BYTES_WANTED && std::chrono::steady_clock::now() >= *deadline)
      return status;
  }
  *taken = size;  // what comes after the end or an error is ignored
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
  const LimitOutput output{
      {positions, packed_unless(position_stride)}, {normals, packed_unless(normal_stride)}, 0.0f};
  return reconstruct(decoder, level, {output, vertex_capacity}, {});
}

zt_result zt_reconstruct_for(zt_decoder* decoder, int32_t level, void* positions,
                             size_t position_stride, void* normals, size_t normal_stride,
                             uint32_t vertex_capacity, uint32_t budget_us) {
  const LimitOutput output{
      {positions, packed_unless(position_stride)}, {normals, packed_unless(normal_stride)}, 0.0f};
  return reconstruct(decoder, level, {output, vertex_capacity}, deadline_in(budget_us));
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
    const bool done =
        is_short ? decoder->surface.write_triangles(level, static_cast<std::uint16_t*>(indices))
                 : decoder->surface.write_triangles(level, static_cast<std::uint32_t*>(indices));
    return done ? ZT_OK : ZT_BROKEN_STREAM;
  });
}

zt_result zt_get_bounds(zt_decoder* decoder, float low[3], float high[3]) {
  if (!low || !high) return ZT_INVALID_ARGUMENT;
  const zt_result possible = check_request(decoder, 0);
  if (possible != ZT_OK) return possible;
  return guarded([&] {
    zerotree::surface::ProgressiveSurface::Box box;
    if (!decoder->surface.find_bounds(box, decoder->outward)) return ZT_BROKEN_STREAM;
    std::copy(box.low.begin(), box.low.end(), low);
    std::copy(box.high.begin(), box.high.end(), high);
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

zt_result zt_get_level_error(zt_decoder* decoder, int32_t level, float* error) {
  if (!error) return ZT_INVALID_ARGUMENT;
  const zt_result possible = check_request(decoder, level);
  if (possible != ZT_OK) return possible;
  return guarded([&] {
    const std::vector<float>* errors = decoder->surface.level_errors(decoder->outward);
    if (!errors) return ZT_BROKEN_STREAM;
    *error = (*errors)[static_cast<std::size_t>(level)];
    return ZT_OK;
  });
}

zt_result zt_choose_level(zt_decoder* decoder, float max_error, int32_t* level) {
  if (!level) return ZT_INVALID_ARGUMENT;
  const zt_result possible = check_request(decoder, 0);
  if (possible != ZT_OK) return possible;
  return guarded([&] {
    const std::vector<float>* errors = decoder->surface.level_errors(decoder->outward);
    if (!errors) return ZT_BROKEN_STREAM;
    // Errors fall from level to level, the finest one's is 0.
    const auto enough = std::find_if(errors->begin(), errors->end() - 1,
                                     [&](float error) { return error <= max_error; });
    *level = static_cast<std::int32_t>(enough - errors->begin());
    return ZT_OK;
  });
}

const char* zt_version(void) {
  return ZT_VERSION;
}

}  // extern "C"
