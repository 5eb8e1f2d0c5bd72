#include "encode/stream_encoder.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "bitstream/base_connectivity_coding.h"
#include "bitstream/base_edges.h"
#include "encode/header_writer.h"
#include "encode/known_details.h"
#include "encode/range_encoder.h"
#include "mesh/error.h"

namespace zerotree::encode {
namespace {

using bitstream::CoefficientSet;

bitstream::BaseEdges checked_edges(const bitstream::BaseTopology& base) {
  bitstream::BaseEdges edges = bitstream::number_base_edges(base);
  if (!edges.error.empty()) {
    throw Error(ExitCode::refused_topology, "cannot code the base mesh: " + edges.error);
  }
  return edges;
}

void check_content(const StreamContent& content, std::size_t edge_count) {
  const CoefficientSet& set = content.coefficients;
  if (set.levels != content.header.levels || set.base_edge_count != edge_count) {
    throw std::invalid_argument("encode_stream: the coefficients are of another base or depth");
  }
  for (const auto& channel : set.channels) {
    if (channel.size() != bitstream::level_offset(edge_count, set.levels)) {
      throw std::invalid_argument("encode_stream: a channel has not one value per cell");
    }
    for (const std::int32_t value : channel) {
      if (value != 0 && (value % 2 == 0 || std::abs(std::int64_t{value}) < 3)) {
        throw std::invalid_argument("encode_stream: a coefficient is not a final midpoint value");
      }
    }
  }
  const std::size_t positions =
      content.header.external_base ? 0 : std::size_t{content.base.vertex_count} * 3;
  if (content.positions.size() != positions) {
    throw std::invalid_argument("encode_stream: not three coordinates per base vertex");
  }
  for (const std::uint32_t q : content.positions) {
    if (q >> content.header.positions.bits != 0) {
      throw std::invalid_argument("encode_stream: a coordinate has more bits than announced");
    }
  }
}

void code_connectivity(RangeEncoder& coder, const bitstream::BaseTopology& base) {
  const bitstream::ConnectivityStatus status = bitstream::encode_base_connectivity(coder, base);
  if (!status.ok()) {
    throw Error(ExitCode::refused_topology,
                std::string("cannot code the base mesh: ") + status.problem);
  }
}

}  // namespace

int count_planes(const CoefficientSet& coefficients) {
  std::uint32_t all = 0;
  for (const auto& channel : coefficients.channels) {
    for (const std::int32_t value : channel) {
      all |= static_cast<std::uint32_t>(std::abs(std::int64_t{value})) >> 1;
    }
  }
  return static_cast<int>(std::bit_width(all));
}

StreamBytes encode_stream(const StreamContent& content) {
  const bitstream::BaseEdges edges = checked_edges(content.base);
  check_content(content, edges.edges.size());

  bitstream::StreamHeader header = content.header;
  header.vertex_count = content.base.vertex_count;
  header.face_count = static_cast<std::uint32_t>(content.base.triangles.size());
  header.planes = count_planes(content.coefficients);
  header.has_sharp_tags =
      !content.base.crease_edges.empty() || !content.base.corner_vertices.empty();
  StreamBytes result{write_header(header), {}};
  const std::size_t begin = result.bytes.size();

  RangeEncoder coder;
  bitstream::PositionPlanes positions;
  if (!header.external_base) {
    code_connectivity(coder, content.base);
    positions = bitstream::PositionPlanes(content.base, header.positions.bits);
  }
  bitstream::SharpTagCoding tags(edges.edges, content.base.vertex_count);
  tags.set_tags(content.base);
  bitstream::DetailState state(edges, header.levels, header.planes);
  bitstream::CodedPasses<RangeEncoder, KnownDetails> passes(
      header, tags, positions, state, KnownDetails(content.coefficients), content.positions);
  while (!passes.done()) {
    const bitstream::PassPlace place = passes.place();
    passes.advance(coder);
    result.pass_ends.push_back({begin + coder.sufficient_bytes(), place.plane, place.pass});
  }
  const std::vector<std::uint8_t> coded = coder.finish();
  result.bytes.insert(result.bytes.end(), coded.begin(), coded.end());
  for (PassEnd& end : result.pass_ends) end.bytes = std::min(end.bytes, result.bytes.size());
  return result;
}

}  // namespace zerotree::encode
