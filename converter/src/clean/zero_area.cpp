#include "clean/zero_area.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "clean/half_edges.h"

namespace zerotree::clean {
namespace {

using Eigen::Vector3d;

class ZeroAreaRepair {
 public:
  ZeroAreaRepair(WorkingMesh& mesh, std::vector<std::uint32_t>& mates, const CleanOptions& options)
      : mesh_(mesh), mates_(mates), options_(options), removed_(mesh.triangles.size(), 0) {}

  ZeroAreaCounts run() {
    std::vector<std::uint32_t> open = zero_area_faces();
    if (open.empty()) return counts_;
    flip_all(open);
    // What a flip could not help: neighbours may have changed since, so all are looked at again
    // after each round of nudges. A face that three rounds do not help is removed.
    for (int round = 0; round < 3; ++round) {
      open = zero_area_faces();
      if (open.empty()) break;
      for (std::uint32_t f : open) nudge(f);
      open = zero_area_faces();
      flip_all(open);
    }
    for (std::uint32_t f : zero_area_faces()) remove(f);
    drop_removed_faces();
    return counts_;
  }

 private:
  double squared_length(std::uint32_t a, std::uint32_t b) const {
    return (mesh_.positions[a] - mesh_.positions[b]).squaredNorm();
  }

  bool has_no_area(const Triangle& t) const {
    const double longest = std::max(
        {squared_length(t[0], t[1]), squared_length(t[1], t[2]), squared_length(t[2], t[0])});
    const Vector3d &p = mesh_.positions[t[0]], &q = mesh_.positions[t[1]],
                   &r = mesh_.positions[t[2]];
    return (q - p).cross(r - p).norm() <= options_.zero_area_height * longest;
  }

  std::vector<std::uint32_t> zero_area_faces() const {
    std::vector<std::uint32_t> faces;
    for (std::uint32_t f = 0; f < mesh_.triangles.size(); ++f)
      if (removed_[f] == 0 && has_no_area(mesh_.triangles[f])) faces.push_back(f);
    return faces;
  }

  std::uint32_t longest_edge(std::uint32_t face) const {
    std::uint32_t longest = 3 * face;
    for (std::uint32_t h = 3 * face + 1; h < 3 * face + 3; ++h)
      if (length_of(h) > length_of(longest)) longest = h;
    return longest;
  }
  double length_of(std::uint32_t h) const {
    return squared_length(tail_of(mesh_.triangles, h), head_of(mesh_.triangles, h));
  }

  // Each flip lowers the number of such faces or keeps it and shortens an edge, so this ends.
  void flip_all(std::vector<std::uint32_t> open) {
    while (!open.empty()) {
      const std::uint32_t f = open.back();
      open.pop_back();
      if (removed_[f] != 0 || !has_no_area(mesh_.triangles[f])) continue;
      const std::uint32_t h = longest_edge(f), g = mates_[h];
      if (g == no_half_edge) {
        remove(f);
      } else if (may_flip(h, g)) {
        flip(h, g);
        // What could not be flipped before may be now, as a neighbour of these two.
        for (std::uint32_t face : {g / 3, f})
          for (std::uint32_t side = 3 * face; side < 3 * face + 3; ++side)
            if (mates_[side] != no_half_edge) open.push_back(mates_[side] / 3);
      }
    }
  }

  void remove(std::uint32_t face) {
    for (std::uint32_t h = 3 * face; h < 3 * face + 3; ++h)
      if (mates_[h] != no_half_edge) {
        mates_[mates_[h]] = no_half_edge;
        mates_[h] = no_half_edge;
      }
    removed_[face] = 1;
    ++counts_.removed_faces;
  }

  // The corners of the two faces at h: h runs from a to b, c and d are opposite.
  struct Diamond {
    std::uint32_t a, b, c, d;
  };
  Diamond diamond(std::uint32_t h, std::uint32_t g) const {
    return {tail_of(mesh_.triangles, h), head_of(mesh_.triangles, h),
            tail_of(mesh_.triangles, previous_half_edge(h)),
            tail_of(mesh_.triangles, previous_half_edge(g))};
  }

  bool may_flip(std::uint32_t h, std::uint32_t g) const {
    const auto [a, b, c, d] = diamond(h, g);
    if (c == d || are_joined(previous_half_edge(h), d)) return false;
    const int before = 1 + has_no_area(mesh_.triangles[g / 3]);
    const int after = has_no_area({a, d, c}) + has_no_area({d, b, c});
    return after < before || (after == before && squared_length(c, d) < squared_length(a, b));
  }

  // Whether an edge joins the tail of half-edge `start` to `vertex`.
  bool are_joined(std::uint32_t start, std::uint32_t vertex) const {
    std::uint32_t h = start;
    do {  // counter-clockwise; the edge that comes in is looked at too, for the boundary's sake
      if (head_of(mesh_.triangles, h) == vertex) return true;
      if (tail_of(mesh_.triangles, previous_half_edge(h)) == vertex) return true;
      h = mates_[previous_half_edge(h)];
    } while (h != no_half_edge && h != start);
    if (h == start) return false;
    for (h = mates_[start]; h != no_half_edge; h = mates_[h]) {
      h = next_half_edge(h);
      if (head_of(mesh_.triangles, h) == vertex) return true;
    }
    return false;
  }

  void flip(std::uint32_t h, std::uint32_t g) {
    const auto [a, b, c, d] = diamond(h, g);
    const std::uint32_t bc = mates_[next_half_edge(h)], ca = mates_[previous_half_edge(h)];
    const std::uint32_t ad = mates_[next_half_edge(g)], db = mates_[previous_half_edge(g)];
    const std::uint32_t f = h / 3 * 3, e = g / 3 * 3;
    mesh_.triangles[h / 3] = {a, d, c};
    mesh_.triangles[g / 3] = {d, b, c};
    join(f, ad);
    join(f + 1, e + 2);
    join(f + 2, ca);
    join(e, db);
    join(e + 1, bc);
    ++counts_.flipped_edges;
  }

  void join(std::uint32_t h, std::uint32_t mate) {
    mates_[h] = mate;
    if (mate != no_half_edge) mates_[mate] = h;
  }

  // Moves the corner opposite the longest edge away from the neighbour across that edge, in the
  // neighbour's plane if it has one.
  void nudge(std::uint32_t face) {
    if (removed_[face] != 0 || !has_no_area(mesh_.triangles[face])) return;
    const std::uint32_t h = longest_edge(face), g = mates_[h];
    if (g == no_half_edge) return;
    const auto [a, b, c, d] = diamond(h, g);
    const Vector3d along = mesh_.positions[b] - mesh_.positions[a];
    const double length = along.norm();
    if (length == 0) return;
    const Vector3d unit = along / length;
    Vector3d away = mesh_.positions[a] - mesh_.positions[d];
    away -= unit * unit.dot(away);
    if (away.norm() <= options_.zero_area_height * length) {
      int axis = 0;
      unit.cwiseAbs().minCoeff(&axis);
      away = unit.cross(Vector3d::Unit(axis));
    }
    mesh_.positions[c] += options_.nudge * length * away.normalized();
    ++counts_.nudged_vertices;
  }

  void drop_removed_faces() {
    std::size_t kept = 0;
    for (std::size_t f = 0; f < removed_.size(); ++f) {
      if (removed_[f] != 0) continue;
      mesh_.triangles[kept] = mesh_.triangles[f];
      mesh_.source_face[kept++] = mesh_.source_face[f];
    }
    mesh_.triangles.resize(kept);
    mesh_.source_face.resize(kept);
  }

  WorkingMesh& mesh_;
  std::vector<std::uint32_t>& mates_;
  const CleanOptions& options_;
  std::vector<std::uint8_t> removed_;
  ZeroAreaCounts counts_;
};

}  // namespace

ZeroAreaCounts repair_zero_area(WorkingMesh& mesh, std::vector<std::uint32_t> mates,
                                const CleanOptions& options) {
  return ZeroAreaRepair(mesh, mates, options).run();
}

}  // namespace zerotree::clean
