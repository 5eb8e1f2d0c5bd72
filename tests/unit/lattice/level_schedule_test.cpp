// Only the levels that changed are made anew.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lattice/level_schedule.h"
#include "surface_shapes.h"

namespace zerotree::test {
namespace {

using surface::LatticeMesh;
using surface::LatticePoints;
using surface::LevelDetails;
using surface::LevelSchedule;
using surface::PointF;

constexpr int kLevels = 4;

/// Details of all levels in one channel, which the test may change.
class Details {
 public:
  explicit Details(std::size_t base_edges) {
    for (int level = 0; level < kLevels; ++level) {
      auto& values = values_[static_cast<std::size_t>(level)];
      values.resize(base_edges << (2 * level));
      for (std::size_t cell = 0; cell < values.size(); ++cell) set(level, cell, int(cell % 7) - 3);
      LevelDetails& details = details_[static_cast<std::size_t>(level)];
      details.channels[0].narrow = values.data();
      details.units.fill(0.01f * std::pow(0.4f, static_cast<float>(level)));
    }
  }
  void set(int level, std::size_t cell, int value) {
    values_[static_cast<std::size_t>(level)][cell] = static_cast<std::int16_t>(value);
  }
  std::span<const LevelDetails> levels() const { return details_; }

 private:
  std::array<std::vector<std::int16_t>, kLevels> values_;
  std::array<LevelDetails, kLevels> details_;
};

class ChangedLevels : public testing::TestWithParam<Shape> {
 protected:
  ChangedLevels()
      : base_(topology_of(GetParam())),
        edges_(bitstream::number_base_edges(base_).edges),
        mesh_(base_, edges_, std::pmr::get_default_resource()),
        positions_(positions_of(GetParam().mesh)),
        details_(edges_.size()) {}

  surface::SurfaceSource source() const {
    return {positions_, details_.levels(), surface::mean_face_area(base_, positions_)};
  }
  std::vector<float> surface(LevelSchedule& schedule) {
    std::vector<float> positions(
        3 * surface::refined_counts({base_.vertex_count, edges_.size(), base_.triangles.size()},
                                    kLevels)
                .vertices);
    EXPECT_TRUE(schedule.write_limits(kLevels, source(), {{positions.data()}, {}}, {}));
    return positions;
  }

  bitstream::BaseTopology base_;
  std::vector<bitstream::BaseEdge> edges_;
  LatticeMesh mesh_;
  surface::Positions positions_;
  Details details_;
};

// Points that a test has put into coarser levels stay there, so nobody has made these anew.
TEST_P(ChangedLevels, AreMadeAnewAndNoCoarserOnes) {
  for (int changed = 0; changed < kLevels; ++changed) {
    SCOPED_TRACE(changed);
    LevelSchedule schedule(mesh_, {}, std::pmr::get_default_resource());
    const std::vector<float> before = surface(schedule);
    details_.set(changed, 0, 90 + changed);  // on a base edge, so every base has it
    schedule.invalidate(changed);
    // The level that the details are added to is read, those before are not.
    const PointF mark{1e6f, 2e6f, 3e6f};
    for (int level = 0; level < changed; ++level)
      const_cast<LatticePoints&>(schedule.points(level)).set(0, 1, mark);
    // What was in the finer levels is overwritten.
    for (int level = changed + 1; level <= kLevels; ++level)
      const_cast<LatticePoints&>(schedule.points(level)).set(0, 1, mark);
    const std::vector<float> after = surface(schedule);
    for (int level = 0; level < changed; ++level)
      EXPECT_EQ(schedule.points(level).get(0, 1).y, mark.y) << "level " << level;
    EXPECT_NE(before, after);
    LevelSchedule fresh(mesh_, {}, std::pmr::get_default_resource());
    EXPECT_EQ(surface(fresh), after);
  }
}

TEST_P(ChangedLevels, AreNoneWithoutAChange) {
  LevelSchedule schedule(mesh_, {}, std::pmr::get_default_resource());
  const std::vector<float> before = surface(schedule);
  const PointF mark{1e6f, 2e6f, 3e6f};
  for (int level = 0; level < kLevels; ++level)
    const_cast<LatticePoints&>(schedule.points(level)).set(0, 1, mark);
  EXPECT_EQ(surface(schedule), before);
  schedule.invalidate(kLevels);
  EXPECT_EQ(surface(schedule), before);
  schedule.invalidate(-1);
  EXPECT_EQ(surface(schedule), before);
  EXPECT_NE(schedule.points(0).get(0, 1).y, mark.y);
}

INSTANTIATE_TEST_SUITE_P(Shapes, ChangedLevels, testing::ValuesIn(base_shapes()),
                         [](const auto& shape) { return shape.param.name; });

}  // namespace
}  // namespace zerotree::test
