#include "import/import_mesh.h"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <string_view>

#include "import/import_error.h"
#include "import/mesh_readers.h"
#include "import/polygon_triangulation.h"

namespace zerotree::importer {
namespace {

using Reader = PolygonMesh (*)(const InputBytes&, const ImportOptions&);

Reader reader_for_extension(std::string_view extension) {
  if (extension == ".ply") return read_ply;
  if (extension == ".obj") return read_obj;
  if (extension == ".off") return read_off;
  if (extension == ".stl") return read_stl;
  if (extension == ".drc") return read_draco;
  if (extension == ".glb" || extension == ".gltf") return read_gltf;
  return nullptr;
}

// Marks that cannot be mistaken win over the extension; OBJ has none, ASCII STL and OFF weak ones.
Reader reader_for(const InputBytes& input) {
  const std::string_view bytes = input.bytes;
  if (bytes.starts_with("glTF")) return read_gltf;
  if (bytes.starts_with("DRACO")) return read_draco;
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return read_ply;
  if (Reader reader = reader_for_extension(input.extension)) return reader;
  if (bytes.starts_with("solid")) return read_stl;
  if (bytes.substr(0, 6).find("OFF") != bytes.npos) return read_off;
  return nullptr;
}

void check_positions(const PolygonMesh& polygons, const std::string& name) {
  for (std::size_t v = 0; v < polygons.positions.size(); ++v)
    if (!polygons.positions[v].allFinite())
      refuse(name, "vertex " + std::to_string(v + 1) +
                       " has a coordinate that is not a finite number; repair it in a mesh editor "
                       "or export the mesh again");
}

void check_sizes(const PolygonMesh& polygons, const ImportOptions& options,
                 const std::string& name) {
  if (polygons.polygon_ends.empty())
    refuse(name, polygons.positions.empty()
                     ? "holds no vertices and no faces; export the mesh again"
                     : "holds points but no faces; reconstruct a surface from them first");
  const std::uint64_t triangles = polygons.corners.size() - 2 * polygons.polygon_ends.size();
  if (std::max<std::uint64_t>(triangles, polygons.positions.size()) > options.max_elements)
    refuse(name, "holds more than " + std::to_string(options.max_elements) +
                     " vertices or triangles; cut the mesh into pieces");
  std::uint32_t begin = 0;
  for (std::size_t p = 0; p < polygons.polygon_ends.size(); ++p) {
    const std::uint32_t count = polygons.polygon_ends[p] - begin;
    if (count > options.max_polygon_corners)
      refuse(name, "face " + std::to_string(p + 1) + " has " + std::to_string(count) +
                       " corners, more than " + std::to_string(options.max_polygon_corners) +
                       "; triangulate it in a mesh editor");
    begin = polygons.polygon_ends[p];
  }
}

std::uint64_t count_polygons(const std::vector<std::uint32_t>& ends) {
  std::uint64_t count = 0;
  std::uint32_t begin = 0;
  for (std::uint32_t end : ends) {
    count += end - begin > 3;
    begin = end;
  }
  return count;
}

PolygonMesh read_polygons(Reader reader, const InputBytes& input, const ImportOptions& options) {
  try {
    return reader(input, options);
  } catch (const std::bad_alloc&) {  // a library was talked into more than the machine has
    refuse(input.name, "asks for more memory than there is; it is damaged or too large");
  } catch (const std::length_error&) {
    refuse(input.name, "states a size that cannot be; it is damaged, export it again");
  }
}

}  // namespace

ImportedMesh import_mesh(const std::filesystem::path& path, const ImportOptions& options,
                         const Progress& progress) {
  report_progress(progress, "reading", 0.0);
  return import_mesh(read_input(path, options.max_decoded_bytes), options, progress);
}

ImportedMesh import_mesh(InputBytes input, const ImportOptions& options, const Progress& progress) {
  const Reader reader = reader_for(input);
  if (reader == nullptr)
    refuse(input.name, "is of no known format; give PLY, OBJ, OFF, STL, glTF, GLB or DRC");
  report_progress(progress, "reading", 0.3);
  PolygonMesh polygons = read_polygons(reader, input, options);
  input.bytes = std::string();
  check_sizes(polygons, options, input.name);
  check_positions(polygons, input.name);
  note_what_is_not_carried(polygons);

  report_progress(progress, "reading", 0.8);
  ImportedMesh result;
  result.mesh.triangles = triangulate(polygons);
  result.vertex_count = polygons.positions.size();
  result.face_count = polygons.polygon_ends.size() + polygons.skipped_polygons;
  result.polygon_count = count_polygons(polygons.polygon_ends);
  result.mesh.positions = std::move(polygons.positions);
  result.attributes = std::move(polygons.attributes);
  result.not_carried = std::move(polygons.not_carried);
  result.format = std::move(polygons.format);
  report_progress(progress, "reading", 1.0);
  return result;
}

}  // namespace zerotree::importer
