// Whether an asset came back from a file as it was written.
#pragma once

#include <gtest/gtest.h>

#include "gltf/progressive_asset.h"

namespace zerotree::test {

inline void expect_equal(const gltf::ProgressiveAsset& a, const gltf::ProgressiveAsset& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.generator, b.generator);
  EXPECT_EQ(a.base.vertex_count, b.base.vertex_count);
  EXPECT_EQ(a.base.triangles, b.base.triangles);
  EXPECT_EQ(a.control_points, b.control_points);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.placement.scale, b.placement.scale);
  EXPECT_EQ(a.placement.translation, b.placement.translation);
  EXPECT_EQ(a.payload, b.payload);
  EXPECT_EQ(a.payload_length, b.payload_length);
  EXPECT_EQ(a.levels, b.levels);
  EXPECT_EQ(a.bounds_min, b.bounds_min);
  EXPECT_EQ(a.bounds_max, b.bounds_max);
  EXPECT_EQ(a.source_diagonal, b.source_diagonal);
  ASSERT_EQ(a.prefixes.size(), b.prefixes.size());
  for (std::size_t i = 0; i < a.prefixes.size(); ++i) {
    EXPECT_EQ(a.prefixes[i].byte_length, b.prefixes[i].byte_length);
    EXPECT_EQ(a.prefixes[i].geometric_error, b.prefixes[i].geometric_error);
  }
}

}  // namespace zerotree::test
