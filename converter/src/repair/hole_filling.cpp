#include "repair/hole_filling.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <set>
#include <utility>

#include "domain/triangle_topology.h"
#include "repair/hole_triangulation.h"
#include "repair/patch_refinement.h"

namespace zerotree::repair {
namespace {

using domain::kNext;
using domain::kNone;
using Eigen::Vector3d;

// A filling of so large a part of its component's area lies on the back of a sheet.
constexpr double kSheetShare = 0.9;

double area_of(const std::vector<Vector3d>& points, const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const Triangle& t : triangles)
    sum += (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).norm() / 2;
  return sum;
}

// Boundary loops against the direction of the mesh's faces: as the faces of a filling see them.
struct BoundaryLoop {
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> faces;  // beyond the edge from vertex i to the next
};

std::vector<BoundaryLoop> find_loops(const domain::TriangleTopology& topology) {
  // The boundary edge that ends in each vertex: a clean vertex has one at most.
  std::vector<std::uint32_t> face_before(topology.face_of_vertex.size(), kNone);
  std::vector<std::uint32_t> before(topology.face_of_vertex.size(), kNone);
  for (std::uint32_t f = 0; f < topology.faces.size(); ++f)
    for (int k = 0; k < 3; ++k)
      if (topology.adjacent[f][k] == kNone) {
        before[topology.faces[f][kNext[k]]] = topology.faces[f][k];
        face_before[topology.faces[f][kNext[k]]] = f;
      }
  std::vector<BoundaryLoop> loops;
  std::vector<std::uint8_t> seen(before.size(), 0);
  for (std::uint32_t f = 0; f < topology.faces.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      std::uint32_t v = topology.faces[f][kNext[k]];
      if (topology.adjacent[f][k] != kNone || seen[v] != 0) continue;
      BoundaryLoop& loop = loops.emplace_back();
      for (; seen[v] == 0; v = before[v]) {
        seen[v] = 1;
        loop.vertices.push_back(v);
        loop.faces.push_back(face_before[v]);
      }
    }
  return loops;
}

double rim_length(const TriangleMesh& mesh, const BoundaryLoop& loop) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.vertices.size(); ++i)
    sum += (mesh.positions[loop.vertices[i]] -
            mesh.positions[loop.vertices[(i + 1) % loop.vertices.size()]])
               .norm();
  return sum;
}

// Area of the component of each face.
std::vector<double> component_areas(const TriangleMesh& mesh,
                                    const domain::TriangleTopology& topology) {
  std::vector<double> area(topology.faces.size(), -1.0);
  std::vector<std::uint32_t> faces;
  for (std::uint32_t first = 0; first < area.size(); ++first) {
    if (area[first] >= 0) continue;
    faces.assign(1, first);
    area[first] = 0;
    double sum = 0;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      sum += area_of(mesh.positions, {topology.faces[faces[i]]});
      for (std::uint32_t next : topology.adjacent[faces[i]]) {
        if (next == kNone || area[next] >= 0) continue;
        area[next] = 0;
        faces.push_back(next);
      }
    }
    for (std::uint32_t f : faces) area[f] = sum;
  }
  return area;
}

class HoleFiller {
 public:
  HoleFiller(const TriangleMesh& mesh, const domain::TriangleTopology& topology)
      : mesh_(mesh), topology_(topology), component_area_(component_areas(mesh, topology)) {}

  // Adds the filling of `loop` to `filled`; false if the loop is the border of a sheet.
  bool fill(const BoundaryLoop& loop, TriangleMesh& filled) {
    gather_rim(loop);
    Patch patch{rim_.points, triangulate_rim(rim_), static_cast<std::uint32_t>(rim_.points.size())};
    if (patch.triangles.empty()) fan_out(patch);
    if (area_of(patch.points, patch.triangles) >= kSheetShare * component_area_[loop.faces.front()])
      return false;
    refine_patch(patch, rim_.may_connect);
    smooth_patch(patch, outside_);
    add_to(filled, loop, patch);
    return true;
  }

  // The same without bending: the sides of a cut would go through each other.
  void close(const BoundaryLoop& loop, TriangleMesh& filled) {
    gather_rim(loop);
    Patch patch{rim_.points, triangulate_rim(rim_), static_cast<std::uint32_t>(rim_.points.size())};
    if (patch.triangles.empty()) fan_out(patch);
    refine_patch(patch, rim_.may_connect);
    add_to(filled, loop, patch);
  }

 private:
  // The rim, and for each of its points the neighbours in the mesh beyond the rim.
  void gather_rim(const BoundaryLoop& loop) {
    const std::size_t n = loop.vertices.size();
    rim_ = {};
    connected_.clear();
    outside_.assign(n, {});
    std::vector<std::pair<std::uint32_t, std::uint32_t>> index_of;
    for (std::uint32_t i = 0; i < n; ++i) index_of.emplace_back(loop.vertices[i], i);
    std::ranges::sort(index_of);
    domain::Star star;
    for (std::uint32_t i = 0; i < n; ++i) {
      rim_.points.push_back(mesh_.positions[loop.vertices[i]]);
      const Triangle& t = mesh_.triangles[loop.faces[i]];
      rim_.normals_beyond.push_back((mesh_.positions[t[1]] - mesh_.positions[t[0]])
                                        .cross(mesh_.positions[t[2]] - mesh_.positions[t[0]])
                                        .stableNormalized());
      domain::gather_star(topology_, loop.vertices[i], star);
      for (const auto& [face, corner] : star.corners)
        for (int k : {kNext[corner], domain::kPrev[corner]}) {
          const std::uint32_t w = topology_.faces[face][k];
          const auto place = std::ranges::lower_bound(
              index_of, w, {}, &std::pair<std::uint32_t, std::uint32_t>::first);
          if (place != index_of.end() && place->first == w)
            connected_.insert(std::minmax(i, place->second));
          else if (k == kNext[corner])  // each inner spoke is the next edge of one face
            outside_[i].push_back(mesh_.positions[w]);
        }
    }
    rim_.may_connect = [this](std::uint32_t a, std::uint32_t b) {
      return !connected_.contains(std::minmax(a, b));
    };
  }

  // Where the edges there are leave no triangulation: a new point in the middle always does.
  static void fan_out(Patch& patch) {
    Vector3d middle = Vector3d::Zero();
    for (std::uint32_t i = 0; i < patch.rim_size; ++i) middle += patch.points[i];
    patch.points.push_back(middle / patch.rim_size);
    for (std::uint32_t i = 0; i < patch.rim_size; ++i)
      patch.triangles.push_back({i, (i + 1) % patch.rim_size, patch.rim_size});
  }

  static void add_to(TriangleMesh& filled, const BoundaryLoop& loop, const Patch& patch) {
    const auto first = static_cast<std::uint32_t>(filled.positions.size());
    filled.positions.insert(filled.positions.end(), patch.points.begin() + patch.rim_size,
                            patch.points.end());
    for (const Triangle& t : patch.triangles) {
      Triangle& added = filled.triangles.emplace_back();
      for (int k = 0; k < 3; ++k)
        added[k] = t[k] < patch.rim_size ? loop.vertices[t[k]] : first + (t[k] - patch.rim_size);
    }
  }

  const TriangleMesh& mesh_;
  const domain::TriangleTopology& topology_;
  std::vector<double> component_area_;
  Rim rim_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> connected_;  // rim points with an edge
  std::vector<std::vector<Vector3d>> outside_;
};

}  // namespace

FilledMesh fill_holes(const TriangleMesh& mesh, const FillOptions& options,
                      const Progress& progress) {
  FilledMesh result{mesh, {}};
  const domain::TriangleTopology topology =
      domain::build_topology(static_cast<std::uint32_t>(mesh.positions.size()), mesh.triangles);
  const std::vector<BoundaryLoop> loops = find_loops(topology);
  HoleFiller filler(mesh, topology);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    report_progress(progress, "filling holes",
                    static_cast<double>(i) / static_cast<double>(loops.size()));
    std::vector<Vector3d> points;
    for (std::uint32_t v : loops[i].vertices) points.push_back(mesh.positions[v]);
    const bool is_filled =
        bounding_box_diagonal(points) < options.size && filler.fill(loops[i], result.mesh);
    (is_filled ? result.report.filled_rims : result.report.left_rims)
        .push_back(rim_length(mesh, loops[i]));
  }
  result.report.added_vertices = result.mesh.positions.size() - mesh.positions.size();
  result.report.added_faces = result.mesh.triangles.size() - mesh.triangles.size();
  return result;
}

TriangleMesh close_cuts(const TriangleMesh& mesh, const std::vector<std::uint32_t>& vertices) {
  TriangleMesh closed = mesh;
  const domain::TriangleTopology topology =
      domain::build_topology(static_cast<std::uint32_t>(mesh.positions.size()), mesh.triangles);
  std::vector<std::uint8_t> is_cut(mesh.positions.size(), 0);
  for (std::uint32_t v : vertices) is_cut[v] = 1;
  HoleFiller filler(mesh, topology);
  for (const BoundaryLoop& loop : find_loops(topology))
    if (std::ranges::all_of(loop.vertices, [&](std::uint32_t v) { return is_cut[v] != 0; }))
      filler.close(loop, closed);
  return closed;
}

}  // namespace zerotree::repair
