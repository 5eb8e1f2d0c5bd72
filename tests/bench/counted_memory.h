// Memory that a benchmark can count: everything from operator new, and an allocator for decoders
// that keeps what it is given back, so that a decoder made again finds its pages warm.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "zerotree/zerotree.h"

namespace zerotree::bench {

struct MemoryUse {
  std::uint64_t allocations = 0;  ///< made so far
  std::int64_t held = 0;          ///< bytes
  std::int64_t peak = 0;          ///< the most bytes held since the last `forget_peak`
};

/// Of operator new in this process; counted by counted_memory.cpp, which replaces it.
MemoryUse heap_use();
void forget_heap_peak();

/// Freed blocks wait for the next request of their size. Not thread-safe, as decoders allow.
class RecyclingAllocator {
 public:
  RecyclingAllocator() = default;
  RecyclingAllocator(const RecyclingAllocator&) = delete;
  RecyclingAllocator& operator=(const RecyclingAllocator&) = delete;
  ~RecyclingAllocator();

  zt_allocator callbacks();
  const MemoryUse& use() const { return use_; }
  void forget_peak() { use_.peak = use_.held; }

 private:
  void* allocate(std::size_t size);
  void release(void* memory, std::size_t size);

  std::unordered_map<std::size_t, std::vector<void*>> waiting_;
  MemoryUse use_;
};

}  // namespace zerotree::bench
