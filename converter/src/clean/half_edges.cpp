#include "clean/half_edges.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

namespace zerotree::clean {
namespace {

constexpr std::size_t kGrain = 4096;

// The half-edges of each lower vertex, one list after the other, as keys of the higher vertex and
// the half-edge.
struct KeyLists {
  std::vector<std::uint32_t> begin;  // per vertex, and the end of the last
  std::vector<std::uint64_t> keys;
};

KeyLists list_keys(const std::vector<Triangle>& triangles, std::size_t vertex_count) {
  KeyLists lists;
  lists.begin.assign(vertex_count + 1, 0);
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) ++lists.begin[std::min(t[k], t[k == 2 ? 0 : k + 1]) + 1];
  std::partial_sum(lists.begin.begin(), lists.begin.end(), lists.begin.begin());
  lists.keys.resize(3 * triangles.size());
  std::vector<std::uint32_t> fill(lists.begin.begin(), lists.begin.end() - 1);
  std::uint32_t h = 0;
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k, ++h) {
      const auto [lower, higher] = std::minmax({t[k], t[k == 2 ? 0 : k + 1]});
      lists.keys[fill[lower]++] = (std::uint64_t{higher} << 32) | h;
    }
  return lists;
}

}  // namespace

EdgeTable make_edge_table(const std::vector<Triangle>& triangles, std::size_t vertex_count) {
  KeyLists lists = list_keys(triangles, vertex_count);
  const auto at = [&](std::size_t v) { return lists.keys.begin() + lists.begin[v]; };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, vertex_count, kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t v = range.begin(); v != range.end(); ++v)
                        std::sort(at(v), at(v + 1));
                    });
  EdgeTable table;
  table.half_edges.reserve(lists.keys.size());
  table.first.reserve(lists.keys.size() / 2 + 1);
  for (std::size_t v = 0; v < vertex_count; ++v)
    for (std::uint32_t i = lists.begin[v]; i < lists.begin[v + 1]; ++i) {
      if (i == lists.begin[v] || lists.keys[i] >> 32 != lists.keys[i - 1] >> 32)
        table.first.push_back(i);
      table.half_edges.push_back(static_cast<std::uint32_t>(lists.keys[i]));
    }
  table.first.push_back(static_cast<std::uint32_t>(lists.keys.size()));
  return table;
}

std::vector<std::uint32_t> find_mates(const std::vector<Triangle>& triangles,
                                      std::size_t vertex_count) {
  return find_mates(make_edge_table(triangles, vertex_count));
}

std::vector<std::uint32_t> find_mates(const EdgeTable& table) {
  std::vector<std::uint32_t> mates(table.half_edges.size(), no_half_edge);
  for (std::size_t e = 0; e < table.edge_count(); ++e) {
    if (table.first[e + 1] - table.first[e] != 2) continue;
    const std::uint32_t a = table.half_edges[table.first[e]];
    const std::uint32_t b = table.half_edges[table.first[e] + 1];
    mates[a] = b;
    mates[b] = a;
  }
  return mates;
}

}  // namespace zerotree::clean
