#include "remesh/limb_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace zerotree::remesh {
namespace {

constexpr int kMostRounds = 20;
// Surface of so many times the mean density is squeezed.
constexpr double kSqueezed = 4;
// A round pins at most one vertex for so many of the base.
constexpr std::size_t kBasePerPin = 40;
// More pins are worth it if they lower the energy to this share; give up after so many rounds that
// did not.
constexpr double kGain = 0.95;
constexpr int kPatience = 8;

// Surface and domain area around a vertex.
struct StarAreas {
  double surface = 0, domain = 0;
};

}  // namespace

SpreadReport measure_spread(const domain::Domain& domain, const Parameterisation& laid_out,
                            std::size_t most) {
  const ConeCharts& charts = laid_out.charts;
  double total = 0;
  std::vector<StarAreas> stars(domain.kinds.size());
  const std::size_t faces = charts.topology.faces.size();
  std::vector<double> surface(faces), inside(faces);
  for (std::uint32_t f = 0; f < faces; ++f) {
    const Triangle& t = charts.topology.faces[f];
    const std::vector<Eigen::Vector3d>& p = domain.mesh.positions;
    surface[f] = (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm();
    inside[f] = lattice_area(charts.corner_point(f, 0), charts.corner_point(f, 1),
                             charts.corner_point(f, 2));
    total += surface[f];
    for (std::uint32_t v : t) {
      stars[v].surface += surface[f];
      stars[v].domain += inside[f];
    }
  }
  const double mean = total / static_cast<double>(laid_out.base.topology.triangles.size());
  SpreadReport report;
  report.energy = 0;
  for (std::uint32_t f = 0; f < faces; ++f)
    report.energy += surface[f] / total * (surface[f] / mean) / std::max(inside[f], 1e-12);

  struct Candidate {
    double loss;
    std::uint32_t vertex;
  };
  std::vector<Candidate> candidates;
  for (std::uint32_t v = 0; v < stars.size(); ++v) {
    if (stars[v].surface <= 0 || charts.vertices[v].cone != kNone) continue;
    const double density = stars[v].surface / mean / std::max(stars[v].domain, 1e-12);
    if (density > kSqueezed) candidates.push_back({density * stars[v].surface, v});
  }
  std::ranges::sort(candidates, [](const Candidate& a, const Candidate& b) {
    return a.loss != b.loss ? a.loss > b.loss : a.vertex < b.vertex;
  });
  std::vector<std::uint8_t> taken(laid_out.base.topology.triangles.size(), 0);
  for (const Candidate& candidate : candidates) {
    if (report.squeezed.size() == most) break;
    std::uint8_t& is_taken = taken[charts.vertices[candidate.vertex].triangle];
    if (is_taken) continue;
    is_taken = 1;
    report.squeezed.push_back(candidate.vertex);
  }
  return report;
}

std::vector<std::uint32_t> pin_limbs(domain::Domain& domain, std::size_t most_base_faces,
                                     const Progress& progress) {
  const std::size_t most = std::max<std::size_t>(1, domain.report.base_vertices / kBasePerPin);
  domain::DomainOptions options;
  std::vector<std::uint32_t> best;
  double least = std::numeric_limits<double>::infinity();
  int without_gain = 0;
  // Pinned vertices may keep others, until the base is too large.
  for (int round = 0; round < kMostRounds && domain.base_faces.size() <= most_base_faces; ++round) {
    const Parameterisation laid_out = parameterise(domain, progress);
    if (laid_out.stuck > 0) {
      options.pinned_vertices.push_back(domain.collapses[laid_out.stuck - 1].removed);
    } else {
      const SpreadReport spread = measure_spread(domain, laid_out, most);
      const bool is_gain = spread.energy < kGain * least;
      without_gain = is_gain ? 0 : without_gain + 1;
      if (is_gain) {
        least = spread.energy;
        best = options.pinned_vertices;
      }
      if (spread.squeezed.empty() || without_gain == kPatience) break;
      options.pinned_vertices.insert(options.pinned_vertices.end(), spread.squeezed.begin(),
                                     spread.squeezed.end());
    }
    std::ranges::sort(options.pinned_vertices);
    domain::rebuild_base(domain, options, 0, progress);
  }
  if (best != options.pinned_vertices) {
    options.pinned_vertices = best;
    domain::rebuild_base(domain, options, 0, progress);
  }
  return best;
}

}  // namespace zerotree::remesh
