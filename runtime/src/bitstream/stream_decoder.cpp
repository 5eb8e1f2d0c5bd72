#include "bitstream/stream_decoder.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "bitstream/base_connectivity_coding.h"
#include "bitstream/base_hash.h"
#include "bitstream/coded_passes.h"
#include "bitstream/range_decoder.h"

namespace zerotree::bitstream {

struct StreamDecoder::State {
  using Passes = CodedPasses<RangeDecoder, UnknownDetails>;

  explicit State(const Limits& reader_limits) : limits(reader_limits) {}

  void run();
  void read_stream_header();
  void read_connectivity();
  void accept_external_base();
  void accept_base_edges();
  void run_passes();
  void fail(std::string why) {
    status = DecodeStatus::broken;
    reason = std::move(why);
    passes.reset();
    details = {};
  }

  Limits limits;
  bool external = false;
  BaseTopology external_base;
  std::vector<float> external_positions;

  std::vector<std::uint8_t> bytes;
  DecodeStatus status = DecodeStatus::more_bytes_wanted;
  std::string reason;
  bool header_ready = false, base_ready = false;
  StreamHeader header;
  std::size_t header_size = 0;

  BaseTopology base;
  BaseEdges numbering;
  SharpTagCoding tags;
  PositionPlanes positions;
  DetailState details;
  RangeDecoder coder;
  BaseConnectivityCoder<RangeDecoder> connectivity{coder};
  std::optional<Passes> passes;
};

void StreamDecoder::State::run() {
  if (status != DecodeStatus::more_bytes_wanted) return;
  if (!header_ready) read_stream_header();
  if (!header_ready || status != DecodeStatus::more_bytes_wanted) return;
  coder.set_bytes(std::span<const std::uint8_t>(bytes).subspan(header_size));
  if (!passes) external ? accept_external_base() : read_connectivity();
  if (passes) run_passes();
}

void StreamDecoder::State::read_stream_header() {
  StreamHeader read;
  HeaderResult result = read_header(bytes, limits, read);
  if (result.status == DecodeStatus::broken) return fail(std::move(result.reason));
  if (result.status == DecodeStatus::more_bytes_wanted) return;
  if (read.external_base && !external) {
    return fail("the stream has no base mesh of its own and none was given");
  }
  if (!read.external_base && external) {
    return fail("the stream has a base mesh of its own, yet one was given");
  }
  header = read;
  header_size = result.size;
  header_ready = true;
}

void StreamDecoder::State::accept_external_base() {
  if (external_positions.size() != std::size_t{external_base.vertex_count} * 3) {
    return fail("the base mesh given has not three coordinates per vertex");
  }
  if (external_base.triangles.empty() || external_base.triangles.size() > kMostFaces) {
    return fail("the base mesh given has no faces, or too many");
  }
  if (hash_base(external_base, external_positions) != header.base_hash) {
    return fail("the base mesh given is not the one that the stream was made for");
  }
  header.vertex_count = external_base.vertex_count;
  header.face_count = static_cast<std::uint32_t>(external_base.triangles.size());
  std::string beyond = check_size(header, limits);
  if (!beyond.empty()) return fail(std::move(beyond));
  base = std::move(external_base);
  base.crease_edges.clear();
  base.corner_vertices.clear();
  accept_base_edges();
}

void StreamDecoder::State::read_connectivity() {
  const ConnectivityStatus decoded =
      connectivity.decode({header.vertex_count, header.face_count}, base);
  if (connectivity.starved()) return;
  if (!decoded.ok()) return fail(std::string("base connectivity: ") + decoded.problem);
  positions = PositionPlanes(base, header.positions.bits);
  accept_base_edges();
}

void StreamDecoder::State::accept_base_edges() {
  numbering = number_base_edges(base);
  if (!numbering.error.empty()) return fail(numbering.error);
  const std::uint64_t edges = numbering.edges.size();
  if (base.vertex_count + edges * cells_below(header.levels) > limits.max_vertices ||
      DetailState::memory(edges, header.levels) > limits.max_memory) {
    return fail("the stream has more vertices than the limit");
  }
  details = DetailState(numbering, header.levels);
  tags = SharpTagCoding(numbering.edges, base.vertex_count);
  passes.emplace(header, tags, positions, details, UnknownDetails{},
                 std::span<const std::uint32_t>{});
}

void StreamDecoder::State::run_passes() {
  while (!passes->done()) {
    if (!passes->advance(coder)) return;
    if (base_ready) continue;
    tags.get_tags(base);
    if (header.has_sharp_tags && base.crease_edges.empty() && base.corner_vertices.empty()) {
      return fail("the header announces sharp tags, but there are none");
    }
    base_ready = true;
  }
  status = DecodeStatus::done;
}

StreamDecoder::StreamDecoder(const Limits& limits) : state_(std::make_unique<State>(limits)) {}

StreamDecoder::StreamDecoder(BaseTopology base, std::vector<float> positions, const Limits& limits)
    : state_(std::make_unique<State>(limits)) {
  state_->external = true;
  state_->external_base = std::move(base);
  state_->external_positions = std::move(positions);
}

StreamDecoder::~StreamDecoder() = default;
StreamDecoder::StreamDecoder(StreamDecoder&&) noexcept = default;
StreamDecoder& StreamDecoder::operator=(StreamDecoder&&) noexcept = default;

DecodeStatus StreamDecoder::feed(std::span<const std::uint8_t> bytes) {
  if (state_->status == DecodeStatus::more_bytes_wanted) {
    state_->bytes.insert(state_->bytes.end(), bytes.begin(), bytes.end());
    state_->run();
  }
  return state_->status;
}

DecodeStatus StreamDecoder::status() const {
  return state_->status;
}
const std::string& StreamDecoder::reason() const {
  return state_->reason;
}
bool StreamDecoder::header_ready() const {
  return state_->header_ready;
}
const StreamHeader& StreamDecoder::header() const {
  return state_->header;
}
bool StreamDecoder::base_ready() const {
  return state_->base_ready;
}
const BaseTopology& StreamDecoder::base() const {
  return state_->base;
}
const std::vector<BaseEdge>& StreamDecoder::base_edges() const {
  return state_->numbering.edges;
}
const CoefficientSet& StreamDecoder::coefficients() const {
  return state_->details.coefficients();
}
int StreamDecoder::detailed_levels() const {
  return state_->details.detailed_levels();
}

std::vector<float> StreamDecoder::base_positions() const {
  if (state_->external) return state_->external_positions;
  const PositionQuantisation& quantisation = state_->header.positions;
  const std::span<const std::int32_t> values = state_->positions.values();
  std::vector<float> result(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    result[i] = dequantise_coordinate(quantisation, i % 3, values[i]);
  }
  return result;
}

std::size_t StreamDecoder::bytes_consumed() const {
  const std::size_t fed = state_->bytes.size();
  if (state_->status != DecodeStatus::done) return fed;
  return std::min(fed, state_->header_size + state_->coder.sequence_length());
}

}  // namespace zerotree::bitstream
