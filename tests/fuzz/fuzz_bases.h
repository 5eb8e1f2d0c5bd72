// Small base meshes that inputs of the fuzzer are bound to: those who write seeds have them too.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace zerotree::fuzz {

struct FuzzBase {
  std::vector<float> positions;  // x, y, z per vertex
  std::vector<std::uint32_t> indices;
  // What the stream of a seed says of it: pairs of vertices.
  std::vector<std::array<std::uint32_t, 2>> crease_edges;
};

inline constexpr int kFuzzBases = 4;

/// 0: closed; 1: bounded; 2: several components; 3: closed with creases and valence 3.
inline FuzzBase fuzz_base(int number) {
  switch (number) {
    case 0:
      return {{1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1},
              {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 1, 0, 5, 2, 1, 5, 3, 2, 5, 0, 3, 5},
              {}};
    case 1:
      return {{0, 0, 0, 1, 0, 0, 2, 0, .5f, 0, 1, 0, 1, 1, .5f, 2, 1, 0, 0, 2, 0, 1, 2, 0, 2, 2, 0},
              {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 3, 4, 7, 3, 7, 6, 4, 5, 8, 4, 8, 7},
              {}};
    case 2:
      return {{1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1, 4, 0, 0, 5, 0, 0, 4, 1, 0},
              {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2, 4, 5, 6},
              {}};
    default:
      return {{0, 0, 1, 1, 0, 0, 0, 1, 0, -1, -1, 0, 0, 0, -1},
              {1, 2, 0, 2, 3, 0, 3, 1, 0, 2, 1, 4, 3, 2, 4, 1, 3, 4},
              {{1, 2}, {1, 3}, {2, 3}}};
  }
}

}  // namespace zerotree::fuzz
