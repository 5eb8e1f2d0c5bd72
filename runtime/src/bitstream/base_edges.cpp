#include "bitstream/base_edges.h"

#include <algorithm>
#include <cstddef>

namespace zerotree::bitstream {
namespace {

// One corner of a face as the start of an edge; sorting brings the two sides of an edge together.
struct HalfEdge {
  std::uint32_t low, high;
  std::uint32_t face;
  std::uint8_t local;
  bool ascending;
};

std::string bad_face(std::size_t face, const char* what) {
  return "base face " + std::to_string(face) + " " + what;
}

std::string check_corners(const BaseTopology& topology) {
  for (std::size_t f = 0; f < topology.triangles.size(); ++f) {
    const auto& t = topology.triangles[f];
    if (std::max({t[0], t[1], t[2]}) >= topology.vertex_count) {
      return bad_face(f, "names a vertex that does not exist");
    }
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return bad_face(f, "repeats a vertex");
  }
  return {};
}

std::vector<HalfEdge> sorted_half_edges(const BaseTopology& topology) {
  std::vector<HalfEdge> halves;
  halves.reserve(topology.triangles.size() * 3);
  for (std::size_t f = 0; f < topology.triangles.size(); ++f) {
    const auto& t = topology.triangles[f];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      halves.push_back({std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(f),
                        static_cast<std::uint8_t>(k), a < b});
    }
  }
  std::sort(halves.begin(), halves.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::array{a.low, a.high, a.face} < std::array{b.low, b.high, b.face};
  });
  return halves;
}

// partner[3 f + k]: the other half of the edge as 3 f' + k', kNone on a boundary.
std::string find_partners(const std::vector<HalfEdge>& halves,
                          std::vector<std::uint32_t>& partner) {
  const auto same_edge = [&](std::size_t i, std::size_t j) {
    return halves[i].low == halves[j].low && halves[i].high == halves[j].high;
  };
  const auto slot = [](const HalfEdge& h) { return 3 * h.face + h.local; };
  for (std::size_t i = 0; i < halves.size();) {
    if (i + 1 == halves.size() || !same_edge(i, i + 1)) {
      ++i;
      continue;
    }
    if (i + 2 < halves.size() && same_edge(i, i + 2)) {
      return bad_face(halves[i + 2].face, "is the third at one edge");
    }
    if (halves[i].ascending == halves[i + 1].ascending) {
      return bad_face(halves[i + 1].face, "is oriented against its neighbour");
    }
    partner[slot(halves[i])] = slot(halves[i + 1]);
    partner[slot(halves[i + 1])] = slot(halves[i]);
    i += 2;
  }
  return {};
}

}  // namespace

BaseEdges number_base_edges(const BaseTopology& topology) {
  BaseEdges result;
  if (topology.triangles.size() >= kNone / 3) {
    result.error = "the base has too many faces";
    return result;
  }
  result.error = check_corners(topology);
  if (!result.error.empty()) return result;
  std::vector<std::uint32_t> partner(topology.triangles.size() * 3, kNone);
  result.error = find_partners(sorted_half_edges(topology), partner);
  if (!result.error.empty()) return result;

  result.face_edges.resize(topology.triangles.size());
  for (std::uint32_t half = 0; half < partner.size(); ++half) {
    const std::uint32_t f = half / 3, other = partner[half];
    const auto k = static_cast<std::uint8_t>(half % 3);
    if (other < half) {
      result.face_edges[f][k] = result.face_edges[other / 3][other % 3];
      continue;
    }
    const auto& t = topology.triangles[f];
    BaseEdge edge{{t[k], t[(k + 1) % 3]}, {f, kNone}, {k, 0}};
    if (other != kNone) {
      edge.faces[1] = other / 3;
      edge.local[1] = static_cast<std::uint8_t>(other % 3);
    }
    result.face_edges[f][k] = static_cast<std::uint32_t>(result.edges.size());
    result.edges.push_back(edge);
  }
  return result;
}

}  // namespace zerotree::bitstream
