// Decodes any prefix of a stream, in pieces of any size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <string>
#include <vector>

#include "bitstream/base_edges.h"
#include "bitstream/base_topology.h"
#include "bitstream/coefficient_layout.h"
#include "bitstream/decode_status.h"
#include "bitstream/detail_state.h"
#include "bitstream/stream_header.h"

namespace zerotree::bitstream {

/// A progressive decoder. Integers all the way: what it holds after n bytes is the same on every
/// machine and does not depend on the pieces in which the bytes came. Any bytes are safe; memory
/// stays within the limits. The only exception it throws is std::bad_alloc.
///
/// Everything that grows with the levels and the state of tags and positions comes from the
/// resource given, which must outlive the decoder; the lists of the base mesh come from the heap.
/// All of it is taken when the base is accepted. From then on `feed` takes no more memory, but for
/// a stream whose details of the two finest levels have more than 14 bit planes.
class StreamDecoder {
 public:
  /// For streams that carry their base mesh.
  explicit StreamDecoder(const Limits& limits = {},
                         std::pmr::memory_resource* resource = std::pmr::new_delete_resource());
  /// For streams bound to an external base: `base` with its triangles (sharp tags are ignored:
  /// the stream holds them) and x, y, z of each of its vertices. The stream is broken if it was
  /// made for another base, and from the start if the base's edges cannot be numbered.
  StreamDecoder(BaseTopology base, std::vector<float> positions, const Limits& limits = {},
                std::pmr::memory_resource* resource = std::pmr::new_delete_resource());
  ~StreamDecoder();
  StreamDecoder(StreamDecoder&&) noexcept;
  StreamDecoder& operator=(StreamDecoder&&) noexcept;

  /// Takes the next bytes of the stream and decodes what they allow; they are not kept. Bytes after
  /// the end and after an error are ignored. About 0.02 microseconds a decision.
  DecodeStatus feed(std::span<const std::uint8_t> bytes);

  DecodeStatus status() const;
  /// If broken, a sentence that says why; otherwise empty.
  const std::string& reason() const;

  /// The header has been read and accepted.
  bool header_ready() const;
  const StreamHeader& header() const;

  /// Connectivity and sharp tags are known, so a surface can be made. Before, the accessors
  /// below mean nothing, but for an external base and its edges: these are there from the
  /// start, without tags.
  bool base_ready() const;
  const BaseTopology& base() const;
  const std::vector<BaseEdge>& base_edges() const;
  /// x, y, z per base vertex as far as they are known: the external ones as they were given,
  /// embedded ones at the middle of what their known bits leave open.
  std::vector<float> base_positions() const;
  /// The same into room for three floats a vertex.
  void get_base_positions(std::span<float> positions) const;
  /// Those of an external base where they are kept; otherwise empty. Live as long as the decoder.
  std::span<const float> external_positions() const;
  /// Details as far as they are known: see DetailState::has_details and DetailState::values.
  const DetailState& details() const;
  /// A copy of all details, those that are zero included.
  CoefficientSet coefficients() const;

  /// One more than the finest level with a detail that is not zero so far; 0 if there is none.
  int detailed_levels() const;

  /// What has changed since `forget_changes` was called last: the lowest level with another detail,
  /// -1 if the base has become ready or its positions are better known, INT_MAX if nothing has.
  int changed_from() const;
  void forget_changes();

  /// Bytes fed so far; once done, at most the length of the stream.
  std::size_t bytes_consumed() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace zerotree::bitstream
