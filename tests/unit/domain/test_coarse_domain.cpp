// The coarse end of a domain as a mesh of its own, and the passes that lead there.
#include "domain/coarse_domain.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "shapes.h"

namespace zerotree::domain {
namespace {

Domain bumpy_sphere(int levels, std::uint32_t base_vertices) {
  DomainOptions options;
  options.base_vertices = base_vertices;
  options.crease_angle_degrees = 180;
  return build_domain(test::add_noise(test::sphere(levels), 0.1, 3), options, {});
}

void undo_down_to(std::size_t keep, Domain& domain) {
  std::vector<std::uint32_t> fan;
  for (; domain.collapses.size() > keep; domain.collapses.pop_back())
    undo_collapse(domain.topology, domain.collapses.back(), fan);
}

TEST(CoarseDomain, IsTheMeshAfterTheFirstCollapses) {
  Domain fine = bumpy_sphere(4, 20);
  const std::size_t keep = fine.collapses.size() - 200;
  const CoarseDomain coarse = extract_coarse(fine, keep);
  EXPECT_EQ(coarse.vertices.size(), fine.kinds.size() - keep);
  EXPECT_EQ(coarse.domain.collapses.size(), 200u);
  EXPECT_EQ(coarse.domain.base_faces.size(), fine.base_faces.size());
  undo_down_to(keep, fine);
  for (std::size_t f = 0; f < coarse.faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(coarse.vertices[coarse.domain.mesh.triangles[f][k]],
                fine.topology.faces[coarse.faces[f]][k]);
    }
  for (std::size_t v = 0; v < coarse.vertices.size(); ++v)
    EXPECT_EQ(coarse.domain.mesh.positions[v], fine.mesh.positions[coarse.vertices[v]]);
}

// It is a domain like any other: its own undo leads to its mesh, and it can get another base.
TEST(CoarseDomain, CanBeUndoneAndBuiltAgain) {
  const Domain fine = bumpy_sphere(4, 20);
  CoarseDomain coarse = extract_coarse(fine, fine.collapses.size() - 200);
  DomainOptions options;
  options.pinned_vertices = {5, 50};
  rebuild_base(coarse.domain, options, 0, {});
  for (const CollapseRecord& collapse : coarse.domain.collapses)
    EXPECT_TRUE(collapse.removed != 5 && collapse.removed != 50);
  undo_down_to(0, coarse.domain);
  EXPECT_EQ(coarse.domain.topology.faces, coarse.domain.mesh.triangles);
  EXPECT_EQ(build_topology(static_cast<std::uint32_t>(coarse.vertices.size()),
                           coarse.domain.mesh.triangles)
                .adjacent,
            coarse.domain.topology.adjacent);
}

TEST(CoarseDomain, FindsItsOwnVerticesOnly) {
  const Domain fine = bumpy_sphere(3, 20);
  const CoarseDomain coarse = extract_coarse(fine, fine.collapses.size());
  const std::uint32_t gone = fine.collapses.front().removed;
  std::vector<std::uint32_t> asked{gone, coarse.vertices[3], coarse.vertices[7]};
  std::ranges::sort(asked);
  EXPECT_EQ(to_coarse(coarse, asked), (std::vector<std::uint32_t>{3, 7}));
}

// Within a pass, the first to the last instead of the last to the first.
TEST(CollapsePasses, CanBeUndoneInAnyOrder) {
  Domain domain = bumpy_sphere(5, 20);
  ASSERT_FALSE(domain.passes.empty());
  std::vector<std::uint32_t> fan;
  std::size_t end = domain.collapses.size();
  for (auto pass = domain.passes.rbegin(); pass != domain.passes.rend(); ++pass) {
    for (; end > pass->end; --end) undo_collapse(domain.topology, domain.collapses[end - 1], fan);
    for (std::size_t i = pass->begin; i < pass->end; ++i)
      undo_collapse(domain.topology, domain.collapses[i], fan);
    end = pass->begin;
  }
  EXPECT_EQ(end, 0u);
  EXPECT_EQ(domain.topology.faces, domain.mesh.triangles);
  const TriangleTopology whole = build_topology(
      static_cast<std::uint32_t>(domain.mesh.positions.size()), domain.mesh.triangles);
  EXPECT_EQ(domain.topology.adjacent, whole.adjacent);
}

// Large enough that collapses are chosen part by part.
TEST(CollapsePasses, AreTheSameForAnyNumberOfThreads) {
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return bumpy_sphere(6, 40);
  };
  const Domain one = with_threads(1), three = with_threads(3);
  EXPECT_EQ(one.topology.faces, three.topology.faces);
  ASSERT_EQ(one.passes.size(), three.passes.size());
  for (std::size_t i = 0; i < one.passes.size(); ++i)
    ASSERT_EQ(one.passes[i].end, three.passes[i].end);
}

}  // namespace
}  // namespace zerotree::domain
