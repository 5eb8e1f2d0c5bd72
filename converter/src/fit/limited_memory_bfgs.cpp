#include "fit/limited_memory_bfgs.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

namespace zerotree::fit {
namespace {

// Pairs of steps and changes of the gradient that are remembered.
constexpr std::size_t kMemory = 8;
// Armijo's condition: the share of the expected gain that makes a step worth taking.
constexpr double kWorthwhile = 1e-4;
constexpr int kHalvings = 20;

double dot(const Points& a, const Points& b) {
  double sum = 0;
  for (std::size_t v = 0; v < a.size(); ++v) sum += a[v].dot(b[v]);
  return sum;
}

void add(double factor, const Points& from, Points& to) {
  for (std::size_t v = 0; v < to.size(); ++v) to[v] += factor * from[v];
}

struct Pair {
  Points step, change;
  double product;  // of the two: positive
};

// The two loops that apply the approximate inverse Hessian.
Points descent_direction(const std::deque<Pair>& memory, const Points& gradient) {
  Points direction = gradient;
  std::vector<double> shares(memory.size());
  for (std::size_t i = memory.size(); i-- > 0;) {
    shares[i] = dot(memory[i].step, direction) / memory[i].product;
    add(-shares[i], memory[i].change, direction);
  }
  const double scale =
      memory.empty() ? 1 : memory.back().product / dot(memory.back().change, memory.back().change);
  for (Eigen::Vector3d& d : direction) d *= -scale;
  for (std::size_t i = 0; i < memory.size(); ++i)
    add(-shares[i] - dot(memory[i].change, direction) / memory[i].product, memory[i].step,
        direction);
  return direction;
}

double longest(const Points& vectors) {
  double squared = 0;
  for (const Eigen::Vector3d& v : vectors) squared = std::max(squared, v.squaredNorm());
  return std::sqrt(squared);
}

}  // namespace

double minimise(const Energy& energy, int iterations, double longest_step, Points& points) {
  std::deque<Pair> memory;
  Points gradient(points.size()), next_gradient(points.size());
  double value = energy(points, gradient);
  for (int i = 0; i < iterations; ++i) {
    Points direction = descent_direction(memory, gradient);
    double slope = dot(direction, gradient);
    if (!(slope < 0)) {
      if (memory.empty()) return value;
      memory.clear();
      continue;
    }
    // The first direction has no scale of its own: it goes as far as it may.
    const double length = longest(direction);
    double step = memory.empty() ? longest_step / length : std::min(1.0, longest_step / length);
    Points next;
    double next_value = value;
    int halving = 0;
    for (; halving <= kHalvings; ++halving, step /= 2) {
      next = points;
      add(step, direction, next);
      next_value = energy(next, next_gradient);
      if (next_value <= value + kWorthwhile * step * slope) break;
    }
    if (halving > kHalvings) return value;
    Pair pair{next, next_gradient, 0};
    add(-1, points, pair.step);
    add(-1, gradient, pair.change);
    pair.product = dot(pair.step, pair.change);
    points = std::move(next);
    std::swap(gradient, next_gradient);
    value = next_value;
    // Only a pair of positive curvature keeps the approximation positive.
    if (pair.product >
        1e-12 * std::sqrt(dot(pair.step, pair.step) * dot(pair.change, pair.change))) {
      memory.push_back(std::move(pair));
      if (memory.size() > kMemory) memory.pop_front();
    }
  }
  return value;
}

}  // namespace zerotree::fit
