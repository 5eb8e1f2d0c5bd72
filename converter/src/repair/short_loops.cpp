#include "repair/short_loops.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

#include "repair/homology_labels.h"

namespace zerotree::repair {
namespace {

using domain::kNext;
using domain::kNone;
using domain::kPrev;

// The shortest loop through one vertex at a time; arrays are kept for the next.
class LoopSearch {
 public:
  LoopSearch(const TriangleMesh& mesh, const domain::TriangleTopology& topology,
             const HomologyLabels& labels)
      : mesh_(mesh),
        topology_(topology),
        labels_(labels),
        distance_(mesh.positions.size(), kFar),
        parent_(mesh.positions.size(), kNone),
        sums_(mesh.positions.size() * labels.words, 0),
        is_border_(mesh.positions.size(), 0) {
    for (std::uint32_t f = 0; f < topology.faces.size(); ++f)
      for (int k = 0; k < 3; ++k)
        if (topology.adjacent[f][k] == kNone)
          is_border_[topology.faces[f][k]] = is_border_[topology.faces[f][kNext[k]]] = 1;
  }

  // Empty if there is none shorter than `max_length`. `classes` gets its label.
  SurfaceLoop run(std::uint32_t root, double max_length, std::vector<std::uint64_t>& classes) {
    SurfaceLoop loop;
    if (is_border_[root] != 0) return loop;
    spread(root, max_length / 2);
    double best = max_length;
    std::uint32_t best_u = kNone, best_v = kNone;
    for (std::uint32_t u : reached_)
      for_each_spoke(u, [&](std::uint32_t v, std::uint32_t edge) {
        if (v < u || distance_[v] == kFar || parent_[v] == u || parent_[u] == v) return;
        const double length = distance_[u] + distance_[v] + edge_length(u, v);
        if (length >= best || !differs(u, v, edge)) return;
        best = length;
        best_u = u;
        best_v = v;
        classes.assign(labels_.words, 0);
        for (std::size_t w = 0; w < labels_.words; ++w)
          classes[w] = sum(u)[w] ^ sum(v)[w] ^ labels_.of(edge, w);
      });
    if (best_u != kNone) loop = close_loop(best_u, best_v);
    for (std::uint32_t v : reached_) distance_[v] = kFar;
    return loop;
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  double edge_length(std::uint32_t a, std::uint32_t b) const {
    return (mesh_.positions[a] - mesh_.positions[b]).norm();
  }
  std::uint64_t* sum(std::uint32_t v) { return sums_.data() + v * labels_.words; }

  // The neighbours of a vertex inside the surface, each with the number of its edge.
  template <class Visit>
  void for_each_spoke(std::uint32_t v, const Visit& visit) {
    domain::gather_star(topology_, v, star_);
    for (const auto& [face, corner] : star_.corners)
      visit(topology_.faces[face][kNext[corner]], edge_number(topology_, face, corner));
  }

  void spread(std::uint32_t root, double radius) {
    using Front = std::tuple<double, std::uint32_t, std::uint32_t, std::uint32_t>;
    std::priority_queue<Front, std::vector<Front>, std::greater<>> front;
    reached_.clear();
    front.emplace(0.0, root, kNone, kNone);
    while (!front.empty()) {
      const auto [distance, v, from, edge] = front.top();
      front.pop();
      if (distance_[v] != kFar) continue;
      distance_[v] = distance;
      parent_[v] = from;
      reached_.push_back(v);
      for (std::size_t w = 0; w < labels_.words; ++w)
        sum(v)[w] = from == kNone ? 0 : sum(from)[w] ^ labels_.of(edge, w);
      for_each_spoke(v, [&, distance = distance, v = v](std::uint32_t next, std::uint32_t e) {
        const double farther = distance + edge_length(v, next);
        if (farther <= radius && distance_[next] == kFar && is_border_[next] == 0)
          front.emplace(farther, next, v, e);
      });
    }
  }

  bool differs(std::uint32_t u, std::uint32_t v, std::uint32_t edge) {
    for (std::size_t w = 0; w < labels_.words; ++w)
      if ((sum(u)[w] ^ sum(v)[w] ^ labels_.of(edge, w)) != 0) return true;
    return false;
  }

  // The paths from `u` and `v` as far as they meet.
  SurfaceLoop close_loop(std::uint32_t u, std::uint32_t v) {
    std::vector<std::uint32_t> from_u{u}, from_v{v};
    while (parent_[from_u.back()] != kNone) from_u.push_back(parent_[from_u.back()]);
    while (parent_[from_v.back()] != kNone) from_v.push_back(parent_[from_v.back()]);
    while (from_u.size() > 1 && from_v.size() > 1 &&
           from_u[from_u.size() - 2] == from_v[from_v.size() - 2]) {
      from_u.pop_back();
      from_v.pop_back();
    }
    SurfaceLoop loop{std::move(from_u), 0};
    from_v.pop_back();  // where they meet
    loop.vertices.insert(loop.vertices.end(), from_v.rbegin(), from_v.rend());
    for (std::size_t i = 0; i < loop.vertices.size(); ++i)
      loop.length += edge_length(loop.vertices[i], loop.vertices[(i + 1) % loop.vertices.size()]);
    return loop;
  }

  const TriangleMesh& mesh_;
  const domain::TriangleTopology& topology_;
  const HomologyLabels& labels_;
  std::vector<double> distance_;
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint64_t> sums_;
  std::vector<std::uint8_t> is_border_;
  std::vector<std::uint32_t> reached_;
  domain::Star star_;
};

// Vectors over two elements; `add` says whether one more is independent of those before.
class Independence {
 public:
  bool add(std::vector<std::uint64_t> row) {
    for (const auto& [pivot, basis] : rows_)
      if ((row[pivot / 64] >> (pivot % 64)) & 1)
        for (std::size_t w = 0; w < row.size(); ++w) row[w] ^= basis[w];
    for (std::size_t bit = 0; bit < row.size() * 64; ++bit)
      if ((row[bit / 64] >> (bit % 64)) & 1) {
        rows_.emplace_back(bit, std::move(row));
        return true;
      }
    return false;
  }

 private:
  std::vector<std::pair<std::size_t, std::vector<std::uint64_t>>> rows_;
};

struct FoundLoop {
  SurfaceLoop loop;
  std::vector<std::uint64_t> classes;
};

}  // namespace

std::vector<SurfaceLoop> find_short_loops(const TriangleMesh& mesh,
                                          const domain::TriangleTopology& topology,
                                          double max_length) {
  const HomologyLabels labels = label_edges(topology);
  std::vector<SurfaceLoop> chosen;
  if (labels.words == 0) return chosen;
  LoopSearch search(mesh, topology, labels);
  std::vector<FoundLoop> found;
  for (std::uint32_t root : labels.loop_vertices) {
    FoundLoop next;
    next.loop = search.run(root, max_length, next.classes);
    if (!next.loop.vertices.empty()) found.push_back(std::move(next));
  }
  std::ranges::stable_sort(found, {}, [](const FoundLoop& f) { return f.loop.length; });
  Independence independence;
  std::vector<std::uint8_t> taken(mesh.positions.size(), 0);
  domain::Star star;
  for (FoundLoop& candidate : found) {
    const auto is_taken = [&](std::uint32_t v) { return taken[v] != 0; };
    if (std::ranges::any_of(candidate.loop.vertices, is_taken)) continue;
    if (!independence.add(candidate.classes)) continue;
    for (std::uint32_t v : candidate.loop.vertices) {
      domain::gather_star(topology, v, star);
      for (const auto& [face, corner] : star.corners)
        for (std::uint32_t w : topology.faces[face]) taken[w] = 1;
    }
    chosen.push_back(std::move(candidate.loop));
  }
  return chosen;
}

}  // namespace zerotree::repair
