#include "convert/prefix_table.h"

namespace zerotree::convert {
namespace {

// Bits per vertex, doubling from one to the other.
constexpr double kLowestRate = 1.0 / 4, kHighestRate = 8;
// Of the diagonal: prefixes between two of the table, and points of the limit surface between the
// vertices, may reach a little further.
constexpr double kBoundsMargin = 0.005;

}  // namespace

std::vector<std::uint64_t> table_lengths(std::uint64_t stream_bytes, std::uint64_t vertices) {
  std::vector<std::uint64_t> lengths;
  for (double rate = kLowestRate; rate <= kHighestRate; rate *= 2) {
    const auto bytes = static_cast<std::uint64_t>(rate * static_cast<double>(vertices) / 8);
    if (bytes >= stream_bytes) break;
    if (bytes > 0 && (lengths.empty() || bytes > lengths.back())) lengths.push_back(bytes);
  }
  lengths.push_back(stream_bytes);
  return lengths;
}

PrefixTable measure_prefixes(PrefixErrors& errors, std::uint64_t stream_bytes, Precision last,
                             const Progress& progress) {
  const auto lengths = table_lengths(stream_bytes, errors.how().original_vertices);
  PrefixTable table;
  // An external base has a surface before the first byte, and first details may reach far.
  table.bounds = errors.box_before(lengths.front());
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    report_progress(progress, "measuring prefixes",
                    static_cast<double>(i) / static_cast<double>(lengths.size()));
    const bool is_last = i + 1 == lengths.size();
    const auto& measured = errors.at(lengths[i], is_last ? last : Precision::quick);
    if (!measured) continue;
    table.bounds.extend(measured->box);
    table.prefixes.push_back(measured->error);
  }
  const auto margin = static_cast<float>(kBoundsMargin * errors.how().diagonal);
  table.bounds.min().array() -= margin;
  table.bounds.max().array() += margin;
  return table;
}

}  // namespace zerotree::convert
