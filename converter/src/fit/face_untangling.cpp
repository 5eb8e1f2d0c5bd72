#include "fit/face_untangling.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/limited_memory_bfgs.h"

namespace zerotree::fit {
namespace {

// Rounds of looking for the input's points beside the faces, without gain, and iterations in
// between: few, because the layout shall change no more than it must.
constexpr int kPatience = 20;
constexpr int kIterations = 3;
// The longest step, in units of the mean edge.
constexpr double kLongestStep = 0.5;
// How far areas are kept from zero: a share of the mean one and of the worst negative one.
constexpr double kLeastArea = 1e-3;
constexpr double kNegativeShare = 0.2;

// The faces and vertices of a patch as the input shapes them, fixed for some iterations.
struct PatchTargets {
  Points face_normals;        // zero: the face has no side
  Points feet, foot_normals;  // of vertices; normal zero: it is not held
  double firmness = 0;
  double mean_area = 0;
  double least_area = 0;  // the regularisation
  std::uint32_t turned_faces = 0;
};

// The same on every machine, which std::hypot is not.
double length_of(double x, double y) {
  return std::sqrt(x * x + y * y);
}

Eigen::Vector3d area_vector(const Points& p, const Triangle& t) {
  return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]) / 2;
}

// The distortion of a face: its squared edges by its area, 1 if it is equilateral. A negative area
// counts as a small positive one.
double add_distortion(const PatchTargets& targets, std::size_t face, const Triangle& t,
                      const Points& limit, Points& gradient) {
  const Eigen::Vector3d& normal = targets.face_normals[face];
  if (normal.isZero(0)) return 0;
  const Eigen::Vector3d &a = limit[t[0]], &b = limit[t[1]], &c = limit[t[2]];
  const double edges = ((a - b).squaredNorm() + (b - c).squaredNorm() + (c - a).squaredNorm()) /
                       (4 * std::numbers::sqrt3);
  const double area = normal.dot(area_vector(limit, t));
  const double root = length_of(area, targets.least_area);
  const double regular =
      area > 0 ? (area + root) / 2 : targets.least_area * targets.least_area / (2 * (root - area));
  const double by_edges = 1 / regular;
  const double by_area = -edges / (regular * regular) * (1 + area / root) / 2;
  const auto add = [&](std::uint32_t at, const Eigen::Vector3d& next, const Eigen::Vector3d& last) {
    gradient[at] += by_edges / (2 * std::numbers::sqrt3) * (2 * limit[at] - next - last) +
                    by_area / 2 * (next - last).cross(normal);
  };
  add(t[0], b, c);
  add(t[1], c, a);
  add(t[2], a, b);
  return edges / regular;
}

double patch_energy(const UntanglingPatch& patch, const PatchTargets& targets, const Points& limit,
                    Points& gradient) {
  gradient.assign(limit.size(), Eigen::Vector3d::Zero());
  double energy = 0;
  for (std::size_t f = 0; f < patch.faces.size(); ++f)
    energy += add_distortion(targets, f, patch.faces[f], limit, gradient);
  const double weight = targets.firmness / targets.mean_area;
  for (std::size_t v = 0; v < limit.size(); ++v) {
    const Eigen::Vector3d& normal = targets.foot_normals[v];
    if (normal.isZero(0)) continue;
    const Eigen::Vector3d off = limit[v] - targets.feet[v];
    // Off the surface twice: on sharp bends the way to the foot may be across its normal.
    const Eigen::Vector3d pull = normal.dot(off) * normal + off;
    energy += weight * pull.dot(off);
    gradient[v] += 2 * weight * pull;
  }
  return energy;
}

// Where limit positions go if the free control points move by `moves`.
Points moved(const UntanglingPatch& patch, const Points& limit, const Points& moves) {
  Points result = limit;
  for (const UntanglingPatch::Weight& w : patch.weights)
    result[w.vertex] += w.weight * moves[w.control];
  return result;
}

// Where a patch lies.
struct PatchState {
  std::vector<relax::SurfacePoint> feet;
  Points limit;
  Points moves;  // of the free control points, since the beginning
};

void lead_feet(const InputOrientation& orientation, PatchState& state) {
  const relax::InputSurface& input = orientation.input();
  for (std::size_t v = 0; v < state.feet.size(); ++v) {
    relax::SurfacePoint& foot = state.feet[v];
    if (!orientation.is_on_feature(foot))
      foot = relax::walk_on_surface(input, foot, state.limit[v] - input.position(foot));
  }
}

void find_targets(const InputOrientation& orientation, const UntanglingPatch& patch,
                  double corner_share, const PatchState& state, PatchTargets& targets) {
  const Points& limit = state.limit;
  targets.feet.assign(limit.size(), Eigen::Vector3d::Zero());
  targets.foot_normals.assign(limit.size(), Eigen::Vector3d::Zero());
  for (std::size_t v = 0; v < limit.size(); ++v) {
    if (orientation.is_on_feature(state.feet[v])) continue;
    targets.feet[v] = orientation.input().position(state.feet[v]);
    targets.foot_normals[v] = orientation.smooth_normal(state.feet[v]);
  }
  targets.turned_faces = 0;
  double sum = 0, least = 0;
  targets.face_normals.assign(patch.faces.size(), Eigen::Vector3d::Zero());
  for (std::size_t f = 0; f < patch.faces.size(); ++f) {
    const Eigen::Vector3d area = area_vector(limit, patch.faces[f]);
    sum += area.norm();
    relax::SurfacePoint point;
    if (!orientation.find_point(state.feet, limit, patch.faces[f], point)) continue;
    targets.turned_faces += orientation.opposes(point, area);
    targets.face_normals[f] = orientation.smooth_normal(point);
    for (std::uint32_t v : patch.faces[f])
      targets.face_normals[f] += corner_share * targets.foot_normals[v];
    targets.face_normals[f].stableNormalize();
    least = std::min(least, targets.face_normals[f].dot(area));
  }
  targets.mean_area = sum / static_cast<double>(patch.faces.size());
  targets.least_area = length_of(kLeastArea * targets.mean_area, kNegativeShare * least);
}

// Minimises the energy of fixed targets for some iterations.
void lay_out(const UntanglingPatch& patch, const PatchTargets& targets, PatchState& state) {
  Points force;
  const Energy energy = [&](const Points& moves, Points& gradient) {
    const double value = patch_energy(patch, targets, moved(patch, state.limit, moves), force);
    std::ranges::fill(gradient, Eigen::Vector3d::Zero());
    for (const UntanglingPatch::Weight& w : patch.weights)
      gradient[w.control] += w.weight * force[w.vertex];
    return value;
  };
  Points moves(patch.free_count, Eigen::Vector3d::Zero());
  minimise(energy, kIterations, kLongestStep * std::sqrt(targets.mean_area), moves);
  state.limit = moved(patch, state.limit, moves);
  for (std::size_t v = 0; v < moves.size(); ++v) state.moves[v] += moves[v];
}

}  // namespace

std::uint32_t untangle(const InputOrientation& orientation, const UntanglingPatch& patch,
                       const UntanglingWeights& weights, std::vector<relax::SurfacePoint>& feet,
                       Points& limit, Points& points) {
  PatchState state, best;
  for (std::uint32_t v : patch.vertices) {
    state.feet.push_back(feet[v]);
    state.limit.push_back(limit[v]);
  }
  state.moves.assign(patch.free_count, Eigen::Vector3d::Zero());
  PatchTargets targets;
  targets.firmness = weights.firmness;
  std::uint32_t least = 0;
  int last_gain = 0;
  for (int round = 0; round - last_gain <= kPatience; ++round) {
    find_targets(orientation, patch, weights.corner_share, state, targets);
    if (round == 0 || targets.turned_faces < least) {
      least = targets.turned_faces;
      best = state;
      last_gain = round;
    }
    if (least == 0) break;
    lay_out(patch, targets, state);
    lead_feet(orientation, state);
  }
  for (std::uint32_t v = 0; v < patch.moving_count; ++v) {
    feet[patch.vertices[v]] = best.feet[v];
    limit[patch.vertices[v]] = best.limit[v];
    if (v < patch.free_count) points[patch.vertices[v]] += best.moves[v];
  }
  return least;
}

}  // namespace zerotree::fit
