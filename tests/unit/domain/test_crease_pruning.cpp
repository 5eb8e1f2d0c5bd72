#include "domain/crease_pruning.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace zerotree::domain {
namespace {

// A strong chain of 20 edges over the vertices 0 to 20.
std::vector<CreaseSegment> chain() {
  std::vector<CreaseSegment> segments;
  for (std::uint32_t v = 0; v < 20; ++v) segments.push_back({{v, v + 1}, 1.0, true});
  return segments;
}

std::size_t kept(const std::vector<CreaseSegment>& segments) {
  const auto stays = prune_weak_arcs(100, segments, {.min_length = 5});
  return static_cast<std::size_t>(std::ranges::count(stays, 1));
}

TEST(CreasePruning, TakesOffTwigsAndTreesOfThem) {
  std::vector<CreaseSegment> segments = chain();
  for (std::uint32_t v : {5u, 10u, 11u}) segments.push_back({{v, v + 50}, 1.0, false});
  segments.push_back({{60, 70}, 1.0, false});
  segments.push_back({{60, 71}, 1.0, false});
  EXPECT_EQ(kept(segments), 20u);
}

TEST(CreasePruning, TakesOffWeakShortcuts) {
  std::vector<CreaseSegment> segments = chain();
  segments.push_back({{5, 50}, 1.0, false});
  segments.push_back({{50, 7}, 1.0, false});
  EXPECT_EQ(kept(segments), 20u);
}

TEST(CreasePruning, KeepsWhatIsStrongOrLong) {
  std::vector<CreaseSegment> segments = chain();
  segments.push_back({{5, 50}, 1.0, true});
  for (std::uint32_t v = 60; v < 68; ++v)
    segments.push_back({{v == 60 ? 20 : v, v + 1}, 1.0, false});  // a crease that fades
  EXPECT_EQ(kept(segments), segments.size());
}

TEST(CreasePruning, KeepsClosedStrongRings) {
  std::vector<CreaseSegment> ring;
  for (std::uint32_t v = 0; v < 8; ++v) ring.push_back({{v, (v + 1) % 8}, 0.1, true});
  EXPECT_EQ(kept(ring), 8u);
  EXPECT_TRUE(prune_weak_arcs(0, {}, {}).empty());
}

}  // namespace
}  // namespace zerotree::domain
