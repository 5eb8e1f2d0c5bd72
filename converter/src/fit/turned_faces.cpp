#include "fit/turned_faces.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "fit/face_untangling.h"
#include "fit/input_orientation.h"
#include "fit/stray_faces.h"
#include "fit/untangling_patch.h"
#include "relax/parallel_loop.h"

namespace zerotree::fit {
namespace {

// How many rings around turned faces are laid out anew, and how. Small patches that are held firmly
// change the least; where all that is near is folded, larger and looser ones find a way out, and
// sharp bends are seen first as round ones, then as they are.
struct Attempt {
  int rings;
  UntanglingWeights weights;
};
constexpr std::array<Attempt, 4> kAttempts{
    {{2, {300, 3}}, {3, {30, 3}}, {2, {300, 0}}, {3, {30, 0}}}};

// A patch of more faces has been lost by the base mesh: laying it out takes long and finds nothing.
constexpr std::size_t kMostFacesOfPatch = 1000;

// If more faces than this stay turned after the first attempt, they lie in limbs that the base has
// lost: others would take long and find little, but that long faces do harm enough to go on.
constexpr std::size_t kMostTurned = 1000;

// The turned ones among the faces that have a marked vertex.
std::vector<std::uint32_t> find_turned(const InputOrientation& orientation,
                                       const relax::SubdividedLevel& finest,
                                       const std::vector<relax::SurfacePoint>& feet,
                                       const Points& limit,
                                       const std::vector<std::uint8_t>& marks) {
  std::vector<std::uint8_t> flags(finest.triangles.size());
  relax::for_each_index(flags.size(), [&](std::size_t f) {
    const Triangle& t = finest.triangles[f];
    flags[f] = (marks[t[0]] || marks[t[1]] || marks[t[2]]) && orientation.is_turned(feet, limit, t);
  });
  std::vector<std::uint32_t> turned;
  for (std::uint32_t f = 0; f < flags.size(); ++f)
    if (flags[f]) turned.push_back(f);
  return turned;
}

}  // namespace

std::uint32_t turn_faces_back(const InputOrientation& orientation,
                              const relax::SubdividedLevel& finest, const LimitOperator& limit,
                              const std::vector<std::uint8_t>& held,
                              std::vector<relax::SurfacePoint>& feet, Points& points) {
  Points at;
  limit.apply(points, at);
  std::vector<std::uint8_t> marks(points.size(), 1);
  std::vector<std::uint32_t> turned = find_turned(orientation, finest, feet, at, marks);
  std::vector<std::uint32_t> centres = turned;
  for (const auto& [rings, weights] : kAttempts) {
    if (centres.empty()) break;
    const std::vector<UntanglingPatch> patches =
        untangling_patches(finest, limit, held, centres, rings);
    tbb::parallel_for(std::size_t{0}, patches.size(), [&](std::size_t i) {
      if (patches[i].faces.size() <= kMostFacesOfPatch)
        untangle(orientation, patches[i], weights, feet, at, points);
    });
    // Only what has moved may have changed.
    std::ranges::fill(marks, std::uint8_t{0});
    for (std::uint32_t f : turned)
      for (std::uint32_t v : finest.triangles[f]) marks[v] = 1;
    for (const UntanglingPatch& patch : patches)
      for (std::uint32_t i = 0; i < patch.moving_count; ++i) marks[patch.vertices[i]] = 1;
    turned = find_turned(orientation, finest, feet, at, marks);
    centres = turned.size() > kMostTurned ? find_long_faces(finest, at, turned) : turned;
  }
  return static_cast<std::uint32_t>(turned.size());
}

}  // namespace zerotree::fit
