/* Zerotree's runtime: a smooth surface out of any prefix of a stream. C11.
 *
 * A stream holds a base mesh (or is bound to one that the caller has) and the wavelet details of
 * its subdivision levels, the most useful first. Feed bytes as they arrive, reconstruct whenever a
 * picture is wanted: every prefix is a complete surface.
 *
 *   zt_decoder* decoder = zt_create(NULL);
 *   zt_status status = zt_feed(decoder, bytes, size);      // as often as bytes arrive
 *   zt_info info; zt_get_info(decoder, &info, sizeof info);
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

#include "zerotree/version.h"

/* In front of each function that a shared library exports. On Windows define ZT_SHARED to use the
 * shared library; the CMake target does. ZT_BUILDING_SHARED is for those who build it. */
#if defined(_WIN32) && defined(ZT_BUILDING_SHARED)
#define ZT_API __declspec(dllexport)
#elif defined(_WIN32) && defined(ZT_SHARED)
#define ZT_API __declspec(dllimport)
#elif defined(__GNUC__)
#define ZT_API __attribute__((visibility("default")))
#else
#define ZT_API
#endif

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
  ZT_BROKEN_STREAM = 4, /* see zt_reason */
  ZT_UNFINISHED = 5     /* the time is up: call again */
} zt_result;

/* Where a decoder takes its memory from. `allocate` returns memory aligned for any type (16 bytes),
 * or null; `release` gets the size that was asked for. Both are given or neither. They are called
 * from within the functions here that take the decoder, by the thread that called it. Everything
 * that grows with the levels comes from here; lists of the base mesh, and what OpenSubdiv needs
 * while it looks at the base, come from operator new; if that fails in OpenSubdiv, what it had
 * taken is lost. */
typedef struct zt_allocator {
  void* (*allocate)(void* user, size_t size);
  void (*release)(void* user, void* memory, size_t size);
  void* user;
} zt_allocator;

/* The caller's job system. `parallel_for` calls task(context, i) once for each i below `count`, in
 * any order, on any threads, and returns when all are done. `thread_count` is how many calls are
 * worth making at the same time; each takes some memory of its own. */
typedef void (*zt_task)(void* context, uint32_t index);
typedef struct zt_jobs {
  void (*parallel_for)(void* user, uint32_t count, zt_task task, void* context);
  void* user;
  uint32_t thread_count;
} zt_jobs;

/* Where the vertices of a level lie. */
typedef enum zt_sampling {
  ZT_SAMPLE_LIMIT = 0,   /* on the smooth surface: only details of finer levels move a vertex */
  ZT_SAMPLE_BALANCED = 1 /* a little outside where the surface is convex, so that the triangles are
                            about as much outside as inside: a third less error at coarse levels,
                            no less at the finest */
} zt_sampling;

/* How a decoder works and what it is willing to decode; a stream beyond the limits is refused
 * before memory is taken. Zero and null stand for the defaults, so this is all there is to it:
 *   zt_options options = {.struct_size = sizeof options};   options.max_vertices = 1000000; */
typedef struct zt_options {
  size_t struct_size;     /* sizeof(zt_options): the struct may grow at its end */
  uint64_t max_vertices;  /* of the finest level; default 2^27 */
  uint64_t max_memory;    /* bytes held for coefficients and their coding state; default 2 GiB */
  int32_t max_levels;     /* default 14 */
  int32_t sampling;       /* a zt_sampling; default ZT_SAMPLE_LIMIT */
  zt_allocator allocator; /* default: operator new */
  zt_jobs jobs;           /* default: everything runs on the calling thread */
} zt_options;

/* What is known so far. Of a stream that carries its base, everything but bytes_consumed is 0 until
 * header_ready; of a stream bound to the caller's base, the base and the levels are known from the
 * beginning. */
typedef struct zt_info {
  uint64_t bytes_consumed; /* bytes fed; once done, at most the stream's length */
  int32_t header_ready;    /* 1: the stream's header is read and accepted */
  int32_t base_ready;      /* 1: a surface can be reconstructed, and all counts are known */
  int32_t levels;          /* subdivision levels of the stream: 0 .. levels can be asked for */
  int32_t detailed_levels; /* beyond this level the surface so far is only subdivided */
  uint32_t base_vertex_count;
  uint32_t base_triangle_count;
  float error; /* of the bytes so far, by zt_set_prefix_errors; negative where it tells nothing */
  int32_t reserved;
  uint64_t memory; /* bytes held by this decoder, without the caller's buffers */
} zt_info;

/* A row of a file's table of measured errors (`prefixes` in the glTF extension). */
typedef struct zt_prefix_error {
  uint64_t bytes; /* length of the prefix */
  float error;    /* distance of its surface from the original, in the unit of the positions */
} zt_prefix_error;

/* A decoder for a stream that carries its base mesh (a .zt file). `options` may be null: the
 * defaults. Returns null when out of memory, or if the options' struct_size is 0, their sampling
 * unknown or their allocator a half. */
ZT_API zt_decoder* zt_create(const zt_options* options);

/* A decoder for a stream bound to the caller's base mesh (the payload of a glTF file). Positions
 * are three floats each, `position_stride` bytes apart (12 if packed; 0 counts as 12); indices are
 * three per triangle. They are copied. Both must be in the order and precision of the file: a
 * stream made for another base is ZT_BROKEN. `levels` is what the file says of the stream; one with
 * another number is ZT_BROKEN. The smooth limit surface of the base can be reconstructed before the
 * first byte; sharp edges and details come with the bytes. An index out of range, a mesh that is no
 * surface and levels beyond the limits are ZT_BROKEN too. Returns null when a pointer is null, and
 * when zt_create would. */
ZT_API zt_decoder* zt_create_for_base(const void* positions, size_t position_stride,
                                      uint32_t vertex_count, const uint32_t* indices,
                                      uint32_t triangle_count, int32_t levels,
                                      const zt_options* options);

/* Frees the decoder; null is allowed. */
ZT_API void zt_free(zt_decoder* decoder);

/* Takes the next `size` bytes of the stream, in pieces of any size (0 is allowed), and decodes what
 * they allow: about 0.02 microseconds a decision. Bytes after the end and after an error are
 * ignored. Memory for all details is taken once, when the base is known; later calls take none, but
 * for a stream whose details of the two finest levels have more than 14 bit planes. */
ZT_API zt_status zt_feed(zt_decoder* decoder, const void* bytes, size_t size);

/* As zt_feed, but stops soon after `budget_us` microseconds: `*taken` of the bytes are decoded, the
 * others are to be given again. Takes at least one byte if there is one. */
ZT_API zt_status zt_feed_for(zt_decoder* decoder, const void* bytes, size_t size,
                             uint32_t budget_us, size_t* taken);

/* What zt_feed last returned; before the first call ZT_MORE_BYTES_WANTED or ZT_BROKEN. */
ZT_API zt_status zt_get_status(const zt_decoder* decoder);

/* If broken, a sentence that says why; otherwise "". Valid until the decoder is next used. */
ZT_API const char* zt_reason(const zt_decoder* decoder);

/* Fills `info`, of which the caller knows the first `info_size` bytes: sizeof(zt_info). */
ZT_API void zt_get_info(const zt_decoder* decoder, zt_info* info, size_t info_size);

/* Vertices and triangles of `level`, 0 .. levels; 0 if the base is not known or the level is out of
 * range. They depend on the base alone, not on how many bytes have come, so buffers are allocated
 * once: for a payload before its first byte, for a .zt stream after its first few hundred. */
ZT_API uint32_t zt_vertex_count(const zt_decoder* decoder, int32_t level);
ZT_API uint32_t zt_triangle_count(const zt_decoder* decoder, int32_t level);

/* Positions (zt_sampling) and unit limit normals of the surface that the bytes so far stand for, at
 * the vertices of `level`; a level lacks what the details of finer ones add. Each is three floats a
 * vertex, `stride` bytes apart (12 if packed; 0 counts as 12; no alignment is needed); either
 * pointer may be null. `vertex_capacity` is the number of vertices both buffers have room for, at
 * least zt_vertex_count. Vertices of a level are the first ones of each finer level. Every vertex
 * is written; only the levels that have changed since the last call are synthesised anew. The first
 * call at a level takes memory, which is kept until the decoder is freed; later ones at this level
 * take none, but for the first after sharp tags of a base that the caller gave have come. */
ZT_API zt_result zt_reconstruct(zt_decoder* decoder, int32_t level, void* positions,
                                size_t position_stride, void* normals, size_t normal_stride,
                                uint32_t vertex_capacity);

/* As zt_reconstruct, but stops soon after `budget_us` microseconds. ZT_UNFINISHED: call again with
 * the same arguments to go on; until ZT_OK the buffers hold some of both, the new and what was
 * there. Bytes may be fed in between: the surface is then that of all bytes. Every call brings the
 * work on, even with a budget of 0. Runs on the calling thread alone. A stream of the quadrature
 * mirror transform knows no budget. */
ZT_API zt_result zt_reconstruct_for(zt_decoder* decoder, int32_t level, void* positions,
                                    size_t position_stride, void* normals, size_t normal_stride,
                                    uint32_t vertex_capacity, uint32_t budget_us);

/* The triangles of `level`, three indices each, counter-clockwise seen from outside. `index_size`
 * is 2 or 4 bytes an index; 2 needs a level of at most 65535 vertices. `triangle_capacity` is at
 * least zt_triangle_count. */
ZT_API zt_result zt_get_indices(zt_decoder* decoder, int32_t level, void* indices,
                                uint32_t index_size, uint32_t triangle_capacity);

/* An axis-aligned box that contains the surface that the bytes so far stand for, at any level.
 * Costs less than reconstructing level 4. */
ZT_API zt_result zt_get_bounds(zt_decoder* decoder, float low[3], float high[3]);

/* Tells the decoder what its file says of errors: rows of ascending length. They are copied. */
ZT_API zt_result zt_set_prefix_errors(zt_decoder* decoder, const zt_prefix_error* rows,
                                      uint32_t count);

/* Length of the shortest prefix whose error is at most `max_error` by zt_set_prefix_errors; the
 * longest known one if none is, 0 if none is known. */
ZT_API uint64_t zt_bytes_for_error(const zt_decoder* decoder, float max_error);

/* How far the triangles of `level` are from those of the finest level at most, for the bytes so
 * far: no more than this pops when a viewer switches between them. Levels are samples of a smooth
 * surface, so this is little more than the height of chords. Measured on the surface up to level 5,
 * from there on a quarter per level. Costs, after new bytes, about one and a half times what
 * reconstructing level 5 costs. */
ZT_API zt_result zt_get_level_error(zt_decoder* decoder, int32_t level, float* error);

/* The coarsest level with a zt_get_level_error of at most `max_error`; the finest if none is. For
 * an error of `pixels` on the screen, max_error = 2 distance tan(fov / 2) pixels / viewport height.
 */
ZT_API zt_result zt_choose_level(zt_decoder* decoder, float max_error, int32_t* level);

/* The version of the library: ZT_VERSION of the headers it was built with. */
ZT_API const char* zt_version(void);

#ifdef __cplusplus
}
#endif

#endif
