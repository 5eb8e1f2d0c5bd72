#include "domain/base_size.h"

#include <algorithm>
#include <cmath>

namespace zerotree::domain {
namespace {

// Vertices of a base that shows a shape's limbs: these, and so many times the cube root of the
// complexity. Complexity grows with the square of the number of folds or the thinness of limbs, and
// thin things take only a part of the base; this fits what remeshes of ten scans did best with.
constexpr double kVerticesOfAnyShape = 19;
constexpr double kVerticesPerRootComplexity = 10;
// The shape of a coarse mesh is known no better than this: one base vertex in 70 (four levels), or
// in 17 (three) up to 90 of them.
constexpr double kInputPerBaseVertex = 70;
constexpr double kInputPerSmallBaseVertex = 17;
constexpr double kSmallBase = 90;
// What topology needs so that no vertex is left with a valence of 3 or 4, about.
constexpr std::uint32_t kVerticesPerClosedComponent = 6;
constexpr std::uint32_t kVerticesPerLoop = 3;
constexpr std::uint32_t kVerticesPerHandle = 6;

// Up to so many input faces the finest mesh may have the larger share; from twice as many on the
// smaller one, as dense scans hold less detail per face.
constexpr double kSparseFaces = 200'000;
constexpr double kSparseRatio = 3.9;
constexpr double kDenseRatio = 1.5;
// A mesh of few faces has larger angles than the smooth limit surface of so few points can follow.
constexpr double kLeastFaces = 2000;
// Where features and limbs hold a base up, the finest mesh may have so many times those faces, or
// so many times the input's.
constexpr double kBaseTolerance = 1.5;
constexpr double kMostRatio = 3;
constexpr int kMaxLevels = 12;
// The error of a remesh of full depth in units of the discretisation error, as measured on scans,
// and what one level changes.
constexpr double kErrorOfFullDepth = 0.7;
constexpr double kErrorPerLevel = 3;
// Quantisation takes its part of the error that is asked for.
constexpr double kShareOfRemesh = 0.6;
constexpr int kLeastReducedLevels = 2;
// From this error on, in units of the discretisation error, a smaller base makes smaller files.
constexpr double kCoarseError = 1.75;

std::vector<std::uint32_t> component_of_faces(const TriangleTopology& topology,
                                              std::uint32_t& count) {
  std::vector<std::uint32_t> component(topology.faces.size(), kNone);
  std::vector<std::uint32_t> stack;
  count = 0;
  for (std::uint32_t first = 0; first < component.size(); ++first) {
    if (component[first] != kNone) continue;
    component[first] = count;
    stack.push_back(first);
    while (!stack.empty()) {
      const std::uint32_t face = stack.back();
      stack.pop_back();
      for (std::uint32_t next : topology.adjacent[face]) {
        if (next == kNone || component[next] != kNone) continue;
        component[next] = count;
        stack.push_back(next);
      }
    }
    ++count;
  }
  return component;
}

// The boundary edge after edge `k` of `face`, around the same loop.
Corner next_boundary_edge(const TriangleTopology& topology, Corner edge) {
  const std::uint32_t end = topology.faces[edge.face][kNext[edge.corner]];
  Corner next{edge.face, kNext[edge.corner]};
  while (topology.adjacent[next.face][next.corner] != kNone) {
    const std::uint32_t face = topology.adjacent[next.face][next.corner];
    next = {face, corner_of(topology.faces[face], end)};
  }
  return next;
}

void count_boundaries(const TriangleTopology& topology, const std::vector<std::uint32_t>& component,
                      std::vector<ComponentCounts>& counts) {
  std::vector<std::uint8_t> seen(topology.faces.size(), 0);
  for (std::uint32_t f = 0; f < topology.faces.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      if (topology.adjacent[f][k] != kNone || ((seen[f] >> k) & 1) != 0) continue;
      ComponentCounts& count = counts[component[f]];
      ++count.boundary_loops;
      for (Corner e{f, k}; ((seen[e.face] >> e.corner) & 1) == 0;
           e = next_boundary_edge(topology, e)) {
        seen[e.face] = static_cast<std::uint8_t>(seen[e.face] | (1 << e.corner));
        ++count.boundary_edges;
      }
    }
}

std::uint32_t genus_of(const ComponentCounts& count) {
  const std::int64_t edges = (3 * std::int64_t{count.faces} + count.boundary_edges) / 2;
  const std::int64_t euler = std::int64_t{count.vertices} - edges + count.faces;
  return static_cast<std::uint32_t>((2 - std::int64_t{count.boundary_loops} - euler) / 2);
}

std::uint32_t fixed_vertices(const ComponentCounts& count) {
  const std::uint32_t closed = count.boundary_loops == 0 ? kVerticesPerClosedComponent : 0;
  return std::min(count.vertices, closed + count.corners + kVerticesPerLoop * count.boundary_loops +
                                      kVerticesPerHandle * count.genus);
}

// Vertices that show the shape, beside those for features and topology. The root is found in whole
// numbers, so that it is the same on every machine.
double shape_base_size(double complexity) {
  double root = 0;
  const double cube = kVerticesPerRootComplexity * kVerticesPerRootComplexity *
                      kVerticesPerRootComplexity * complexity;
  while ((root + 1) * (root + 1) * (root + 1) <= cube) ++root;
  return kVerticesOfAnyShape + root;
}

// ... and as many as a mesh of so many vertices can have a use for.
double known_base_size(double vertices, double fixed) {
  const double known = std::max(vertices / kInputPerBaseVertex,
                                std::min(vertices / kInputPerSmallBaseVertex, kSmallBase));
  return std::floor(std::max(known - fixed, known / 2));
}

// The largest base of at most so many faces, with triangles for boundary loops.
double vertices_for_faces(const DomainReport& topology, double faces) {
  const double euler = 2.0 * topology.components - topology.boundary_loops - 2.0 * topology.genus;
  return (faces + 3.0 * topology.boundary_loops) / 2 + euler;
}

}  // namespace

std::vector<ComponentCounts> count_components(const TriangleTopology& topology,
                                              const std::vector<VertexKind>& kinds) {
  std::uint32_t component_count = 0;
  const std::vector<std::uint32_t> component = component_of_faces(topology, component_count);
  std::vector<ComponentCounts> counts(component_count);
  for (std::uint32_t c : component) ++counts[c].faces;
  for (std::uint32_t v = 0; v < topology.face_of_vertex.size(); ++v) {
    ComponentCounts& count = counts[component[topology.face_of_vertex[v]]];
    ++count.vertices;
    if (!kinds.empty() && kinds[v] == VertexKind::corner) ++count.corners;
  }
  count_boundaries(topology, component, counts);
  for (ComponentCounts& count : counts) count.genus = genus_of(count);
  return counts;
}

void sum_topology(const std::vector<ComponentCounts>& components, DomainReport& report) {
  report.components = static_cast<std::uint32_t>(components.size());
  report.boundary_loops = report.corners = report.genus = 0;
  for (const ComponentCounts& count : components) {
    report.boundary_loops += count.boundary_loops;
    report.corners += count.corners;
    report.genus += count.genus;
  }
}

std::uint32_t fixed_base_size(const std::vector<ComponentCounts>& components) {
  std::uint32_t sum = 0;
  for (const ComponentCounts& count : components) sum += fixed_vertices(count);
  return sum;
}

std::uint32_t automatic_base_size(const std::vector<ComponentCounts>& components, double complexity,
                                  const AccuracyGoal& goal) {
  DomainReport topology;
  sum_topology(components, topology);
  std::uint32_t vertices = 0;
  std::size_t faces = 0;
  for (const ComponentCounts& count : components) {
    vertices += count.vertices;
    faces += count.faces;
  }
  const double fixed = fixed_base_size(components);
  const double needed =
      fixed + std::min(shape_base_size(complexity), known_base_size(vertices, fixed));
  if (goal.discretisation_error > 0 && goal.max_error > kCoarseError * goal.discretisation_error)
    return std::min(vertices, static_cast<std::uint32_t>(needed));
  double base_faces = finest_face_limit(faces) / 4;
  double allowed = vertices_for_faces(topology, base_faces);
  for (int levels = 2; levels <= kMaxLevels; ++levels) {
    base_faces /= 4;
    const double coarser = vertices_for_faces(topology, base_faces);
    if (coarser < needed) break;
    allowed = coarser;
  }
  return std::min(vertices, static_cast<std::uint32_t>(std::max(needed, allowed)));
}

double finest_face_limit(std::size_t input_faces) {
  const auto faces = static_cast<double>(input_faces);
  const double density = std::clamp(faces / kSparseFaces - 1, 0.0, 1.0);
  return std::max(kLeastFaces, (kSparseRatio + density * (kDenseRatio - kSparseRatio)) * faces);
}

int automatic_levels(std::size_t base_faces, std::size_t input_faces, const AccuracyGoal& goal) {
  const double limit = std::max(kBaseTolerance * finest_face_limit(input_faces),
                                kMostRatio * static_cast<double>(input_faces));
  double faces = 4.0 * static_cast<double>(base_faces);
  int levels = 1;
  for (; levels < kMaxLevels && (faces < kLeastFaces || 4 * faces <= limit); ++levels) faces *= 4;
  if (goal.max_error <= 0 || goal.discretisation_error <= 0) return levels;
  if (goal.max_error < goal.discretisation_error) return std::min(levels + 1, kMaxLevels);
  double coarser = kErrorPerLevel * kErrorOfFullDepth * goal.discretisation_error;
  for (; levels > kLeastReducedLevels && coarser <= kShareOfRemesh * goal.max_error; --levels)
    coarser *= kErrorPerLevel;
  return levels;
}

std::size_t largest_base_of_same_depth(std::size_t base_faces, std::size_t input_faces) {
  const int levels = automatic_levels(base_faces, input_faces, {});
  const double faces = kBaseTolerance * finest_face_limit(input_faces) / std::pow(4.0, levels);
  return std::max(base_faces, static_cast<std::size_t>(faces));
}

}  // namespace zerotree::domain
