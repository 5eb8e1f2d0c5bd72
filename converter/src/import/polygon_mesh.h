// What a reader fills: polygons as the file has them, before they are cut into triangles.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "import/imported_mesh.h"

namespace zerotree::importer {

struct PolygonMesh {
  std::string format;
  std::vector<Eigen::Vector3d> positions;
  /// Vertices of all polygons, back to back; all in range.
  std::vector<std::uint32_t> corners;
  /// For each polygon the index in `corners` behind its last corner.
  std::vector<std::uint32_t> polygon_ends;
  std::vector<VertexAttribute> attributes;
  /// Becomes ImportedMesh::not_carried.
  std::vector<std::string> not_carried;
  /// Polygons of fewer than three corners, which are left out.
  std::uint64_t skipped_polygons = 0;

  /// Ends the polygon whose corners were appended to `corners` last.
  void end_polygon() {
    const std::size_t begin = polygon_ends.empty() ? 0 : polygon_ends.back();
    if (corners.size() - begin < 3) {
      corners.resize(begin);
      ++skipped_polygons;
    } else {
      polygon_ends.push_back(static_cast<std::uint32_t>(corners.size()));
    }
  }

  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    corners.insert(corners.end(), {a, b, c});
    end_polygon();
  }
};

/// Appends a strip's triangles, every second one turned over; `strip` holds at least three
/// vertices. A degenerate triangle, which only joins parts of a strip, is left out.
void append_triangle_strip(const std::vector<std::uint32_t>& strip, PolygonMesh& mesh);

/// The attribute called `name`, made with zeros for every vertex if there is none yet.
VertexAttribute& attribute_of(PolygonMesh& mesh, const std::string& name, int components);

/// Writes one sentence per attribute, and one for skipped polygons, to `mesh.not_carried`.
void note_what_is_not_carried(PolygonMesh& mesh);

}  // namespace zerotree::importer
