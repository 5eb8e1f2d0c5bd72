// Loops whose turns do not depend on each other.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace zerotree::relax {

/// Calls function(i) for every i below `count`, on as many threads as there are. The turns may only
/// write what is theirs, so the result does not depend on the threads.
template <class Function>
void for_each_index(std::size_t count, const Function& function) {
  constexpr std::size_t grain = 1024;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) function(i);
                    });
}

/// The same for turns that are worth a task each.
template <class Function>
void for_each_block(std::size_t count, const Function& function) {
  tbb::parallel_for(std::size_t{0}, count, function);
}

}  // namespace zerotree::relax
