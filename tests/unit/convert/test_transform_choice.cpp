#include "convert/transform_choice.h"

#include <gtest/gtest.h>

#include "bumpy_model.h"

namespace zerotree::convert {
namespace {

report::ConvertReport report_of(TransformChoice choice, const test::BumpyModel& model,
                                surface::WaveletTransform& made) {
  ConvertOptions options;
  options.transform = choice;
  options.glb = "payload.glb";  // its base stays outside the stream, in any order
  report::StageClock clock;
  report::ConvertReport report;
  report.remeshing_error = 1e-4;
  const AnalysedModel analysed =
      analyse_with_choice(test::bumpy_model(), options, model.how, clock, report, {});
  made = analysed.model.hierarchy->transform();
  EXPECT_EQ(report.transform, transform_name(made));
  EXPECT_EQ(analysed.wavelets.details.size(), 3u);
  return report;
}

TEST(TransformChoice, TakesWhatWasAskedForWithoutMeasuring) {
  const test::BumpyModel model;
  surface::WaveletTransform made;
  EXPECT_EQ(report_of(TransformChoice::local, model, made).transform_errors.local, 0);
  EXPECT_EQ(made, surface::WaveletTransform::loop_local);
  EXPECT_EQ(report_of(TransformChoice::mirror, model, made).transform_errors.mirror, 0);
  EXPECT_EQ(made, surface::WaveletTransform::loop_quadrature_mirror);
}

TEST(TransformChoice, TakesTheOneWithTheSmallerMeasuredErrors) {
  const test::BumpyModel model;
  surface::WaveletTransform made;
  const report::TransformErrors errors =
      report_of(TransformChoice::automatic, model, made).transform_errors;
  EXPECT_GT(errors.local, 0);
  EXPECT_GT(errors.mirror, 0);
  EXPECT_NE(errors.local, errors.mirror);
  EXPECT_EQ(made == surface::WaveletTransform::loop_quadrature_mirror,
            errors.mirror < errors.local);
}

}  // namespace
}  // namespace zerotree::convert
