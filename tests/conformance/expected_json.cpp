#include "expected_json.h"

#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bitstream/base_edges.h"
#include "conditioning.h"
#include "progressive/progressive_surface.h"
#include "surface/subdivision_hierarchy.h"

namespace zerotree::conformance {
namespace {

using bitstream::BaseTopology;
using bitstream::DecodeStatus;
using surface::ProgressiveSurface;

// A fifth of what decoders may differ by.
constexpr double kMostChange = 2e-6;

// The shortest decimals that read back as the same number.
template <class Number>
std::string text_of(Number number) {
  if constexpr (std::is_floating_point_v<Number>)
    if (!std::isfinite(number)) throw std::runtime_error("a position is not finite");
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
  return {text.data(), end};
}

// [element, element ...], each written by `write(i)`.
template <class Write>
std::string list_of(std::size_t count, Write write) {
  std::string list = "[";
  for (std::size_t i = 0; i < count; ++i) list.append(i == 0 ? "" : ",").append(write(i));
  return list + "]";
}

template <class Number>
std::string numbers_json(std::span<const Number> numbers) {
  return list_of(numbers.size(), [&](std::size_t i) { return text_of(numbers[i]); });
}

std::string vectors_json(std::span<const float> values) {
  return list_of(values.size() / 3,
                 [&](std::size_t i) { return numbers_json(values.subspan(3 * i, 3)); });
}

std::string triangles_json(const BaseTopology& base) {
  return list_of(base.triangles.size(), [&](std::size_t i) {
    return numbers_json(std::span<const std::uint32_t>(base.triangles[i]));
  });
}

std::vector<std::uint32_t> crease_numbers(const BaseTopology& base) {
  const std::set<std::array<std::uint32_t, 2>> creases(base.crease_edges.begin(),
                                                       base.crease_edges.end());
  const bitstream::BaseEdges numbered = bitstream::number_base_edges(base);
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t e = 0; e < numbered.edges.size(); ++e) {
    const auto [a, b] = numbered.edges[e].vertices;
    if (creases.contains({std::min(a, b), std::max(a, b)})) numbers.push_back(e);
  }
  return numbers;
}

ProgressiveSurface surface_for(const std::optional<Base>& base, int levels) {
  if (!base) return ProgressiveSurface();
  return ProgressiveSurface({base->topology, base->positions, levels});
}

std::vector<float> known_positions(const ProgressiveSurface& surface, const StreamCase& stream) {
  return stream.base ? stream.base->positions : surface.decoder().base_positions();
}

std::string known_base_json(const ProgressiveSurface& surface, const StreamCase& stream) {
  const BaseTopology& base = surface.base();
  const std::vector<float> positions = known_positions(surface, stream);
  return "{\"positions\":" + vectors_json(positions) + ",\n\"triangles\":" + triangles_json(base) +
         ",\n\"creases\":" + numbers_json(std::span<const std::uint32_t>(crease_numbers(base))) +
         ",\"corners\":" + numbers_json(std::span<const std::uint32_t>(base.corner_vertices)) + "}";
}

std::string details_json(const ProgressiveSurface& surface) {
  const std::size_t edges = bitstream::number_base_edges(surface.base()).edges.size();
  const auto levels = static_cast<std::size_t>(surface.levels());
  bitstream::CoefficientSet set;
  if (surface.decoder().base_ready()) {
    set = surface.decoder().coefficients();
  } else {  // an external base before its header
    for (auto& channel : set.channels)
      channel.assign(bitstream::level_offset(edges, surface.levels()), 0);
  }
  const std::array names = {"\"normal\":", "\"tangent1\":", "\"tangent2\":"};
  return list_of(levels, [&](std::size_t level) {
    std::string text = level == 0 ? "" : "\n";
    for (std::size_t c = 0; c < names.size(); ++c) {
      const std::span<const std::int32_t> values =
          std::span<const std::int32_t>(set.channels[c])
              .subspan(bitstream::level_offset(edges, static_cast<int>(level)),
                       edges << (2 * level));
      text.append(c == 0 ? "{" : ",").append(names[c]) += numbers_json(values);
    }
    return text + "}";
  });
}

// Vertices of the finest level on creases, and corners: their normals are for display only.
std::vector<bool> vertices_without_normal(const BaseTopology& base, int levels) {
  const surface::SubdivisionHierarchy hierarchy(base, levels,
                                                surface::WaveletTransform::loop_local);
  std::vector<bool> without(hierarchy.level(levels).vertex_count, false);
  for (const std::uint32_t corner : base.corner_vertices) without[corner] = true;
  std::vector<int> faces(base.vertex_count, 0);
  for (const auto& triangle : base.triangles)
    for (const std::uint32_t v : triangle) ++faces[v];
  for (std::uint32_t v = 0; v < base.vertex_count; ++v)
    if (faces[v] == 1) without[v] = true;
  std::set<std::array<std::uint32_t, 2>> creases(base.crease_edges.begin(),
                                                 base.crease_edges.end());
  const auto pair = [](std::uint32_t a, std::uint32_t b) {
    return std::array{std::min(a, b), std::max(a, b)};
  };
  for (int number = 0; number <= levels; ++number) {
    for (const auto& [a, b] : creases) without[a] = without[b] = true;
    if (number == levels) break;
    std::set<std::array<std::uint32_t, 2>> halves;
    const surface::SubdivisionLevel& level = hierarchy.level(number);
    for (std::uint32_t e = 0; e < level.edge_count; ++e) {
      const auto [a, b] = level.edges.vertices[e];
      if (!creases.contains(pair(a, b))) continue;
      halves.insert({pair(a, level.vertex_count + e), pair(b, level.vertex_count + e)});
    }
    creases = std::move(halves);
  }
  return without;
}

// Throws if rounding decides about the positions.
void check_conditioning(const ProgressiveSurface& surface, std::span<const float> base_positions,
                        std::span<const float> positions) {
  // Without levels there are no frames, and without a header no details.
  if (surface.levels() == 0 || !surface.decoder().header_ready()) return;
  const double change = change_by_rounding(surface, base_positions, positions);
  if (!(change <= kMostChange))
    throw std::runtime_error("rounding moves positions by " + std::to_string(change) +
                             " of the diagonal: decode another prefix");
}

std::string surface_json(ProgressiveSurface& surface, const StreamCase& stream) {
  const int level = surface.levels();
  std::vector<float> positions(3 * surface.counts(level).vertices), normals(positions.size());
  if (surface.write_limits(level, {{positions.data()}, {normals.data()}}) !=
      surface::SurfaceOutcome::done)
    throw std::runtime_error(surface.reason());
  check_conditioning(surface, known_positions(surface, stream), positions);
  std::string text = "\"positions\":" + vectors_json(positions);
  if (!stream.with_normals) return text;
  const std::vector<bool> without = vertices_without_normal(surface.base(), level);
  return text + ",\n\"normals\":" + list_of(positions.size() / 3, [&](std::size_t v) {
           return without[v] ? std::string("null")
                             : numbers_json(std::span<const float>(normals).subspan(3 * v, 3));
         });
}

}  // namespace

std::string base_json(const Base& base) {
  return "{\"positions\":" + vectors_json(base.positions) +
         ",\n\"triangles\":" + triangles_json(base.topology) + "}\n";
}

std::string expected_json(const StreamCase& stream, std::size_t bytes) {
  ProgressiveSurface surface = surface_for(stream.base, stream.levels);
  const DecodeStatus status = surface.feed(std::span(stream.bytes).first(bytes));
  if (status == DecodeStatus::broken) throw std::runtime_error(surface.reason());
  std::string text = "{\"status\":\"";
  text += status == DecodeStatus::done ? "done" : "more bytes wanted";
  if (!surface.is_ready()) return text + "\",\"base\":null,\"details\":[],\"positions\":null}\n";
  return text + "\",\n\"base\":" + known_base_json(surface, stream) +
         ",\n\"details\":" + details_json(surface) + ",\n" + surface_json(surface, stream) + "}\n";
}

std::string complaint_about(const BrokenCase& broken) {
  ProgressiveSurface surface = surface_for(broken.base, broken.levels);
  if (surface.feed(broken.bytes) != DecodeStatus::broken)
    throw std::runtime_error(broken.name + " is not broken");
  return surface.reason();
}

}  // namespace zerotree::conformance
