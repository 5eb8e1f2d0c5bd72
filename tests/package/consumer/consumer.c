/* Decodes a stream with the installed library: consumer STREAM.zt */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zerotree/zerotree.h>

static int fail(const char* what) {
  fprintf(stderr, "consumer.c: %s\n", what);
  return 1;
}

static int feed_file(zt_decoder* decoder, const char* path) {
  unsigned char bytes[512];
  size_t size = 0;
  FILE* file = fopen(path, "rb");
  if (!file) return fail("the stream cannot be opened");
  while ((size = fread(bytes, 1, sizeof bytes, file)) > 0) zt_feed(decoder, bytes, size);
  fclose(file);
  return zt_get_status(decoder) == ZT_DONE ? 0 : fail("the stream is not whole");
}

static int has_unit_normals(const float* normals, uint32_t vertices) {
  for (const float* n = normals; n < normals + 3 * (size_t)vertices; n += 3) {
    const float square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    if (!(square > 0.99f && square < 1.01f)) return 0;
  }
  return 1;
}

static int reconstruct(zt_decoder* decoder) {
  zt_info info;
  float *positions, *normals;
  int failed = 0;
  zt_get_info(decoder, &info, sizeof info);
  const uint32_t vertices = zt_vertex_count(decoder, info.levels);
  positions = malloc(12 * (size_t)vertices);
  normals = malloc(12 * (size_t)vertices);
  if (vertices == 0 || !positions || !normals ||
      zt_reconstruct(decoder, info.levels, positions, 0, normals, 0, vertices) != ZT_OK)
    failed = fail("the surface was not reconstructed");
  else if (!has_unit_normals(normals, vertices))
    failed = fail("a normal has not length 1");
  else
    printf("zerotree %s: %u vertices\n", zt_version(), (unsigned)vertices);
  free(positions);
  free(normals);
  return failed;
}

int main(int argc, char** argv) {
  if (argc != 2) return fail("usage: consumer STREAM.zt");
  if (strcmp(zt_version(), ZT_VERSION) != 0) return fail("header and library differ in version");
  zt_decoder* decoder = zt_create(NULL);
  const int failed = feed_file(decoder, argv[1]) || reconstruct(decoder);
  zt_free(decoder);
  return failed;
}
