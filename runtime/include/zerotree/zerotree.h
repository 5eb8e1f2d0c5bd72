/* Zerotree's runtime: a smooth surface out of any prefix of a stream. C11.
 *
 * A stream holds a base mesh (or is bound to one that the caller has) and the wavelet details of
 * its subdivision levels, the most useful first. Feed bytes as they arrive, reconstruct whenever a
 * picture is wanted: every prefix is a complete surface.
 *
 *   zt_decoder* decoder = zt_create(NULL);
 *   zt_status status = zt_feed(decoder, bytes, size);      // as often as bytes arrive
 *   zt_info info; zt_get_info(decoder, &info);
 *   if (info.base_ready) {
 *     uint32_t vertices = zt_vertex_count(decoder, info.levels);
 *     zt_reconstruct(decoder, info.levels, positions, 12, normals, 12, vertices);
 *   }
 *   zt_free(decoder);
 *
 * Any bytes are safe: they end as a surface, as ZT_MORE_BYTES_WANTED or as ZT_BROKEN, and memory
 * stays within the limits. Decoding is integer arithmetic and the same on every machine; positions
 * are floats and agree to about 1e-6 of the surface's size. There is no global state: decoders are
 * independent, and one decoder is used by one thread at a time. The caller owns every buffer it
 * passes in; nothing is kept after the call returns. */
#ifndef ZEROTREE_ZEROTREE_H
#define ZEROTREE_ZEROTREE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct zt_decoder zt_decoder;

/* The three answers to bytes. A short stream is never an error. */
typedef enum zt_status {
  ZT_DONE = 0,              /* everything the stream holds is decoded */
  ZT_MORE_BYTES_WANTED = 1, /* right so far, more is to come */
  ZT_BROKEN = 2             /* no continuation is a stream this decoder accepts: zt_reason */
} zt_status;

/* What became of a request. */
typedef enum zt_result {
  ZT_OK = 0,
  ZT_NOT_READY = 1,        /* the base mesh is not known yet: feed more bytes */
  ZT_INVALID_ARGUMENT = 2, /* a null pointer, a level out of range, a buffer too small */
  ZT_OUT_OF_MEMORY = 3,
  ZT_BROKEN_STREAM = 4 /* see zt_reason */
} zt_result;

/* What a decoder is willing to decode; a stream beyond is refused before memory is taken. */
typedef struct zt_limits {
  uint64_t max_vertices; /* of the finest level */
  uint64_t max_memory;   /* bytes held for coefficients and their coding state */
  int32_t max_levels;
} zt_limits;

/* What is known so far. Of a stream that carries its base, everything but bytes_consumed is 0 until
 * header_ready; of a stream bound to the caller's base, the base and the levels are known from the
 * beginning. */
typedef struct zt_info {
  uint64_t bytes_consumed; /* bytes fed; once done, at most the stream's length */
  int32_t header_ready;    /* 1: the stream's header is read and accepted */
  int32_t base_ready;      /* 1: a surface can be reconstructed */
  int32_t levels;          /* subdivision levels of the stream: 0 .. levels can be asked for */
  int32_t detailed_levels; /* beyond this level the surface so far is only subdivided */
  uint32_t base_vertex_count;
  uint32_t base_triangle_count;
} zt_info;

/* Limits that suit a desktop: 2^27 vertices, 14 levels, 2 GiB. */
zt_limits zt_default_limits(void);

/* A decoder for a stream that carries its base mesh (a .zt file). `limits` may be null: the
 * defaults. Returns null when out of memory. */
zt_decoder* zt_create(const zt_limits* limits);

/* A decoder for a stream bound to the caller's base mesh (the payload of a glTF file). Positions
 * are three floats each, `position_stride` bytes apart (12 if packed; 0 counts as 12); indices are
 * three per triangle. They are copied. Both must be in the order and precision of the file: a
 * stream made for another base is ZT_BROKEN. `levels` is what the file says of the stream; one with
 * another number is ZT_BROKEN. The smooth limit surface of the base can be reconstructed before the
 * first byte; sharp edges and details come with the bytes. An index out of range, a mesh that is no
 * surface and levels beyond the limits are ZT_BROKEN too, in part only when the surface is first
 * asked for. Returns null when out of memory or when a pointer is null. */
zt_decoder* zt_create_for_base(const void* positions, size_t position_stride, uint32_t vertex_count,
                               const uint32_t* indices, uint32_t triangle_count, int32_t levels,
                               const zt_limits* limits);

/* Frees the decoder; null is allowed. */
void zt_free(zt_decoder* decoder);

/* Takes the next `size` bytes of the stream, in pieces of any size (0 is allowed), and decodes what
 * they allow: about 0.1 microseconds a decision, independent of the surface's size. Bytes after the
 * end and after an error are ignored. */
zt_status zt_feed(zt_decoder* decoder, const void* bytes, size_t size);

/* What zt_feed last returned; before the first call ZT_MORE_BYTES_WANTED or ZT_BROKEN. */
zt_status zt_get_status(const zt_decoder* decoder);

/* If broken, a sentence that says why; otherwise "". Valid until the decoder is next used. */
const char* zt_reason(const zt_decoder* decoder);

/* Fills `info`. */
void zt_get_info(const zt_decoder* decoder, zt_info* info);

/* Vertices and triangles of `level`, 0 .. levels; 0 if the base is not known or the level is out of
 * range. They depend on the base alone, not on how many bytes have come. */
uint32_t zt_vertex_count(const zt_decoder* decoder, int32_t level);
uint32_t zt_triangle_count(const zt_decoder* decoder, int32_t level);

/* Limit positions and unit limit normals of the surface that the bytes so far stand for, sampled at
 * the vertices of `level`. Each is three floats a vertex, `stride` bytes apart (12 if packed; 0
 * counts as 12; no alignment is needed); either pointer may be null. `vertex_capacity` is the
 * number of vertices both buffers have room for, at least zt_vertex_count. Vertices of a level are
 * the first ones of each finer level. Costs about 0.2 microseconds a vertex; the first call, and
 * the first at a deeper level, also builds the topology: about 2 microseconds and 250 bytes a
 * vertex (three times the bytes meanwhile), kept until the decoder is freed. */
zt_result zt_reconstruct(zt_decoder* decoder, int32_t level, void* positions,
                         size_t position_stride, void* normals, size_t normal_stride,
                         uint32_t vertex_capacity);

/* The triangles of `level`, three indices each, counter-clockwise seen from outside.
 * `triangle_capacity` is at least zt_triangle_count. */
zt_result zt_get_indices(zt_decoder* decoder, int32_t level, uint32_t* indices,
                         uint32_t triangle_capacity);

/* An axis-aligned box that contains the surface that the bytes so far stand for (its control
 * points, of which it is in the convex hull). Costs as much as zt_reconstruct at detailed_levels.
 */
zt_result zt_get_bounds(zt_decoder* decoder, float low[3], float high[3]);

/* "0.1.0" */
const char* zt_version(void);

#ifdef __cplusplus
}
#endif

#endif
