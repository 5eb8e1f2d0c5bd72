#include "relax/relaxation_steps.h"

#include <Eigen/Geometry>
#include <cmath>

namespace zerotree::relax {
namespace {

// Of a Jacobi step; from 0.9 on the finest waves grow.
constexpr double kDamping = 0.6;
// The longest step, in units of the mean edge at the vertex.
constexpr double kLongestStep = 0.3;
// The least weight of a face, in units of the mean one.
constexpr double kLeastWeight = 1e-6;

// area^(5/4): large triangles pull harder and shrink. More evens out the areas at the cost of
// smoothness; 1 would starve limbs. By square roots, which are the same on every machine.
double weight_of_area(double relative_area) {
  return relative_area * std::sqrt(std::sqrt(relative_area)) + kLeastWeight;
}

void remove_normal_part(Eigen::Vector3d& v, const Eigen::Vector3d& normal) {
  v -= normal.dot(v) * normal;
}

}  // namespace

// The weights of the faces and the normals of the vertices.
void RelaxationSteps::weigh_faces(const SurfaceVertices& vertices) {
  const std::vector<Triangle>& triangles = vertices.connectivity().triangles;
  const std::vector<Eigen::Vector3d>& positions = vertices.positions();
  steps_.normals.assign(vertices.size(), Eigen::Vector3d::Zero());
  face_weights_.resize(triangles.size());
  double sum = 0;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const Triangle& t = triangles[f];
    const Eigen::Vector3d normal =
        (positions[t[1]] - positions[t[0]]).cross(positions[t[2]] - positions[t[0]]);
    face_weights_[f] = normal.norm();
    sum += face_weights_[f];
    for (std::uint32_t v : t) steps_.normals[v] += normal;
  }
  for (Eigen::Vector3d& normal : steps_.normals) normal = unit(normal);
  const double mean = sum > 0 ? sum / static_cast<double>(triangles.size()) : 1;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const auto [a, b, c] = triangles[f];
    const float density = (vertices.density(a) + vertices.density(b) + vertices.density(c)) / 3;
    face_weights_[f] = weight_of_area(face_weights_[f] / mean) * static_cast<double>(density);
  }
}

// Force and stiffness of every vertex: of the surface, or of the curve for vertices on one.
void RelaxationSteps::gather_forces(const SurfaceVertices& vertices) {
  const SubdividedLevel& work = vertices.connectivity();
  const std::vector<Eigen::Vector3d>& positions = vertices.positions();
  std::vector<Eigen::Vector3d>& forces = steps_.steps;
  forces.assign(vertices.size(), Eigen::Vector3d::Zero());
  stiffness_.assign(vertices.size(), 0.0);
  for (std::size_t f = 0; f < work.triangles.size(); ++f) {
    const Triangle& t = work.triangles[f];
    const Eigen::Vector3d sum = positions[t[0]] + positions[t[1]] + positions[t[2]];
    for (std::uint32_t v : t) {
      if (vertices.freedom(v) != Freedom::surface) continue;
      forces[v] += face_weights_[f] * (sum - 3 * positions[v]);
      stiffness_[v] += 2 * face_weights_[f];
    }
  }
  for (std::size_t v = 0; v < forces.size(); ++v)
    if (vertices.freedom(v) == Freedom::surface) remove_normal_part(forces[v], steps_.normals[v]);
  for (std::size_t e = 0; e < work.edges.size(); ++e) {
    if (!work.is_feature[e]) continue;
    const auto [a, b] = work.edges[e];
    const Eigen::Vector3d edge = positions[b] - positions[a];
    const auto pull = [&](std::uint32_t v, const Eigen::Vector3d& force) {
      if (vertices.freedom(v) != Freedom::curve) return;
      forces[v] += force;
      stiffness_[v] += 1;
    };
    pull(a, edge);
    pull(b, -edge);
  }
}

// Sums what the finer vertices feel into those of `level`; curves feel only curves.
void RelaxationSteps::restrict_to(const SurfaceVertices& vertices, int level) {
  std::vector<Eigen::Vector3d>& forces = steps_.steps;
  const std::vector<Eigen::Vector3d>& normals = steps_.normals;
  for (int l = vertices.level() - 1; l >= level; --l) {
    const SubdividedLevel& coarse = vertices.connectivity(l);
    for (std::size_t e = 0; e < coarse.edges.size(); ++e) {
      const std::size_t odd = coarse.vertex_count + e;
      for (std::uint32_t end : coarse.edges[e]) {
        const bool on_surface = vertices.freedom(end) == Freedom::surface;
        if (!on_surface && !coarse.is_feature[e]) continue;
        if (on_surface)
          forces[end] += transported(forces[odd], normals[odd], normals[end]) / 2;
        else
          forces[end] += forces[odd] / 2;
        stiffness_[end] += stiffness_[odd] / 2;
      }
    }
  }
}

void RelaxationSteps::scale(const SurfaceVertices& vertices, int level) {
  const SubdividedLevel& coarse = vertices.connectivity(level);
  lengths_.assign(coarse.vertex_count, 0.0);
  valences_.assign(coarse.vertex_count, 0);
  for (const auto& [a, b] : coarse.edges) {
    const double length = (vertices.positions()[b] - vertices.positions()[a]).norm();
    for (std::uint32_t v : {a, b}) {
      lengths_[v] += length;
      ++valences_[v];
    }
  }
  // Galerkin: the stiffness of a hat on a surface is the mean of the 4^depth that were summed; on a
  // curve it is a 2^depth-th of the mean of 2^depth.
  const double summed = static_cast<double>(std::uint64_t{1} << (2 * (vertices.level() - level)));
  for (std::size_t v = 0; v < coarse.vertex_count; ++v) {
    Eigen::Vector3d& step = steps_.steps[v];
    if (vertices.freedom(v) == Freedom::none || !(stiffness_[v] > 0)) {
      step.setZero();
      continue;
    }
    step *= kDamping * summed / stiffness_[v];
    if (vertices.freedom(v) == Freedom::surface) remove_normal_part(step, steps_.normals[v]);
    const double longest = kLongestStep * lengths_[v] / valences_[v];
    const double length = step.norm();
    if (length > longest) step *= longest / length;
  }
}

void RelaxationSteps::prolong(const SurfaceVertices& vertices, int level) {
  std::vector<Eigen::Vector3d>& steps = steps_.steps;
  const std::vector<Eigen::Vector3d>& normals = steps_.normals;
  for (int l = level; l < vertices.level(); ++l) {
    const SubdividedLevel& coarse = vertices.connectivity(l);
    for (std::size_t e = 0; e < coarse.edges.size(); ++e) {
      const auto [a, b] = coarse.edges[e];
      const std::size_t odd = coarse.vertex_count + e;
      if (vertices.freedom(odd) == Freedom::surface)
        steps[odd] = (transported(steps[a], normals[a], normals[odd]) +
                      transported(steps[b], normals[b], normals[odd])) /
                     2;
      else
        steps[odd] = (steps[a] + steps[b]) / 2;
    }
  }
}

const Steps& RelaxationSteps::towards_means(const SurfaceVertices& vertices, int level) {
  weigh_faces(vertices);
  gather_forces(vertices);
  restrict_to(vertices, level);
  scale(vertices, level);
  prolong(vertices, level);
  return steps_;
}

const Steps& RelaxationSteps::towards_prediction(const SurfaceVertices& vertices, double share) {
  const SubdividedLevel& coarse = vertices.connectivity(vertices.level() - 1);
  const std::vector<Eigen::Vector3d>& positions = vertices.positions();
  weigh_faces(vertices);
  std::vector<Eigen::Vector3d>& steps = steps_.steps;
  steps.assign(vertices.size(), Eigen::Vector3d::Zero());
  for (std::size_t f = 0; f < coarse.triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t e = coarse.face_edges[f][k];
      if (!coarse.is_feature[e])
        steps[coarse.vertex_count + e] += positions[coarse.triangles[f][(k + 2) % 3]] / 8;
    }
  for (std::size_t e = 0; e < coarse.edges.size(); ++e) {
    const auto [a, b] = coarse.edges[e];
    const std::size_t odd = coarse.vertex_count + e;
    const double of_ends = coarse.is_feature[e] ? 0.5 : 0.375;
    steps[odd] += of_ends * (positions[a] + positions[b]);
    steps[odd] = share * (steps[odd] - positions[odd]);
    if (vertices.freedom(odd) == Freedom::surface)
      remove_normal_part(steps[odd], steps_.normals[odd]);
  }
  return steps_;
}

}  // namespace zerotree::relax
