#include "random_topology.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <utility>

#include "bitstream/base_traversal.h"

namespace zerotree::test {

using bitstream::BaseTopology;

namespace {

// The standard's distributions differ between libraries; this does not.
std::uint32_t below(std::mt19937& random, std::size_t bound) {
  return static_cast<std::uint32_t>(random() % bound);
}

BaseTopology bare(const BaseTopology& topology) {
  return {topology.vertex_count, topology.triangles, {}, {}};
}

using DirectedEdge = std::pair<std::uint32_t, std::uint32_t>;

std::map<DirectedEdge, std::uint32_t> half_edges(const BaseTopology& topology) {
  std::map<DirectedEdge, std::uint32_t> result;
  for (std::uint32_t h = 0; h < topology.triangles.size() * 3; ++h) {
    const auto& t = topology.triangles[h / 3];
    result[{t[h % 3], t[(h + 1) % 3]}] = h;
  }
  return result;
}

}  // namespace

BaseTopology torus(std::uint32_t columns, std::uint32_t rows) {
  BaseTopology result{columns * rows, {}, {}, {}};
  const auto at = [&](std::uint32_t x, std::uint32_t y) {
    return (y % rows) * columns + x % columns;
  };
  for (std::uint32_t y = 0; y < rows; ++y) {
    for (std::uint32_t x = 0; x < columns; ++x) {
      result.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      result.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  return result;
}

BaseTopology join(const BaseTopology& a, const BaseTopology& b) {
  BaseTopology result = bare(a);
  result.vertex_count += b.vertex_count;
  for (const auto& [i, j, k] : b.triangles) {
    result.triangles.push_back({i + a.vertex_count, j + a.vertex_count, k + a.vertex_count});
  }
  return result;
}

BaseTopology flip_edges(const BaseTopology& topology, std::uint32_t count, std::uint32_t lowest,
                        std::uint32_t highest, std::uint32_t seed) {
  BaseTopology result = bare(topology);
  std::map<DirectedEdge, std::uint32_t> edges = half_edges(result);
  std::vector<std::uint32_t> valence(result.vertex_count, 0);
  for (const auto& triangle : result.triangles) {
    for (const std::uint32_t v : triangle) ++valence[v];
  }
  std::mt19937 random(seed);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t h = below(random, result.triangles.size() * 3);
    const auto t = result.triangles[h / 3];
    const std::uint32_t a = t[h % 3], b = t[(h + 1) % 3], c = t[(h + 2) % 3];
    const auto other = edges.find({b, a});
    if (other == edges.end()) continue;
    const std::uint32_t o = other->second;
    const std::uint32_t d = result.triangles[o / 3][(o + 2) % 3];
    if (c == d || edges.contains({c, d}) || edges.contains({d, c})) continue;
    if (valence[a] <= lowest || valence[b] <= lowest) continue;
    if (valence[c] >= highest || valence[d] >= highest) continue;
    --valence[a], --valence[b], ++valence[c], ++valence[d];
    edges.erase({a, b});
    edges.erase({b, a});
    result.triangles[h / 3] = {a, d, c};
    result.triangles[o / 3] = {d, b, c};
    for (const std::uint32_t f : {h / 3, o / 3}) {
      const auto& changed = result.triangles[f];
      for (std::uint32_t k = 0; k < 3; ++k) {
        edges[{changed[k], changed[(k + 1) % 3]}] = 3 * f + k;
      }
    }
  }
  return result;
}

BaseTopology punch_holes(BaseTopology topology, std::uint32_t count, std::uint32_t seed) {
  topology = bare(topology);
  std::mt19937 random(seed);
  for (std::uint32_t i = 0; i < count && topology.triangles.size() > 1; ++i) {
    BaseTopology smaller = topology;
    smaller.triangles.erase(smaller.triangles.begin() + below(random, smaller.triangles.size()));
    if (check_base_topology(smaller).ok()) topology = std::move(smaller);
  }
  return topology;
}

BaseTopology shuffle(const BaseTopology& topology, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto permutation = [&](std::size_t n) {
    std::vector<std::uint32_t> p(n);
    std::iota(p.begin(), p.end(), 0u);
    for (std::size_t i = n; i > 1; --i) std::swap(p[i - 1], p[below(random, i)]);
    return p;
  };
  bitstream::BaseOrder order{
      permutation(topology.vertex_count), permutation(topology.triangles.size()), {}};
  for (std::size_t f = 0; f < topology.triangles.size(); ++f) {
    order.first_corners.push_back(static_cast<std::uint8_t>(below(random, 3)));
  }
  return reorder(topology, order);
}

BaseTopology tag_randomly(BaseTopology topology, double share, std::uint32_t seed) {
  topology = bare(topology);
  std::mt19937 random(seed);
  const auto chosen = [&] { return below(random, 1000) < share * 1000.0; };
  std::vector<std::uint32_t> opposites;
  find_opposites(topology, opposites);
  for (std::uint32_t h = 0; h < opposites.size(); ++h) {
    if (opposites[h] == bitstream::kNone || opposites[h] < h || !chosen()) continue;
    const auto& t = topology.triangles[h / 3];
    const auto [low, high] = std::minmax({t[h % 3], t[(h + 1) % 3]});
    topology.crease_edges.push_back({low, high});
  }
  std::sort(topology.crease_edges.begin(), topology.crease_edges.end());
  for (std::uint32_t v = 0; v < topology.vertex_count; ++v) {
    if (chosen()) topology.corner_vertices.push_back(v);
  }
  return topology;
}

}  // namespace zerotree::test
