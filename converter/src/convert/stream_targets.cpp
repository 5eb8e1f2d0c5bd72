#include "convert/stream_targets.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "convert/prefix_search.h"
#include "mesh/error.h"

namespace zerotree::convert {
namespace {

// Finer steps help only while quantisation adds to the error: less than this part gained by half
// of the step is nothing.
constexpr double kLeastGain = 0.002;
// An error so far below the remesh's is out of reach of any step, however that was measured.
constexpr double kHopelessShare = 0.7;
// Part of a size that may be left unused where the JSON's length depends on the payload's.
constexpr double kUnusedShare = 0.002;
// The table's last error is measured again at the end and may take more digits then.
constexpr std::uint64_t kSpareBytes = 4;
constexpr int kMostRounds = 60;

std::string scientific(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

MeasuredStream measured(RefinableStream& stream, std::uint64_t bytes, double asked_error,
                        Precision last, const Progress& progress) {
  MeasuredStream result;
  result.file = stream.file();
  result.file.bytes.resize(std::min<std::uint64_t>(bytes, result.file.bytes.size()));
  result.table = measure_prefixes(stream.errors(), result.file.bytes.size(), last, progress);
  result.asked_error = asked_error;
  return result;
}

[[noreturn]] void refuse_error(double asked, double reached, double remeshing_error) {
  throw Error(ExitCode::target_not_reachable,
              "an error of " + scientific(asked) + " cannot be reached: the whole stream has " +
                  scientific(reached) + ", the remesh without any rounding about " +
                  scientific(remeshing_error) +
                  "; ask for a finer remesh (--levels, --base-vertices) or a larger error");
}

// Finer steps until the whole stream is exact enough.
void reach_error(RefinableStream& stream, double asked, double remeshing_error) {
  double before = std::numeric_limits<double>::infinity();
  for (;;) {
    const std::uint64_t whole = stream.file().bytes.size();
    const double error = stream.errors().error(whole, Precision::exact);
    if (error <= asked) return;
    const bool is_hopeless = asked < kHopelessShare * remeshing_error;
    if (is_hopeless || error > (1 - kLeastGain) * before || !stream.refine())
      refuse_error(asked, std::min(error, before), remeshing_error);
    before = error;
  }
}

[[noreturn]] void refuse_both(RefinableStream& stream, const StreamTargets& targets,
                              const MeasuredStream& cut, std::uint64_t written) {
  const std::uint64_t excess = written - targets.size, bytes = cut.file.bytes.size();
  const double reached = stream.errors().error(bytes - std::min(bytes, excess), Precision::quick);
  throw Error(ExitCode::target_not_reachable,
              "an error of " + scientific(targets.max_error) + " takes " + std::to_string(written) +
                  " bytes, and --target-size allows " + std::to_string(targets.size) +
                  (reached < 1 ? ", which reach about " + scientific(reached)
                               : ", which do not even hold the base mesh") +
                  ": raise --target-size or --max-error");
}

MeasuredStream cut_at_error(RefinableStream& stream, const StreamTargets& targets,
                            const WrittenSize& written_size, double remeshing_error,
                            const Progress& progress) {
  reach_error(stream, targets.max_error, remeshing_error);
  MeasuredStream cut =
      measured(stream, shortest_prefix(stream.errors(), targets.max_error, progress),
               targets.max_error, Precision::exact, progress);
  const std::uint64_t written = targets.size > 0 ? written_size(cut) : 0;
  if (written > targets.size) refuse_both(stream, targets, cut, written);
  return cut;
}

[[noreturn]] void refuse_size(std::uint64_t asked, std::uint64_t needed) {
  throw Error(ExitCode::target_not_reachable,
              "--target-size: " + std::to_string(asked) +
                  " bytes do not even hold the base mesh, which takes " + std::to_string(needed) +
                  ": allow more, or ask for fewer --base-vertices");
}

// The next length to try between the longest known to fit and the shortest known not to: what is
// left beside the rest if that were the same, otherwise the middle.
std::uint64_t next_length(std::uint64_t size, std::uint64_t beside, std::uint64_t fits,
                          std::uint64_t fits_not) {
  const std::uint64_t reserved = beside + std::min(beside, kSpareBytes);
  const std::uint64_t guess = size > reserved ? size - reserved : 1;
  return guess > fits && guess < fits_not ? guess : fits + (fits_not - fits) / 2;
}

// What is written beside a stream depends a little on it: a few rounds settle the length of the
// cut.
MeasuredStream cut_at_size(RefinableStream& stream, std::uint64_t size,
                           const WrittenSize& written_size, const Progress& progress) {
  const auto unused = static_cast<std::uint64_t>(kUnusedShare * static_cast<double>(size));
  Precision precision = Precision::quick;
  std::uint64_t fits = 0, fits_not = std::numeric_limits<std::uint64_t>::max(), limit = size;
  for (int round = 0; round < kMostRounds; ++round) {
    while (stream.file().bytes.size() < limit && stream.refine()) {
    }
    const std::uint64_t shortest =
        std::max<std::uint64_t>(1, stream.errors().shortest_with_surface());
    MeasuredStream cut = measured(stream, std::max(limit, shortest), 0, precision, progress);
    const std::uint64_t written = written_size(cut), bytes = cut.file.bytes.size();
    const bool is_settled =
        bytes < limit || written + unused + kSpareBytes >= size || bytes + 1 >= fits_not;
    if (written > size) {
      if (bytes <= shortest) refuse_size(size, written);
      fits_not = std::min(fits_not, bytes);
      limit = next_length(size, written - bytes, fits, fits_not);
    } else if (precision == Precision::exact) {
      return cut;
    } else if (is_settled) {
      precision = Precision::exact;
      limit = bytes;
      fits = 0;
    } else {
      fits = std::max(fits, bytes);
      limit = next_length(size, written - bytes, fits, fits_not);
    }
  }
  throw Error(ExitCode::internal, "--target-size: no length of the stream was found that fits");
}

}  // namespace

MeasuredStream meet_targets(RefinableStream& stream, const StreamTargets& targets,
                            const WrittenSize& written_size, double remeshing_error,
                            report::ReachedTargets& report, const Progress& progress) {
  MeasuredStream result;
  if (targets.max_error > 0)
    result = cut_at_error(stream, targets, written_size, remeshing_error, progress);
  else if (targets.size > 0)
    result = cut_at_size(stream, targets.size, written_size, progress);
  else
    result = measured(stream, stream.file().bytes.size(), 0, Precision::quick, progress);
  report.max_error = targets.max_error;
  report.size = targets.size;
  report.reached_error = result.table.prefixes.back().error;
  report.reached_size = written_size(result);
  report.finest_step = stream.step() / stream.errors().how().diagonal;
  report.is_whole_stream = result.file.bytes.size() == stream.file().bytes.size();
  return result;
}

}  // namespace zerotree::convert
