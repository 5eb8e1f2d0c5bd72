// The coarse end of a decimation as a small mesh of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "domain/domain.h"

namespace zerotree::domain {

/// A domain whose mesh is a coarse version of another one's. Its vertices and faces have numbers of
/// their own, in the order that they have there.
struct CoarseDomain {
  Domain domain;
  /// Of each vertex and face of it: the one it is in the fine domain.
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> faces;
};

/// The mesh that `fine` was after its first `keep` collapses, with the collapses that followed: all
/// work on it costs what its own size costs, and stays in the cache. 8 bytes a vertex of `fine` in
/// passing.
CoarseDomain extract_coarse(const Domain& fine, std::size_t keep);

/// The numbers in `coarse` of those of the fine domain's `vertices` (ascending) that it has.
std::vector<std::uint32_t> to_coarse(const CoarseDomain& coarse,
                                     const std::vector<std::uint32_t>& vertices);

}  // namespace zerotree::domain
