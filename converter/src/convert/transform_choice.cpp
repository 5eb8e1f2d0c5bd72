#include "convert/transform_choice.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "convert/prefix_table.h"
#include "mesh/error.h"

namespace zerotree::convert {
namespace {

using surface::WaveletTransform;

AnalysedModel analysed_by(WaveletTransform transform, SurfaceModel model,
                          const ConvertOptions& options, report::StageClock& clock,
                          const Progress& progress) {
  if (model.hierarchy->transform() != transform)
    model.hierarchy = clock.run("topology", [&] {
      return std::make_shared<const surface::SubdivisionHierarchy>(
          model.base, model.hierarchy->levels(), transform);
    });
  AnalysedModel result{std::move(model), {}};
  result.wavelets = analyse_model(result.model, options, clock, progress);
  return result;
}

struct Candidate {
  AnalysedModel analysed;
  std::vector<report::PrefixError> prefixes;
};

Candidate measured(AnalysedModel analysed, const ConvertOptions& options, PrefixMeasurement how,
                   double step, report::StageClock& clock, const Progress& progress) {
  how.hierarchy = analysed.model.hierarchy;
  const std::string name = transform_name(how.hierarchy->transform());
  std::vector<report::PrefixError> prefixes = clock.run("try " + name, [&] {
    const decode::StreamFile file =
        encode_model(analysed.model, analysed.wavelets, step * how.diagonal, options.glb.empty());
    PrefixErrors errors(file, how);
    return measure_prefixes(errors, file.bytes.size(), Precision::quick, progress).prefixes;
  });
  return {std::move(analysed), std::move(prefixes)};
}

// Over the rates that both reach; without any, over the whole streams.
report::TransformErrors mean_errors(const std::vector<report::PrefixError>& local,
                                    const std::vector<report::PrefixError>& mirror) {
  double local_sum = 0, mirror_sum = 0;
  int count = 0;
  for (const report::PrefixError& l : local)
    for (const report::PrefixError& m : mirror)
      if (l.bytes == m.bytes && l.error > 0 && m.error > 0) {
        local_sum += std::log(l.error);
        mirror_sum += std::log(m.error);
        ++count;
      }
  if (count == 0) return {local.back().error, mirror.back().error};
  return {std::exp(local_sum / count), std::exp(mirror_sum / count)};
}

}  // namespace

const char* transform_name(WaveletTransform transform) {
  return transform == WaveletTransform::loop_local ? "local" : "mirror";
}

AnalysedModel analyse_with_choice(SurfaceModel model, const ConvertOptions& options,
                                  const PrefixMeasurement& how, report::StageClock& clock,
                                  report::ConvertReport& report, const Progress& progress) {
  const auto analyse = [&](WaveletTransform transform, SurfaceModel from) {
    return analysed_by(transform, std::move(from), options, clock, progress);
  };
  const auto measure = [&](AnalysedModel analysed) {
    return measured(std::move(analysed), options, how, default_step(report.remeshing_error), clock,
                    progress);
  };
  AnalysedModel result;
  if (options.transform == TransformChoice::automatic) {
    Candidate local = measure(analyse(WaveletTransform::loop_local, model));
    try {
      Candidate mirror =
          measure(analyse(WaveletTransform::loop_quadrature_mirror, std::move(model)));
      report.transform_errors = mean_errors(local.prefixes, mirror.prefixes);
      if (report.transform_errors.mirror < report.transform_errors.local) local = std::move(mirror);
    } catch (const Error& error) {
      // Its analysis need not converge on a base of odd valences; the other one is there already.
      report.transform_note = std::string("mirror could not be tried: ") + error.what();
    }
    result = std::move(local.analysed);
  } else {
    result = analyse(options.transform == TransformChoice::mirror
                         ? WaveletTransform::loop_quadrature_mirror
                         : WaveletTransform::loop_local,
                     std::move(model));
  }
  report.transform = transform_name(result.model.hierarchy->transform());
  return result;
}

}  // namespace zerotree::convert
