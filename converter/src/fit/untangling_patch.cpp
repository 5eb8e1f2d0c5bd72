#include "fit/untangling_patch.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace zerotree::fit {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

// What may happen to a vertex: nothing, or its limit position moves, or its control point too.
enum class Reach : std::uint8_t { at_rest, moving, free };

std::vector<Reach> find_reach(const relax::SubdividedLevel& finest,
                              const std::vector<std::uint8_t>& held,
                              const std::vector<std::uint32_t>& faces, int rings) {
  std::vector<std::uint8_t> on_feature(finest.vertex_count, 0), near(finest.vertex_count, 0);
  for (std::size_t e = 0; e < finest.edges.size(); ++e)
    if (finest.is_feature[e]) on_feature[finest.edges[e][0]] = on_feature[finest.edges[e][1]] = 1;
  for (std::uint32_t f : faces)
    for (std::uint32_t v : finest.triangles[f]) near[v] = 1;
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<std::uint8_t> inner = near;
    // Not across features, whose limit positions do not feel the surface beside them.
    for (const auto& [a, b] : finest.edges) {
      if (inner[a] && !on_feature[a]) near[b] = 1;
      if (inner[b] && !on_feature[b]) near[a] = 1;
    }
  }
  std::vector<Reach> reach(finest.vertex_count, Reach::at_rest);
  for (std::size_t v = 0; v < reach.size(); ++v)
    if (near[v] && !held[v] && !on_feature[v]) reach[v] = Reach::free;
  const auto carry_along = [&](std::uint32_t from, std::uint32_t to) {
    if (reach[from] == Reach::free && reach[to] == Reach::at_rest && !on_feature[to])
      reach[to] = Reach::moving;
  };
  for (const auto& [a, b] : finest.edges) {
    carry_along(a, b);
    carry_along(b, a);
  }
  return reach;
}

std::uint32_t root_of(std::vector<std::uint32_t>& parents, std::uint32_t v) {
  while (parents[v] != v) v = parents[v] = parents[parents[v]];
  return v;
}

// Of each vertex the lowest one of those that it moves with, through faces.
std::vector<std::uint32_t> find_parts(const relax::SubdividedLevel& finest,
                                      const std::vector<Reach>& reach) {
  std::vector<std::uint32_t> parents(reach.size());
  std::iota(parents.begin(), parents.end(), 0u);
  for (const Triangle& t : finest.triangles) {
    std::uint32_t first = kNone;
    for (std::uint32_t v : t) {
      if (reach[v] == Reach::at_rest) continue;
      const std::uint32_t root = root_of(parents, v);
      if (first != kNone) parents[std::max(first, root)] = std::min(first, root);
      first = std::min(first, root);
    }
  }
  for (std::uint32_t v = 0; v < parents.size(); ++v) parents[v] = root_of(parents, v);
  return parents;
}

// The vertices of the surface, shared out among the patches.
struct Shares {
  std::vector<Reach> reach;
  std::vector<std::uint32_t> patch, place;  // of vertices that are not at rest
};

void add_vertex(std::uint32_t v, Shares& shares, UntanglingPatch& patch) {
  shares.place[v] = static_cast<std::uint32_t>(patch.vertices.size());
  patch.vertices.push_back(v);
}

std::vector<UntanglingPatch> share_out(const relax::SubdividedLevel& finest, Shares& shares) {
  const std::vector<std::uint32_t> parts = find_parts(finest, shares.reach);
  shares.patch.assign(parts.size(), kNone);
  shares.place.assign(parts.size(), kNone);
  std::vector<UntanglingPatch> patches;
  std::vector<std::uint32_t> patch_of_part(parts.size(), kNone);
  for (const Reach reach : {Reach::free, Reach::moving})
    for (std::uint32_t v = 0; v < parts.size(); ++v) {
      if (shares.reach[v] != reach) continue;
      std::uint32_t& number = patch_of_part[parts[v]];
      if (number == kNone) {
        number = static_cast<std::uint32_t>(patches.size());
        patches.emplace_back();
      }
      shares.patch[v] = number;
      UntanglingPatch& patch = patches[number];
      add_vertex(v, shares, patch);
      patch.moving_count = static_cast<std::uint32_t>(patch.vertices.size());
      if (reach == Reach::free) patch.free_count = patch.moving_count;
    }
  return patches;
}

void add_weights(const relax::SubdividedLevel& finest, const LimitOperator& limit,
                 const Shares& shares, std::vector<UntanglingPatch>& patches) {
  for (UntanglingPatch& patch : patches)
    for (std::uint32_t i = 0; i < patch.free_count; ++i)
      patch.weights.push_back({i, i, limit.own_weight(patch.vertices[i])});
  const auto add = [&](std::uint32_t control, std::uint32_t vertex) {
    if (shares.reach[control] != Reach::free || shares.reach[vertex] == Reach::at_rest) return;
    patches[shares.patch[control]].weights.push_back(
        {shares.place[vertex], shares.place[control], limit.neighbour_weight(vertex)});
  };
  for (const auto& [a, b] : finest.edges) {
    add(a, b);
    add(b, a);
  }
}

// The faces of each patch, and the vertices at rest of those.
void add_faces(const relax::SubdividedLevel& finest, Shares& shares,
               std::vector<UntanglingPatch>& patches) {
  for (const Triangle& t : finest.triangles) {
    const auto moving =
        std::ranges::find_if(t, [&](std::uint32_t v) { return shares.reach[v] != Reach::at_rest; });
    if (moving != t.end()) patches[shares.patch[*moving]].faces.push_back(t);
  }
  for (std::uint32_t number = 0; number < patches.size(); ++number)
    for (Triangle& t : patches[number].faces)
      for (std::uint32_t& v : t) {
        // Several patches may have a vertex at rest: it is this one's for now.
        if (shares.patch[v] != number) {
          add_vertex(v, shares, patches[number]);
          shares.patch[v] = number;
        }
        v = shares.place[v];
      }
}

}  // namespace

std::vector<UntanglingPatch> untangling_patches(const relax::SubdividedLevel& finest,
                                                const LimitOperator& limit,
                                                const std::vector<std::uint8_t>& held,
                                                const std::vector<std::uint32_t>& faces,
                                                int rings) {
  Shares shares;
  shares.reach = find_reach(finest, held, faces, rings);
  std::vector<UntanglingPatch> patches = share_out(finest, shares);
  add_weights(finest, limit, shares, patches);
  add_faces(finest, shares, patches);
  return patches;
}

}  // namespace zerotree::fit
