// Encoded streams of random details over small bases, and what every surface of them must satisfy.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bitstream/base_topology.h"
#include "encode/encode.h"
#include "shapes.h"
#include "zerotree/zerotree.hpp"

namespace zerotree::test {

struct SampleOptions {
  bool embed_base = true;
  int levels = 3;
  double finest_step = 1e-3;
};

struct Sample {
  bitstream::BaseTopology base;
  encode::EncodedStream stream;
  int levels = 0;
};

/// A stream of random details over `shape`.
Sample sample_stream(const Shape& shape, const SampleOptions& options);

/// Three indices per base triangle, as the C interface takes them.
std::vector<std::uint32_t> flat_indices(const bitstream::BaseTopology& base);

/// A decoder for the sample: of its bytes alone, or bound to its base if that is not embedded.
Decoder decoder_for(const Sample& sample, bool embedded);

/// Every index is in range, every vertex used, every edge run through at most once in each
/// direction; positions and normals are finite, normals of length 1. Returns the number of
/// boundary edges.
std::size_t expect_complete(const SurfaceSamples& surface);

}  // namespace zerotree::test
