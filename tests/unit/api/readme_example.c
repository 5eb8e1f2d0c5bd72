#include <stdio.h>
#include <stdlib.h>
#include <zerotree/zerotree.h>

typedef void (*draw_function)(const float* positions, const float* normals, uint32_t vertices,
                              const uint32_t* indices, uint32_t triangles);

/* Draws a progressive mesh while its payload arrives, from the base mesh alone to the whole stream.
 * The base mesh is that of the glTF file's accessors, `levels` stands in its extension object. */
zt_status draw_while_loading(const float* base_positions, uint32_t base_vertices,
                             const uint32_t* base_indices, uint32_t base_triangles, int levels,
                             FILE* payload, draw_function draw) {
  zt_decoder* decoder = zt_create_for_base(base_positions, 0, base_vertices, base_indices,
                                           base_triangles, levels, NULL);
  const uint32_t vertices = zt_vertex_count(decoder, levels);
  const uint32_t triangles = zt_triangle_count(decoder, levels);
  float* positions = malloc(12 * (size_t)vertices);
  float* normals = malloc(12 * (size_t)vertices);
  uint32_t* indices = malloc(12 * (size_t)triangles);
  zt_status status = ZT_BROKEN;
  if (positions && normals && indices && /* null or broken decoders are refused here: */
      zt_get_indices(decoder, levels, indices, 4, triangles) == ZT_OK) {
    unsigned char bytes[4096];
    size_t size = 0;
    do {
      status = zt_feed(decoder, bytes, size); /* the first time nothing: the base alone */
      if (zt_reconstruct(decoder, levels, positions, 0, normals, 0, vertices) == ZT_OK)
        draw(positions, normals, vertices, indices, triangles);
      size = fread(bytes, 1, sizeof bytes, payload);
    } while (size > 0 && status == ZT_MORE_BYTES_WANTED);
  }
  if (status == ZT_BROKEN) fprintf(stderr, "%s\n", zt_reason(decoder));
  free(indices);
  free(normals);
  free(positions);
  zt_free(decoder);
  return status;
}
