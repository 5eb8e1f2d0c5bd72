#include "glb_progressive.h"

#include <errno.h>
#include <jansson.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* glTF's numbers. */
enum {
  GLB_MAGIC = 0x46546C67, /* "glTF" */
  CHUNK_JSON = 0x4E4F534A,
  CHUNK_BIN = 0x004E4942,
  MODE_TRIANGLES = 4,
  TYPE_INT8 = 5120,
  TYPE_UINT8 = 5121,
  TYPE_INT16 = 5122,
  TYPE_UINT16 = 5123,
  TYPE_UINT32 = 5125,
  TYPE_FLOAT = 5126
};

/* More than this is no file of ours; larger ones would only take memory. A few bytes of a file can
 * repeat the same triangles in primitive after primitive, so these are counted too. */
static const uint64_t max_file_size = UINT64_C(1) << 31;
static const uint32_t max_triangles = UINT32_C(1) << 24;
static const char extension_name[] = "ZEROTREE_mesh_progressive";

/* What is being read, and where to say what is wrong with it. */
typedef struct reader {
  const char* path;
  char* message;
  size_t message_size;
  size_t file_size;
  const unsigned char* bin; /* the binary chunk, as far as the file goes */
  size_t bin_size;
  json_t* root;
} reader;

/* Where an accessor's elements lie: all of them within the binary chunk. */
typedef struct elements {
  const unsigned char* first;
  size_t stride;
  uint32_t count;
  int type;
} elements;

/* Says what is wrong, after the file's name. Returns 0, what failing functions return. */
static int fail(reader* in, const char* format, ...) {
  va_list arguments;
  const int length = snprintf(in->message, in->message_size, "%s: ", in->path);
  if (length < 0 || (size_t)length >= in->message_size) return 0;
  va_start(arguments, format);
  vsnprintf(in->message + length, in->message_size - (size_t)length, format, arguments);
  va_end(arguments);
  return 0;
}

static uint32_t little_endian(const unsigned char* bytes, int size) {
  uint32_t value = 0;
  for (int k = size; k-- > 0;) value = value << 8 | bytes[k];
  return value;
}

static unsigned char* read_open_file(reader* in, FILE* file) {
  unsigned char* bytes = NULL;
  long size = -1;
  if (fseek(file, 0, SEEK_END) == 0) size = ftell(file);
  if (size < 0 || fseek(file, 0, SEEK_SET) != 0)
    fail(in, "is no file that can be read");
  else if ((uint64_t)size > max_file_size)
    fail(in, "is larger than the 2 GiB that a progressive GLB may have here");
  else if (!(bytes = malloc((size_t)size + 1)))
    fail(in, "out of memory for %ld bytes", size);
  else if (fread(bytes, 1, (size_t)size, file) != (size_t)size) {
    fail(in, "could not be read to its end");
    free(bytes);
    bytes = NULL;
  }
  in->file_size = (size_t)size;
  return bytes;
}

static unsigned char* read_file(reader* in) {
  unsigned char* bytes;
  FILE* file = fopen(in->path, "rb");
  if (!file) {
    fail(in, "cannot be opened: %s", strerror(errno));
    return NULL;
  }
  bytes = read_open_file(in, file);
  fclose(file);
  return bytes;
}

/* The container: a header, a JSON chunk, a binary chunk. The binary chunk may be cut off. */
static int read_chunks(reader* in, const unsigned char* file) {
  const size_t size = in->file_size;
  json_error_t error;
  uint32_t json_size;
  if (size < 20 || little_endian(file, 4) != GLB_MAGIC || little_endian(file + 4, 4) != 2)
    return fail(in, "is not a glTF 2 binary file (.glb); make one with 'zerotree convert'");
  json_size = little_endian(file + 12, 4);
  if (little_endian(file + 16, 4) != CHUNK_JSON || json_size > size - 20)
    return fail(in, "the JSON chunk at byte 12 is missing or cut off; fetch the file anew");
  in->root = json_loadb((const char*)file + 20, json_size, 0, &error);
  if (!in->root) return fail(in, "the JSON chunk, line %d: %s", error.line, error.text);
  if (size - 20 - json_size < 8 || little_endian(file + 24 + json_size, 4) != CHUNK_BIN)
    return fail(in, "there is no binary chunk at byte %zu; split files are not read here",
                (size_t)json_size + 20);
  in->bin = file + 28 + json_size;
  in->bin_size = size - 28 - json_size;
  if (little_endian(in->bin - 8, 4) < in->bin_size) in->bin_size = little_endian(in->bin - 8, 4);
  return 1;
}

/* A whole number of 0 .. largest at `key`; `otherwise` if there is none, and -1 if it is another.
 */
static int64_t whole(const json_t* object, const char* key, int64_t otherwise, int64_t largest) {
  const json_t* value = json_object_get(object, key);
  const double number = json_number_value(value);
  if (!value) return otherwise;
  if (!json_is_number(value) || !(number >= 0 && number <= (double)largest)) return -1;
  return number == floor(number) ? (int64_t)number : -1;
}

/* The object at an index of one of the root's arrays. */
static const json_t* item(const reader* in, const char* array, int64_t index) {
  const json_t* items = json_object_get(in->root, array);
  return index < 0 ? NULL : json_array_get(items, (size_t)index);
}

/* The bytes of a bufferView in the binary chunk; `is_whole` is 0 if the file may end before. */
static int find_view(reader* in, int64_t index, int is_whole, const unsigned char** first,
                     size_t* size) {
  const json_t* view = item(in, "bufferViews", index);
  const int64_t offset = whole(view, "byteOffset", 0, UINT32_MAX);
  const int64_t length = whole(view, "byteLength", -1, UINT32_MAX);
  if (!view) return fail(in, "bufferView %lld does not exist", (long long)index);
  if (json_object_size(json_object_get(view, "extensions")) > 0)
    return fail(in, "bufferViews[%lld] is compressed; convert without --compress-base",
                (long long)index);
  if (whole(view, "buffer", -1, 0) != 0 || json_object_get(item(in, "buffers", 0), "uri"))
    return fail(in, "bufferViews[%lld] is not in this file; convert without --split",
                (long long)index);
  if (offset < 0 || length < 0 || (uint64_t)offset > in->bin_size ||
      (is_whole && (uint64_t)length > in->bin_size - (uint64_t)offset))
    return fail(in, "bufferViews[%lld] reaches beyond the binary chunk of %zu bytes",
                (long long)index, in->bin_size);
  *first = in->bin + offset;
  *size = in->bin_size - (size_t)offset;
  if ((uint64_t)length < *size) *size = (size_t)length;
  return 1;
}

static size_t size_of_type(int64_t type) {
  switch (type) {
    case TYPE_INT8:
    case TYPE_UINT8:
      return 1;
    case TYPE_INT16:
    case TYPE_UINT16:
      return 2;
    case TYPE_UINT32:
    case TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

/* An accessor of `components` numbers an element. */
static int find_elements(reader* in, int64_t index, const char* type, size_t components,
                         elements* out) {
  const json_t* accessor = item(in, "accessors", index);
  const int64_t component = whole(accessor, "componentType", -1, TYPE_FLOAT);
  const int64_t count = whole(accessor, "count", -1, UINT32_MAX);
  const int64_t offset = whole(accessor, "byteOffset", 0, UINT32_MAX);
  const int64_t view = whole(accessor, "bufferView", -1, INT32_MAX);
  const size_t element = components * size_of_type(component);
  const char* actual = json_string_value(json_object_get(accessor, "type"));
  int64_t stride;
  size_t size;
  if (!accessor || element == 0 || count < 1 || offset < 0 || !actual ||
      strcmp(actual, type) != 0 || json_object_get(accessor, "sparse") ||
      json_is_true(json_object_get(accessor, "normalized")))
    return fail(in, "accessors[%lld] is not plain %s data", (long long)index, type);
  if (!find_view(in, view, 1, &out->first, &size)) return 0;
  stride = whole(item(in, "bufferViews", view), "byteStride", (int64_t)element, 252);
  if (stride < (int64_t)element || (size_t)offset > size || size - (size_t)offset < element ||
      (uint64_t)(count - 1) > (size - (size_t)offset - element) / (uint64_t)stride)
    return fail(in, "accessors[%lld] reaches beyond its bufferView", (long long)index);
  out->stride = (size_t)stride;
  out->first += offset;
  out->count = (uint32_t)count;
  out->type = (int)component;
  return 1;
}

static float component_value(const unsigned char* bytes, int type) {
  float value;
  uint32_t bits;
  switch (type) {
    case TYPE_INT8:
      return (float)(int8_t)bytes[0];
    case TYPE_UINT8:
      return (float)bytes[0];
    case TYPE_INT16:
      return (float)(int16_t)little_endian(bytes, 2);
    case TYPE_UINT16:
      return (float)little_endian(bytes, 2);
    case TYPE_UINT32:
      return (float)little_endian(bytes, 4);
    default:
      bits = little_endian(bytes, 4);
      memcpy(&value, &bits, 4);
      return value;
  }
}

static int read_positions(reader* in, const json_t* mesh, glb_progressive* glb) {
  const json_t* primitive = json_array_get(json_object_get(mesh, "primitives"), 0);
  elements points;
  if (!find_elements(in, whole(json_object_get(primitive, "attributes"), "POSITION", -1, INT32_MAX),
                     "VEC3", 3, &points))
    return 0;
  glb->positions = malloc(12 * (size_t)points.count);
  if (!glb->positions) return fail(in, "out of memory for %u vertices", (unsigned)points.count);
  for (size_t k = 0; k < 3 * (size_t)points.count; ++k)
    glb->positions[k] = component_value(
        points.first + k / 3 * points.stride + k % 3 * size_of_type(points.type), points.type);
  glb->vertex_count = points.count;
  return 1;
}

/* Appends a primitive's triangles. */
static int read_triangles(reader* in, const json_t* primitive, glb_progressive* glb) {
  elements corners;
  uint32_t* indices;
  const size_t before = 3 * (size_t)glb->triangle_count;
  if (whole(primitive, "mode", MODE_TRIANGLES, INT32_MAX) != MODE_TRIANGLES)
    return fail(in, "a primitive of the base mesh does not hold triangles");
  if (!find_elements(in, whole(primitive, "indices", -1, INT32_MAX), "SCALAR", 1, &corners))
    return 0;
  if (corners.count / 3 > max_triangles - glb->triangle_count)
    return fail(in, "the base mesh has more than %u triangles", (unsigned)max_triangles);
  if (corners.count % 3 != 0 ||
      (corners.type != TYPE_UINT8 && corners.type != TYPE_UINT16 && corners.type != TYPE_UINT32))
    return fail(in, "the indices of the base mesh are not those of triangles");
  indices = realloc(glb->indices, 4 * (before + corners.count));
  if (!indices) return fail(in, "out of memory for %u indices", (unsigned)corners.count);
  glb->indices = indices;
  for (size_t k = 0; k < corners.count; ++k) {
    const uint32_t vertex =
        little_endian(corners.first + k * corners.stride, (int)size_of_type(corners.type));
    if (vertex >= glb->vertex_count)
      return fail(in, "index %zu of the base mesh names vertex %u of %u", k, (unsigned)vertex,
                  (unsigned)glb->vertex_count);
    indices[before + k] = vertex;
  }
  glb->triangle_count += corners.count / 3;
  return 1;
}

/* All primitives, which share their positions. */
static int read_base(reader* in, const json_t* mesh, glb_progressive* glb) {
  const json_t* primitives = json_object_get(mesh, "primitives");
  if (!read_positions(in, mesh, glb)) return 0;
  for (size_t k = 0; k < json_array_size(primitives); ++k)
    if (!read_triangles(in, json_array_get(primitives, k), glb)) return 0;
  return 1;
}

/* Three finite numbers, or 0. */
static int read_corner(const json_t* bounds, const char* key, float corner[3]) {
  const json_t* values = json_object_get(bounds, key);
  for (size_t k = 0; k < 3; ++k) {
    const json_t* value = json_array_get(values, k);
    corner[k] = (float)json_number_value(value);
    if (!json_is_number(value) || !isfinite(corner[k])) return 0;
  }
  return 1;
}

static int read_prefixes(reader* in, const json_t* extension, glb_progressive* glb) {
  const json_t* rows = json_object_get(extension, "prefixes");
  const size_t count = json_array_size(rows);
  int64_t last = -1;
  if (count == 0 || count > 1000000) return fail(in, "%s.prefixes is no table", extension_name);
  glb->prefixes = calloc(count, sizeof *glb->prefixes);
  if (!glb->prefixes) return fail(in, "out of memory for %zu prefixes", count);
  for (size_t k = 0; k < count; ++k) {
    const json_t* row = json_array_get(rows, k);
    const int64_t bytes = whole(row, "byteLength", -1, UINT32_MAX);
    const float error = (float)json_number_value(json_object_get(row, "geometricError"));
    if (bytes <= last || !isfinite(error) || error < 0)
      return fail(in, "%s.prefixes[%zu] does not ascend or has no error", extension_name, k);
    glb->prefixes[k].bytes = (uint64_t)bytes;
    glb->prefixes[k].error = error;
    last = bytes;
  }
  glb->prefix_count = (uint32_t)count;
  return 1;
}

static int read_extension(reader* in, const json_t* extension, glb_progressive* glb) {
  const json_t* bounds = json_object_get(extension, "bounds");
  glb->levels = (int32_t)whole(extension, "levels", -1, 14);
  if (glb->levels < 0) return fail(in, "%s.levels is not 0 to 14", extension_name);
  glb->source_diagonal = (float)json_number_value(json_object_get(extension, "sourceDiagonal"));
  if (!(glb->source_diagonal > 0) || !isfinite(glb->source_diagonal))
    return fail(in, "%s.sourceDiagonal is not above 0", extension_name);
  if (!read_corner(bounds, "min", glb->bounds_min) || !read_corner(bounds, "max", glb->bounds_max))
    return fail(in, "%s.bounds is no box", extension_name);
  return read_prefixes(in, extension, glb) &&
         find_view(in, whole(extension, "bufferView", -1, INT32_MAX), 0, &glb->payload,
                   &glb->payload_size);
}

static int read_first_progressive_mesh(reader* in, glb_progressive* glb) {
  const json_t* meshes = json_object_get(in->root, "meshes");
  for (size_t k = 0; k < json_array_size(meshes); ++k) {
    const json_t* mesh = json_array_get(meshes, k);
    const json_t* extension = json_object_get(json_object_get(mesh, "extensions"), extension_name);
    if (extension) return read_base(in, mesh, glb) && read_extension(in, extension, glb);
  }
  return fail(in, "no mesh has the extension %s; make one with 'zerotree convert'", extension_name);
}

int glb_progressive_load(const char* path, glb_progressive* glb, char* message,
                         size_t message_size) {
  reader in = {path, message, message_size, 0, NULL, 0, NULL};
  int is_loaded;
  memset(glb, 0, sizeof *glb);
  glb->file = read_file(&in);
  is_loaded = glb->file && read_chunks(&in, glb->file) && read_first_progressive_mesh(&in, glb);
  json_decref(in.root);
  if (!is_loaded) glb_progressive_free(glb);
  return is_loaded;
}

void glb_progressive_free(glb_progressive* glb) {
  free(glb->positions);
  free(glb->indices);
  free(glb->prefixes);
  free(glb->file);
  memset(glb, 0, sizeof *glb);
}

zt_decoder* glb_progressive_decoder(const glb_progressive* glb, const zt_options* options) {
  zt_decoder* decoder = zt_create_for_base(glb->positions, 0, glb->vertex_count, glb->indices,
                                           glb->triangle_count, glb->levels, options);
  if (decoder && zt_set_prefix_errors(decoder, glb->prefixes, glb->prefix_count) != ZT_OK) {
    zt_free(decoder);
    return NULL;
  }
  return decoder;
}
