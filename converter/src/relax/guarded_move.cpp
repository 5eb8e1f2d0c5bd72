#include "relax/guarded_move.h"

#include <algorithm>

#include "relax/parallel_loop.h"

namespace zerotree::relax {
namespace {

// Vertices that went back try again so often, each time with a half, a quarter, an eighth of their
// step until one is possible.
constexpr int kRetries = 2;
constexpr int kShares = 3;

}  // namespace

void GuardedMove::move(SurfaceVertices& vertices, const Steps& steps) {
  before_.resize(vertices.size());
  for_each_index(vertices.size(), [&](std::size_t v) {
    before_[v] = vertices.points()[v];
    vertices.walk(v, steps.steps[v], steps.normals[v]);
  });
  take_back(vertices);
  retry(vertices, steps);
}

void GuardedMove::move_alone(SurfaceVertices& vertices, const Steps& steps,
                             const std::vector<std::uint32_t>& some) {
  is_back_.assign(vertices.size(), 0);
  for (std::uint32_t v : some) is_back_[v] = 1;
  back_ = some;
  retry(vertices, steps);
}

bool GuardedMove::was_positive(const SurfaceVertices& vertices, const Triangle& t) const {
  return vertices.is_positive(before_[t[0]], before_[t[1]], before_[t[2]]);
}

void GuardedMove::take_back(SurfaceVertices& vertices) {
  const std::vector<Triangle>& triangles = vertices.connectivity().triangles;
  is_back_.assign(vertices.size(), 0);
  is_dirty_.assign(vertices.size(), 1);
  is_turned_.resize(triangles.size());
  back_.clear();
  for (bool again = true; again;) {
    for_each_index(triangles.size(), [&](std::size_t f) {
      const auto any = [&](const std::vector<std::uint8_t>& flags) {
        return flags[triangles[f][0]] || flags[triangles[f][1]] || flags[triangles[f][2]];
      };
      is_turned_[f] = any(is_dirty_) && !vertices.is_positive(triangles[f]) &&
                      was_positive(vertices, triangles[f]);
    });
    std::ranges::fill(is_dirty_, std::uint8_t{0});
    again = false;
    for (std::size_t f = 0; f < triangles.size(); ++f) {
      if (!is_turned_[f]) continue;
      for (std::uint32_t v : triangles[f]) {
        if (is_back_[v]) continue;
        vertices.put(v, before_[v]);
        is_back_[v] = is_dirty_[v] = 1;
        back_.push_back(v);
        again = true;
      }
    }
  }
  rejected_ += back_.size();
}

void GuardedMove::gather_faces(const SurfaceVertices& vertices) {
  const std::vector<Triangle>& triangles = vertices.connectivity().triangles;
  std::vector<std::uint32_t> slot(vertices.size(), 0);
  first_face_.assign(back_.size() + 1, 0);
  for (std::uint32_t i = 0; i < back_.size(); ++i) slot[back_[i]] = i;
  const auto for_each_corner = [&](const auto& function) {
    for (std::uint32_t f = 0; f < triangles.size(); ++f)
      for (std::uint32_t v : triangles[f])
        if (is_back_[v]) function(slot[v], f);
  };
  for_each_corner([&](std::uint32_t i, std::uint32_t) { ++first_face_[i + 1]; });
  for (std::size_t i = 0; i < back_.size(); ++i) first_face_[i + 1] += first_face_[i];
  faces_.resize(first_face_.back());
  std::vector<std::uint32_t> fill(first_face_.begin(), first_face_.end() - 1);
  for_each_corner([&](std::uint32_t i, std::uint32_t f) { faces_[fill[i]++] = f; });
}

void GuardedMove::retry(SurfaceVertices& vertices, const Steps& steps) {
  if (back_.empty()) return;
  std::ranges::sort(back_);
  gather_faces(vertices);
  for (int pass = 0; pass < kRetries; ++pass)
    for (std::uint32_t i = 0; i < back_.size(); ++i) try_alone(vertices, steps, i);
}

// Takes the largest allowed part of the step of back_[index], if there is one.
bool GuardedMove::try_alone(SurfaceVertices& vertices, const Steps& steps,
                            std::uint32_t index) const {
  const std::uint32_t v = back_[index];
  const std::vector<Triangle>& triangles = vertices.connectivity().triangles;
  const SurfacePoint start = vertices.points()[v];
  const auto count_turned = [&] {
    return std::count_if(faces_.begin() + first_face_[index],
                         faces_.begin() + first_face_[index + 1],
                         [&](std::uint32_t f) { return !vertices.is_positive(triangles[f]); });
  };
  const auto turned = count_turned();
  double share = 0.5;
  for (int i = 0; i < kShares; ++i, share /= 2) {
    vertices.walk(v, share * steps.steps[v], steps.normals[v]);
    if (count_turned() <= turned) return true;
    vertices.put(v, start);
  }
  return false;
}

}  // namespace zerotree::relax
