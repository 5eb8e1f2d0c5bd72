// The table of measured prefixes and the bounds stated with it.
#include "convert/prefix_table.h"

#include <gtest/gtest.h>

#include "bumpy_model.h"

namespace zerotree::convert {
namespace {

TEST(PrefixErrors, BoxBeforeHoldsShortPrefixesAndNoMore) {
  const test::BumpyModel model;
  const decode::StreamFile stream = model.encode(2e-3 * model.how.diagonal);
  PrefixErrors errors(stream, model.how);
  ASSERT_GT(errors.stream_bytes(), 64u);
  Eigen::AlignedBox3f expected;
  for (const std::uint64_t bytes : {0, 1, 2, 4, 8, 16, 32})
    expected.extend(errors.at(bytes, Precision::quick)->box);
  const Eigen::AlignedBox3f found = errors.box_before(64);
  EXPECT_EQ(found.min(), expected.min());
  EXPECT_EQ(found.max(), expected.max());
  EXPECT_TRUE(errors.box_before(0).isEmpty());
}

}  // namespace
}  // namespace zerotree::convert
