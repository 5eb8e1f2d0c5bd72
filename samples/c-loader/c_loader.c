/* Writes what growing prefixes of a progressive GLB look like:
 *   zerotree-c-loader IN.glb OUT-PREFIX [ERROR]
 * OUT-PREFIX-1of16.obj, -1of8, -1of4, -1of2 and -1of1 hold 1/16 of the payload to all of it, each
 * at the coarsest level whose triangles are within ERROR (default 0.001) of the smooth surface, in
 * diagonals of the original. Ends with 0, 1 if something failed, 2 if used wrongly. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zerotree/zerotree.h>

#include "glb_progressive.h"

/* Positions and normals side by side, as a vertex buffer has them. */
typedef struct vertex {
  float position[3], normal[3];
} vertex;

typedef struct surface {
  vertex* vertices;
  uint32_t* indices;
  uint32_t vertex_count, triangle_count;
} surface;

static int fail(const char* what, const char* why) {
  fprintf(stderr, "zerotree-c-loader: %s%s%s\n", what, *why ? ": " : "", why);
  return 0;
}

static void free_surface(surface* s) {
  free(s->vertices);
  free(s->indices);
}

/* The surface of the bytes fed so far. */
static int reconstruct(zt_decoder* decoder, int32_t level, surface* s) {
  zt_result result;
  s->vertex_count = zt_vertex_count(decoder, level);
  s->triangle_count = zt_triangle_count(decoder, level);
  s->vertices = malloc(sizeof(vertex) * s->vertex_count);
  s->indices = malloc(3 * sizeof(uint32_t) * s->triangle_count);
  if (!s->vertices || !s->indices) return fail("out of memory for the surface", "");
  result = zt_reconstruct(decoder, level, s->vertices->position, sizeof(vertex),
                          s->vertices->normal, sizeof(vertex), s->vertex_count);
  if (result == ZT_OK) result = zt_get_indices(decoder, level, s->indices, 4, s->triangle_count);
  return result == ZT_OK || fail("the surface cannot be reconstructed", zt_reason(decoder));
}

static void print_obj(FILE* file, const surface* s) {
  for (uint32_t k = 0; k < s->vertex_count; ++k) {
    const vertex* v = &s->vertices[k];
    fprintf(file, "v %.9g %.9g %.9g\n", v->position[0], v->position[1], v->position[2]);
    fprintf(file, "vn %.6g %.6g %.6g\n", v->normal[0], v->normal[1], v->normal[2]);
  }
  for (uint32_t k = 0; k < s->triangle_count; ++k) {
    const unsigned a = s->indices[3 * (size_t)k] + 1, b = s->indices[3 * (size_t)k + 1] + 1,
                   c = s->indices[3 * (size_t)k + 2] + 1;
    fprintf(file, "f %u//%u %u//%u %u//%u\n", a, a, b, b, c, c);
  }
}

static int write_obj(const char* path, const surface* s) {
  FILE* file = fopen(path, "w");
  int failed;
  if (!file) return fail(path, strerror(errno));
  print_obj(file, s);
  failed = ferror(file);
  return (fclose(file) == 0 && !failed) || fail(path, "could not be written; is the disk full?");
}

/* Reconstructs, writes and reports the bytes fed so far. */
static int write_prefix(zt_decoder* decoder, float max_error, const char* path) {
  surface s = {NULL, NULL, 0, 0};
  zt_info info;
  int32_t level = 0;
  int is_written;
  if (zt_choose_level(decoder, max_error, &level) != ZT_OK)
    return fail("no level can be chosen", zt_reason(decoder));
  is_written = reconstruct(decoder, level, &s) && write_obj(path, &s);
  if (is_written) {
    zt_get_info(decoder, &info, sizeof info);
    printf("%10llu bytes  level %2d  %8u vertices  error ", (unsigned long long)info.bytes_consumed,
           (int)level, (unsigned)s.vertex_count);
    if (info.error < 0) printf("unknown  %s\n", path);
    if (info.error >= 0) printf("%-7.3g  %s\n", info.error, path);
  }
  free_surface(&s);
  return is_written;
}

/* Feeds the payload up to each prefix in turn. */
static int write_prefixes(const glb_progressive* glb, zt_decoder* decoder, float max_error,
                          const char* out_prefix) {
  const size_t room = strlen(out_prefix) + sizeof "-1of16.obj";
  char* path = malloc(room);
  size_t fed = 0;
  int is_good = path || fail("out of memory", "");
  for (int part = 16; is_good && part >= 1; part /= 2) {
    const size_t end = glb->payload_size / (size_t)part;
    if (zt_feed(decoder, glb->payload + fed, end - fed) == ZT_BROKEN) {
      is_good = fail("the payload is broken; fetch the file anew", zt_reason(decoder));
      break;
    }
    fed = end;
    snprintf(path, room, "%s-1of%d.obj", out_prefix, part);
    is_good = write_prefix(decoder, max_error, path);
  }
  free(path);
  return is_good;
}

static int load_and_write(const char* in_path, const char* out_prefix, float relative_error) {
  char message[512];
  glb_progressive glb;
  zt_options options = {.struct_size = sizeof options};
  zt_decoder* decoder;
  int is_good;
  if (!glb_progressive_load(in_path, &glb, message, sizeof message)) return fail(message, "");
  options.max_vertices = 1 << 24; /* files may ask for far more than an OBJ should hold */
  decoder = glb_progressive_decoder(&glb, &options);
  is_good = decoder
                ? write_prefixes(&glb, decoder, relative_error * glb.source_diagonal, out_prefix)
                : fail("out of memory for a decoder", "");
  zt_free(decoder);
  glb_progressive_free(&glb);
  return is_good;
}

int main(int argc, char** argv) {
  char* end = NULL;
  const float error = argc == 4 ? strtof(argv[3], &end) : 0.001f;
  if (argc < 3 || argc > 4 || (end && (*end || end == argv[3])) || !(error > 0)) {
    fputs("usage: zerotree-c-loader IN.glb OUT-PREFIX [ERROR, in diagonals: 0.001]\n", stderr);
    return 2;
  }
  return load_and_write(argv[1], argv[2], error) ? 0 : 1;
}
