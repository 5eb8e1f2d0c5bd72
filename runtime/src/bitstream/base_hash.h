// Tells whether an external base is the one a stream was made for.
#pragma once

#include <cstdint>
#include <span>

#include "bitstream/base_topology.h"

namespace zerotree::bitstream {

/// 64-bit FNV-1a, its two halves combined by exclusive or, over little-endian 32-bit words: vertex
/// count, triangle count, the triangles' corners in order, then the bits of the position floats
/// (x, y, z per vertex). Sharp tags do not count. Not a defence against forgery: whoever can change
/// the base can change the stream.
std::uint32_t hash_base(const BaseTopology& base, std::span<const float> positions);

}  // namespace zerotree::bitstream
