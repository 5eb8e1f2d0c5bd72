/* Reads what a progressive GLB holds: base mesh, payload and what the file says of both. */
#ifndef GLB_PROGRESSIVE_H
#define GLB_PROGRESSIVE_H

#include <stddef.h>
#include <stdint.h>
#include <zerotree/zerotree.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The first mesh with ZEROTREE_mesh_progressive of a file. Everything is freed by
 * glb_progressive_free. */
typedef struct glb_progressive {
  float* positions; /* x, y, z of each base vertex */
  uint32_t vertex_count;
  uint32_t* indices; /* three a triangle, all below vertex_count */
  uint32_t triangle_count;
  int32_t levels;
  float bounds_min[3], bounds_max[3]; /* around the surface of every prefix */
  float source_diagonal;
  zt_prefix_error* prefixes; /* ascending, the error in the unit of the positions */
  uint32_t prefix_count;
  const unsigned char* payload; /* lies in `file`; shorter than stated if the file was cut off */
  size_t payload_size;
  unsigned char* file; /* the whole file */
} glb_progressive;

/* Fills `glb` from a file of any content. Returns 1; or 0 with a sentence in `message` that names
 * the file, the place in it and what to do, and nothing to free. */
int glb_progressive_load(const char* path, glb_progressive* glb, char* message,
                         size_t message_size);

void glb_progressive_free(glb_progressive* glb);

/* A decoder for the payload that knows the file's table of errors, or null when out of memory. */
zt_decoder* glb_progressive_decoder(const glb_progressive* glb, const zt_options* options);

#ifdef __cplusplus
}
#endif

#endif
