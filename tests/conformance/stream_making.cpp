#include "stream_making.h"

#include <cmath>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>

#include "bitstream/base_edges.h"
#include "bitstream/base_hash.h"
#include "bitstream/base_traversal.h"
#include "bitstream/edge_image.h"
#include "encode/base_quantisation.h"
#include "encode/header_writer.h"

namespace zerotree::conformance {
namespace {

using bitstream::BaseTopology;
using bitstream::Pass;
using encode::StreamContent;

BaseTopology topology_of(const test::Shape& shape) {
  return {static_cast<std::uint32_t>(shape.mesh.positions.size()), shape.mesh.triangles,
          shape.crease_edges, shape.corner_vertices};
}

// Magnitudes of every length up to `bits` bits are equally likely, and 0 of length 0.
std::int32_t random_value(std::mt19937& random, int bits) {
  const auto length = static_cast<int>(random() % static_cast<unsigned>(bits + 1));
  const auto low = static_cast<std::uint32_t>(random());
  const bool negative = (random() & 1) != 0;
  if (length == 0) return 0;
  const std::uint32_t magnitude = (1u << (length - 1)) | (low & ((1u << (length - 1)) - 1));
  const auto value = static_cast<std::int32_t>(2 * magnitude + 1);
  return negative ? -value : value;
}

void add_details(StreamContent& content, const StreamPlan& plan) {
  const bitstream::BaseEdges base = bitstream::number_base_edges(content.base);
  const std::size_t edges = base.edges.size();
  bitstream::CoefficientSet& set = content.coefficients;
  set = {edges, plan.levels, {}};
  for (auto& channel : set.channels) channel.assign(bitstream::level_offset(edges, plan.levels), 0);
  std::mt19937 random(plan.seed);
  for (std::size_t level = 0; level < plan.detail_bits.size(); ++level) {
    if (plan.detail_bits[level] == 0) continue;
    const auto number = static_cast<int>(level);
    for (std::size_t i = 0; i < edges << (2 * level); ++i) {
      const bitstream::EdgeCell cell = bitstream::cell_at(number, i);
      const bool boundary = base.edges[cell.base_edge].faces[1] == bitstream::kNone;
      if (boundary && cell.p < cell.q) continue;
      for (auto& channel : set.channels)
        if (random() % 1000 < static_cast<unsigned>(plan.per_mille))
          channel[bitstream::level_offset(edges, number) + i] =
              random_value(random, plan.detail_bits[level]);
    }
  }
}

StreamContent content_of(BaseTopology base, const StreamPlan& plan) {
  StreamContent content;
  content.base = std::move(base);
  content.header.levels = plan.levels;
  content.header.transform = static_cast<std::uint32_t>(plan.transform);
  content.header.finest_step = encode::storable_step(plan.finest_step);
  content.header.tangent_ratio_log2 = plan.tangent_ratio_log2;
  add_details(content, plan);
  return content;
}

std::size_t header_size(const StreamContent& content) {
  bitstream::StreamHeader header = content.header;
  header.vertex_count = content.base.vertex_count;
  header.face_count = static_cast<std::uint32_t>(content.base.triangles.size());
  return encode::write_header(header).size();
}

// In the middle of passes: of the tags, the positions, and each pass of the first and of a middle
// plane of the details.
std::vector<std::size_t> middles_of_passes(const encode::StreamBytes& stream, int planes) {
  std::vector<std::size_t> middles;
  for (std::size_t i = 1; i < stream.pass_ends.size(); ++i) {
    const encode::PassEnd& end = stream.pass_ends[i];
    const bool chosen = end.pass < Pass::likely_first || end.pass == Pass::last_positions ||
                        end.plane == planes - 1 || end.plane == planes / 2;
    if (chosen) middles.push_back((stream.pass_ends[i - 1].bytes + end.bytes) / 2);
  }
  return middles;
}

std::vector<std::size_t> choose_prefixes(const StreamContent& content,
                                         const encode::StreamBytes& stream, Cuts cuts) {
  const std::size_t size = stream.bytes.size(), header = header_size(content);
  std::set<std::size_t> lengths = {size};
  if (cuts == Cuts::every) {
    lengths.insert({0, 2, header - 1, header, header + 1, header + 4, size - 1});
    // The first pass to end is that of the tags, whether there are any or not.
    const std::size_t tags_end = stream.pass_ends.front().bytes;
    lengths.insert({(header + tags_end) / 2, tags_end - 1, tags_end});
    for (const std::size_t middle :
         middles_of_passes(stream, encode::count_planes(content.coefficients)))
      lengths.insert(middle);
  }
  if (cuts == Cuts::some)
    lengths.insert({header + 1, stream.pass_ends.front().bytes, size * 2 / 3, size - 1});
  if (cuts == Cuts::half) lengths.insert(size / 2);
  while (*lengths.rbegin() > size) lengths.erase(std::prev(lengths.end()));
  return {lengths.begin(), lengths.end()};
}

}  // namespace

StreamContent embedded_content(const test::Shape& shape, const StreamPlan& plan) {
  const BaseTopology plain = topology_of(shape);
  const bitstream::BaseOrder order = bitstream::canonical_base_order(plain);
  StreamContent content = content_of(bitstream::reorder(plain, order), plan);
  std::vector<Eigen::Vector3d> positions;
  for (const std::uint32_t old : order.vertices) positions.push_back(shape.mesh.positions[old]);
  encode::QuantisedBase quantised =
      encode::quantise_base(positions, plan.position_bits, 0, content.header.finest_step);
  content.header.positions = quantised.quantisation;
  content.header.positions.initial_planes = plan.initial_planes;
  content.positions = std::move(quantised.integers);
  return content;
}

Base external_base(const test::Shape& shape) {
  Base base{shape.name, topology_of(shape), {}};
  base.topology.crease_edges.clear();
  base.topology.corner_vertices.clear();
  for (const Eigen::Vector3d& p : shape.mesh.positions)
    for (int axis = 0; axis < 3; ++axis) base.positions.push_back(static_cast<float>(p[axis]));
  return base;
}

StreamContent external_content(const test::Shape& shape, const StreamPlan& plan) {
  StreamContent content = content_of(topology_of(shape), plan);
  const Base base = external_base(shape);
  content.header.external_base = true;
  content.header.base_hash = bitstream::hash_base(base.topology, base.positions);
  return content;
}

StreamCase make_case(std::string name, std::vector<std::string> shows, const StreamContent& content,
                     Cuts cuts, const test::Shape* shape) {
  if (content.header.external_base != (shape != nullptr))
    throw std::invalid_argument(name + ": an external base needs a shape, an embedded one none");
  StreamCase result;
  result.name = std::move(name);
  result.shows = std::move(shows);
  result.levels = content.header.levels;
  if (shape != nullptr) result.base = external_base(*shape);
  encode::StreamBytes stream = encode::encode_stream(content);
  result.prefixes = choose_prefixes(content, stream, cuts);
  result.bytes = std::move(stream.bytes);
  return result;
}

}  // namespace zerotree::conformance
