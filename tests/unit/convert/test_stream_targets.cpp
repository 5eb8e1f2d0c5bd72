// Streams that must meet an error, a size or both.
#include "convert/stream_targets.h"

#include <gtest/gtest.h>

#include <string>

#include "bumpy_model.h"
#include "mesh/error.h"

namespace zerotree::convert {
namespace {

using test::BumpyModel;

constexpr double kStep = 2e-3, kShortestStep = 1e-6;

RefinableStream stream_of(const BumpyModel& model, double step, double shortest_step) {
  return {[&model](double finest) { return model.encode(finest); }, step * model.how.diagonal,
          shortest_step * model.how.diagonal, model.how};
}

// As a JSON does, what is written beside the stream depends on it.
std::uint64_t written_size(const MeasuredStream& stream) {
  return stream.file.bytes.size() + 200 + stream.table.prefixes.size() * 8 +
         stream.file.bytes.size() % 7;
}

MeasuredStream cut(RefinableStream& stream, const StreamTargets& targets,
                   report::ReachedTargets& reached, double remeshing_error = 0) {
  return meet_targets(stream, targets, written_size, remeshing_error, reached, {});
}

// The message of the refusal, which must have exit code 5.
std::string refusal(RefinableStream stream, const StreamTargets& targets,
                    double remeshing_error = 0) {
  report::ReachedTargets reached;
  try {
    cut(stream, targets, reached, remeshing_error);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::target_not_reachable);
    return error.what();
  }
  ADD_FAILURE() << "not refused";
  return "";
}

TEST(StreamTargets, MeetAnErrorWithTheShortestPrefix) {
  const BumpyModel model;
  // The second is not reached without finer steps.
  for (const double asked : {2e-3, 5e-5}) {
    RefinableStream stream = stream_of(model, kStep, kShortestStep);
    report::ReachedTargets reached;
    const MeasuredStream result = cut(stream, {asked, 0}, reached);
    const std::uint64_t bytes = result.file.bytes.size();
    const double error = stream.errors().error(bytes, Precision::exact);
    EXPECT_LE(error, asked);
    EXPECT_EQ(reached.reached_error, error);
    EXPECT_EQ(result.table.prefixes.back().error, error);
    for (const double part : {0.8, 0.97})
      EXPECT_GT(stream.errors().error(static_cast<std::uint64_t>(part * static_cast<double>(bytes)),
                                      Precision::exact),
                asked)
          << part;
    EXPECT_EQ(reached.finest_step < 0.75 * kStep, asked < 1e-3);
  }
}

TEST(StreamTargets, FillASizeAndNeverPassIt) {
  const BumpyModel model;
  double before = 1;
  for (const std::uint64_t size : {700u, 1001u, 2400u}) {
    RefinableStream stream = stream_of(model, kStep, kShortestStep);
    report::ReachedTargets reached;
    const MeasuredStream result = cut(stream, {0, size}, reached);
    EXPECT_EQ(reached.reached_size, written_size(result));
    EXPECT_LE(reached.reached_size, size);
    EXPECT_GE(static_cast<double>(reached.reached_size), 0.98 * static_cast<double>(size));
    EXPECT_LT(reached.reached_error, before);
    before = reached.reached_error;
  }
}

TEST(StreamTargets, TellOfASizeThatNothingFills) {
  const BumpyModel model;
  RefinableStream stream = stream_of(model, kStep, kStep / 3);
  report::ReachedTargets reached;
  const MeasuredStream result = cut(stream, {0, 1'000'000}, reached);
  EXPECT_TRUE(reached.is_whole_stream);
  EXPECT_EQ(result.file.bytes.size(), stream.file().bytes.size());
  // As the stream holds it: rounded down by up to 0.8 %.
  EXPECT_NEAR(reached.finest_step, kStep / 2, 0.004 * kStep);
}

TEST(StreamTargets, HoldBothOrSayWhatTheSizeReaches) {
  const BumpyModel model;
  RefinableStream stream = stream_of(model, kStep, kShortestStep);
  report::ReachedTargets reached;
  cut(stream, {2e-3, 0}, reached);
  const std::uint64_t needed = reached.reached_size;
  EXPECT_NO_THROW(cut(stream, {2e-3, needed}, reached));
  const std::string message = refusal(stream_of(model, kStep, kShortestStep), {2e-3, needed - 60});
  EXPECT_NE(message.find("takes " + std::to_string(needed)), std::string::npos) << message;
  EXPECT_NE(message.find("which reach about 0.0"), std::string::npos) << message;
}

TEST(StreamTargets, RefuseWhatCannotBe) {
  const BumpyModel model;
  const std::string error = refusal(stream_of(model, kStep, kStep), {1e-6, 0}, 1e-4);
  EXPECT_NE(error.find("the remesh without any rounding about 0.0001"), std::string::npos) << error;
  const std::string size = refusal(stream_of(model, kStep, kStep), {0, 200});
  EXPECT_NE(size.find("do not even hold the base mesh, which takes 2"), std::string::npos) << size;
}

}  // namespace
}  // namespace zerotree::convert
