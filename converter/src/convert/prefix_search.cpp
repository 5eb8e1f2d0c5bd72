#include "convert/prefix_search.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "convert/prefix_table.h"

namespace zerotree::convert {
namespace {

// Lengths closer than this, relative, are not told apart.
constexpr double kResolution = 0.003;
// An error between this part of the one asked for and that is close enough.
constexpr double kCloseEnough = 0.997;
// Where shorter prefixes are looked at that might be exact enough too.
constexpr double kShorter[] = {0.968, 0.976, 0.984, 0.992};
constexpr int kMostSteps = 40, kMostRounds = 3;

std::uint64_t scaled(std::uint64_t bytes, double factor) {
  return static_cast<std::uint64_t>(std::llround(static_cast<double>(bytes) * factor));
}

// Quick measurements, corrected by what the last exact one showed: both see the same places that a
// remesh cannot follow, whose share of the squared error hardly depends on the prefix.
class Search {
 public:
  Search(PrefixErrors& errors, double max_error, const Progress& progress)
      : errors_(errors), max_error_(max_error), progress_(progress) {}

  /// A length whose corrected error is close to that asked for or, if it jumps there, the first
  /// behind the jump. `too_short` may be 0; `enough` looks so.
  std::uint64_t between(std::uint64_t too_short, std::uint64_t enough);
  /// The same over the whole stream, starting from the lengths that its table has anyway.
  std::uint64_t from_table();
  /// The same near `bytes`.
  std::uint64_t near(std::uint64_t bytes);

  bool looks_enough(std::uint64_t bytes) { return relative(bytes) <= 1; }
  /// Of the error asked for.
  double exact(std::uint64_t bytes);

 private:
  double relative(std::uint64_t bytes);

  PrefixErrors& errors_;
  double max_error_;
  const Progress& progress_;
  double correction_ = 0;
  int count_ = 0;
};

double Search::relative(std::uint64_t bytes) {
  // Nobody knows how many there will be: ever smaller steps.
  report_progress(progress_, "searching the shortest prefix", 1 - 1 / (1 + 0.2 * ++count_));
  const double error = errors_.error(bytes, Precision::quick);
  return std::sqrt(std::max(0.0, error * error + correction_)) / max_error_;
}

double Search::exact(std::uint64_t bytes) {
  const double exact = errors_.error(bytes, Precision::exact);
  if (!std::isfinite(exact)) return exact;
  const double quick = errors_.error(bytes, Precision::quick);
  correction_ = exact * exact - quick * quick;
  return exact / max_error_;
}

std::uint64_t Search::between(std::uint64_t too_short, std::uint64_t enough) {
  int same_side = 0;  // how often in a row the same end moved: then the other one is brought in
  for (int step = 0; step < kMostSteps; ++step) {
    const std::uint64_t width = enough - too_short;
    if (width <= std::max<std::uint64_t>(1, scaled(enough, kResolution))) break;
    const double above = too_short > 0 ? std::log(relative(too_short)) : HUGE_VAL;
    const double below = std::log(relative(enough));
    if (below >= std::log(kCloseEnough)) break;
    // Errors are about a power of the length.
    double part = 0.5;
    if (std::isfinite(above) && above > below && std::abs(same_side) < 2) {
      const double goal = std::log((1 + kCloseEnough) / 2);
      part = std::clamp((above - goal) / (above - below), 0.02, 0.98);
    }
    const double ratio =
        static_cast<double>(enough) / static_cast<double>(std::max<std::uint64_t>(1, too_short));
    const std::uint64_t guess =
        std::isfinite(above) ? scaled(too_short, std::pow(ratio, part)) : too_short + width / 2;
    const std::uint64_t middle = std::clamp(guess, too_short + 1, enough - 1);
    const bool is_enough = looks_enough(middle);
    (is_enough ? enough : too_short) = middle;
    same_side = is_enough ? std::max(1, same_side + 1) : std::min(-1, same_side - 1);
  }
  return enough;
}

std::uint64_t Search::from_table() {
  const std::vector<std::uint64_t> lengths =
      table_lengths(errors_.stream_bytes(), errors_.how().original_vertices);
  const auto first_enough =
      std::partition_point(lengths.begin(), lengths.end() - 1,
                           [&](std::uint64_t bytes) { return !looks_enough(bytes); });
  return between(first_enough == lengths.begin() ? 0 : *(first_enough - 1), *first_enough);
}

std::uint64_t Search::near(std::uint64_t bytes) {
  const std::uint64_t whole = errors_.stream_bytes();
  std::uint64_t low = bytes, high = bytes;
  if (looks_enough(bytes)) {
    while (low > 1 && looks_enough(low)) low = std::min(low - 1, scaled(low, 0.96));
  } else {
    while (high < whole && !looks_enough(high)) high = std::min(whole, scaled(high, 1.04) + 1);
  }
  return between(low, high);
}

}  // namespace

std::uint64_t shortest_prefix(PrefixErrors& errors, double max_error, const Progress& progress) {
  const std::uint64_t whole = errors.stream_bytes();
  Search search(errors, max_error, progress);
  if (search.exact(whole) > 1) return whole;
  std::uint64_t found = search.from_table();
  for (int round = 0; round < kMostRounds; ++round) {
    const double exact = search.exact(found);
    if (exact <= 1 && exact >= kCloseEnough) break;
    found = search.near(found);
  }
  double step = kResolution;
  for (; found < whole && search.exact(found) > 1; step *= 1.5)
    found = std::min(whole, std::max(found + 1, scaled(found, 1 + step)));
  for (const double part : kShorter) {
    const std::uint64_t shorter = scaled(found, part);
    if (search.looks_enough(shorter) && search.exact(shorter) <= 1) return shorter;
  }
  return found;
}

}  // namespace zerotree::convert
