#include "analysis/wavelet_analysis.h"

#include <string>
#include <utility>

#include "analysis/level_split.h"
#include "mesh/error.h"

namespace zerotree::analysis {

namespace {

void check_points(const surface::SubdivisionHierarchy& hierarchy, const Points& points) {
  const std::size_t expected = hierarchy.level(hierarchy.levels()).vertex_count;
  if (points.size() != expected)
    throw Error(ExitCode::internal, "wavelet analysis got " + std::to_string(points.size()) +
                                        " control points for a level of " +
                                        std::to_string(expected) + " vertices");
  for (std::size_t vertex = 0; vertex < points.size(); ++vertex)
    if (!points[vertex].allFinite())
      throw Error(ExitCode::internal,
                  "control point " + std::to_string(vertex) + " of the remesh is not finite");
}

CoarseAndDetails split_level(const surface::SubdivisionHierarchy& hierarchy, int number,
                             const Points& fine, const AnalysisOptions& options) {
  const SplitOptions split{options.tolerance, options.most_iterations, options.threads};
  const surface::SubdivisionLevel& level = hierarchy.level(number);
  switch (hierarchy.transform()) {
    case surface::WaveletTransform::loop_quadrature_mirror:
      return split_by_columns(level, fine, split);
    case surface::WaveletTransform::loop_local:
      return split_by_elimination(level, fine, split);
  }
  throw Error(ExitCode::internal, "wavelet analysis: unknown transform");
}

}  // namespace

WaveletDecomposition analyse(const surface::SubdivisionHierarchy& hierarchy,
                             const Points& finest_control_points, const AnalysisOptions& options,
                             const Progress& progress) {
  check_points(hierarchy, finest_control_points);
  const int levels = hierarchy.levels();
  const auto finest_count = static_cast<double>(finest_control_points.size());
  WaveletDecomposition decomposition;
  decomposition.details.resize(static_cast<std::size_t>(levels));
  Points points = finest_control_points;
  for (int number = levels - 1; number >= 0; --number) {
    report_progress(progress, "wavelet analysis",
                    1.0 - static_cast<double>(points.size()) / finest_count);
    CoarseAndDetails split = split_level(hierarchy, number, points, options);
    decomposition.details[static_cast<std::size_t>(number)] = std::move(split.details);
    points = std::move(split.coarse);
  }
  decomposition.base_control_points = std::move(points);
  report_progress(progress, "wavelet analysis", 1.0);
  return decomposition;
}

WaveletDecomposition analyse(const bitstream::BaseTopology& base, int levels,
                             const Points& finest_control_points, const AnalysisOptions& options,
                             const Progress& progress) {
  return analyse(surface::SubdivisionHierarchy(base, levels, options.transform),
                 finest_control_points, options, progress);
}

}  // namespace zerotree::analysis
