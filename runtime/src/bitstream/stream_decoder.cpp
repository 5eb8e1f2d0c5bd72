#include "bitstream/stream_decoder.h"

#include <algorithm>
#include <array>
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

  State(const Limits& reader_limits, std::pmr::memory_resource* reader_memory)
      : limits(reader_limits), resource(reader_memory) {}

  void feed(std::span<const std::uint8_t> bytes);
  std::span<const std::uint8_t> read_stream_header(std::span<const std::uint8_t> bytes);
  void accept_header(const StreamHeader& read);
  void read_connectivity();
  void set_external_base(BaseTopology given, std::vector<float> given_positions);
  void accept_external_base();
  void accept_base_edges();
  void run_passes();
  void accept_tags();
  void fail(std::string why) {
    status = DecodeStatus::broken;
    reason = std::move(why);
    passes.reset();
    details.emplace();
  }

  Limits limits;
  std::pmr::memory_resource* resource;
  bool external = false;
  std::vector<float> external_positions;

  std::size_t fed = 0;
  DecodeStatus status = DecodeStatus::more_bytes_wanted;
  std::string reason;
  bool header_ready = false, base_ready = false;
  bool base_changed = false;
  StreamHeader header;
  // The first bytes, until they make a header.
  std::array<std::uint8_t, kMostHeaderBytes> header_bytes{};
  std::size_t header_size = 0;

  BaseTopology base;
  BaseEdges numbering;
  std::optional<SharpTagCoding> tags{std::in_place};
  std::optional<PositionPlanes> positions{std::in_place};
  std::optional<DetailState> details{std::in_place};
  RangeDecoder coder;
  BaseConnectivityCoder<RangeDecoder> connectivity{coder};
  std::optional<Passes> passes;
};

void StreamDecoder::State::feed(std::span<const std::uint8_t> bytes) {
  // The last bytes of a stream may decide nothing.
  if (status == DecodeStatus::done) fed += bytes.size();
  if (status != DecodeStatus::more_bytes_wanted) return;
  fed += bytes.size();
  if (!header_ready) bytes = read_stream_header(bytes);
  if (!header_ready || status != DecodeStatus::more_bytes_wanted) return;
  coder.add_bytes(bytes);
  if (!passes) external ? accept_external_base() : read_connectivity();
  if (passes) run_passes();
}

// Returns the bytes that follow the header, once it is complete.
std::span<const std::uint8_t> StreamDecoder::State::read_stream_header(
    std::span<const std::uint8_t> bytes) {
  const std::size_t known = std::min(fed - bytes.size(), header_bytes.size());
  const std::size_t added = std::min(bytes.size(), header_bytes.size() - known);
  std::copy_n(bytes.begin(), added, header_bytes.begin() + known);
  StreamHeader read;
  HeaderResult result = read_header(std::span(header_bytes).first(known + added), limits, read);
  if (result.status == DecodeStatus::broken) {
    fail(std::move(result.reason));
  } else if (result.status == DecodeStatus::done) {
    header_size = result.size;
    accept_header(read);
    return bytes.subspan(header_size - known);
  }
  return {};
}

void StreamDecoder::State::accept_header(const StreamHeader& read) {
  if (read.external_base && !external) {
    return fail("the stream has no base mesh of its own and none was given");
  }
  if (!read.external_base && external) {
    return fail("the stream has a base mesh of its own, yet one was given");
  }
  header = read;
  header_ready = true;
}

void StreamDecoder::State::set_external_base(BaseTopology given,
                                             std::vector<float> given_positions) {
  external = true;
  base = std::move(given);
  base.crease_edges.clear();
  base.corner_vertices.clear();
  external_positions = std::move(given_positions);
  numbering = number_base_edges(base);
  if (!numbering.error.empty()) fail(numbering.error);
}

void StreamDecoder::State::accept_external_base() {
  if (external_positions.size() != std::size_t{base.vertex_count} * 3) {
    return fail("the base mesh given has not three coordinates per vertex");
  }
  if (base.triangles.empty() || base.triangles.size() > kMostFaces) {
    return fail("the base mesh given has no faces, or too many");
  }
  if (hash_base(base, external_positions) != header.base_hash) {
    return fail("the base mesh given is not the one that the stream was made for");
  }
  header.vertex_count = base.vertex_count;
  header.face_count = static_cast<std::uint32_t>(base.triangles.size());
  std::string beyond = check_size(header, limits);
  if (!beyond.empty()) return fail(std::move(beyond));
  accept_base_edges();
}

void StreamDecoder::State::read_connectivity() {
  const ConnectivityStatus decoded =
      connectivity.decode({header.vertex_count, header.face_count}, base);
  if (connectivity.starved()) return;
  if (!decoded.ok()) return fail(std::string("base connectivity: ") + decoded.problem);
  positions.emplace(base, header.positions.bits, resource);
  numbering = number_base_edges(base);
  if (!numbering.error.empty()) return fail(numbering.error);
  accept_base_edges();
}

void StreamDecoder::State::accept_base_edges() {
  const std::uint64_t edges = numbering.edges.size();
  if (base.vertex_count + edges * cells_below(header.levels) > limits.max_vertices ||
      DetailState::memory(edges, header.levels, header.planes) > limits.max_memory) {
    return fail("the stream has more vertices than the limit");
  }
  details.emplace(numbering, header.levels, header.planes, resource);
  decltype(numbering.face_edges)().swap(numbering.face_edges);  // nobody else asks for them
  if (header.has_sharp_tags) {
    tags.emplace(numbering.edges, base.vertex_count, resource);
    base.crease_edges.reserve(edges);
    base.corner_vertices.reserve(base.vertex_count);
  }
  passes.emplace(header, *tags, *positions, *details, UnknownDetails{},
                 std::span<const std::uint32_t>{});
}

void StreamDecoder::State::run_passes() {
  const auto known_positions = [&] {
    return std::pair(positions->unknown_planes(), positions->coded_in_plane());
  };
  const auto known_before = known_positions();
  while (!passes->done() && passes->advance(coder)) {
    if (!base_ready) accept_tags();
    if (status == DecodeStatus::broken) return;
  }
  if (passes->done()) status = DecodeStatus::done;
  if (known_positions() != known_before) base_changed = true;
}

void StreamDecoder::State::accept_tags() {
  tags->get_tags(base);
  if (header.has_sharp_tags && base.crease_edges.empty() && base.corner_vertices.empty()) {
    return fail("the header announces sharp tags, but there are none");
  }
  base_ready = true;
  base_changed = true;
}

StreamDecoder::StreamDecoder(const Limits& limits, std::pmr::memory_resource* resource)
    : state_(std::make_unique<State>(limits, resource)) {}

StreamDecoder::StreamDecoder(BaseTopology base, std::vector<float> positions, const Limits& limits,
                             std::pmr::memory_resource* resource)
    : state_(std::make_unique<State>(limits, resource)) {
  state_->set_external_base(std::move(base), std::move(positions));
}

StreamDecoder::~StreamDecoder() = default;
StreamDecoder::StreamDecoder(StreamDecoder&&) noexcept = default;
StreamDecoder& StreamDecoder::operator=(StreamDecoder&&) noexcept = default;

DecodeStatus StreamDecoder::feed(std::span<const std::uint8_t> bytes) {
  state_->feed(bytes);
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
const DetailState& StreamDecoder::details() const {
  return *state_->details;
}
CoefficientSet StreamDecoder::coefficients() const {
  return state_->details->coefficients();
}
int StreamDecoder::detailed_levels() const {
  return state_->details->detailed_levels();
}
int StreamDecoder::changed_from() const {
  return state_->base_changed ? -1 : state_->details->changed_from();
}
void StreamDecoder::forget_changes() {
  state_->base_changed = false;
  state_->details->forget_changes();
}

std::vector<float> StreamDecoder::base_positions() const {
  std::vector<float> positions(state_->external ? state_->external_positions.size()
                                                : state_->positions->values().size());
  get_base_positions(positions);
  return positions;
}
std::span<const float> StreamDecoder::external_positions() const {
  return state_->external_positions;
}
void StreamDecoder::get_base_positions(std::span<float> positions) const {
  if (state_->external) {
    std::copy(state_->external_positions.begin(), state_->external_positions.end(),
              positions.begin());
    return;
  }
  const PositionQuantisation& quantisation = state_->header.positions;
  const std::span<const std::int32_t> values = state_->positions->values();
  for (std::size_t i = 0; i < values.size(); ++i)
    positions[i] = dequantise_coordinate(quantisation, i % 3, values[i]);
}

std::size_t StreamDecoder::bytes_consumed() const {
  if (state_->status != DecodeStatus::done) return state_->fed;
  return std::min(state_->fed, state_->header_size + state_->coder.sequence_length());
}

}  // namespace zerotree::bitstream
