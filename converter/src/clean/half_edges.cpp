#include "clean/half_edges.h"

#include <algorithm>

namespace zerotree::clean {

EdgeTable make_edge_table(const std::vector<Triangle>& triangles, std::size_t vertex_count) {
  const auto count = static_cast<std::uint32_t>(triangles.size() * 3);
  const auto lower = [&](std::uint32_t h) {
    return std::min(tail_of(triangles, h), head_of(triangles, h));
  };
  const auto higher = [&](std::uint32_t h) {
    return std::max(tail_of(triangles, h), head_of(triangles, h));
  };
  std::vector<std::uint32_t> bucket(vertex_count + 1, 0);
  for (std::uint32_t h = 0; h < count; ++h) ++bucket[lower(h) + 1];
  for (std::size_t v = 0; v < vertex_count; ++v) bucket[v + 1] += bucket[v];

  EdgeTable table;
  table.half_edges.resize(count);
  std::vector<std::uint32_t> fill(bucket.begin(), bucket.end() - 1);
  for (std::uint32_t h = 0; h < count; ++h) table.half_edges[fill[lower(h)]++] = h;
  for (std::size_t v = 0; v < vertex_count; ++v)
    std::sort(table.half_edges.begin() + bucket[v], table.half_edges.begin() + bucket[v + 1],
              [&](std::uint32_t a, std::uint32_t b) {
                const std::uint32_t x = higher(a), y = higher(b);
                return x != y ? x < y : a < b;
              });
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t h = table.half_edges[i];
    const bool starts_edge = i == 0 || lower(table.half_edges[i - 1]) != lower(h) ||
                             higher(table.half_edges[i - 1]) != higher(h);
    if (starts_edge) table.first.push_back(i);
  }
  table.first.push_back(count);
  return table;
}

std::vector<std::uint32_t> find_mates(const std::vector<Triangle>& triangles,
                                      std::size_t vertex_count) {
  const EdgeTable table = make_edge_table(triangles, vertex_count);
  std::vector<std::uint32_t> mates(triangles.size() * 3, no_half_edge);
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
