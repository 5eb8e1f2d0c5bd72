#include "counted_memory.h"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::uint64_t> heap_allocations;
std::atomic<std::int64_t> heap_held;
std::atomic<std::int64_t> heap_peak;

void* counted(void* memory) {
  if (!memory) throw std::bad_alloc();
  heap_allocations.fetch_add(1, std::memory_order_relaxed);
  const auto size = static_cast<std::int64_t>(malloc_usable_size(memory));
  const std::int64_t held = heap_held.fetch_add(size, std::memory_order_relaxed) + size;
  // Two threads may lose a maximum to each other; what is counted runs on one.
  if (held > heap_peak.load(std::memory_order_relaxed))
    heap_peak.store(held, std::memory_order_relaxed);
  return memory;
}

void discount(void* memory) {
  if (!memory) return;
  heap_held.fetch_sub(static_cast<std::int64_t>(malloc_usable_size(memory)),
                      std::memory_order_relaxed);
  std::free(memory);
}

}  // namespace

// The other forms of the standard library call these.
void* operator new(std::size_t size) {
  return counted(std::malloc(std::max<std::size_t>(size, 1)));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(memalign(static_cast<std::size_t>(alignment), std::max<std::size_t>(size, 1)));
}
void operator delete(void* memory) noexcept {
  discount(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  discount(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  discount(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  discount(memory);
}

namespace zerotree::bench {

MemoryUse heap_use() {
  return {heap_allocations.load(), heap_held.load(), heap_peak.load()};
}

void forget_heap_peak() {
  heap_peak.store(heap_held.load());
}

RecyclingAllocator::~RecyclingAllocator() {
  for (const auto& [size, blocks] : waiting_)
    for (void* block : blocks) std::free(block);
}

zt_allocator RecyclingAllocator::callbacks() {
  return {[](void* user, std::size_t size) {
            return static_cast<RecyclingAllocator*>(user)->allocate(size);
          },
          [](void* user, void* memory, std::size_t size) {
            static_cast<RecyclingAllocator*>(user)->release(memory, size);
          },
          this};
}

void* RecyclingAllocator::allocate(std::size_t size) {
  ++use_.allocations;
  use_.held += static_cast<std::int64_t>(size);
  use_.peak = std::max(use_.peak, use_.held);
  std::vector<void*>& blocks = waiting_[size];
  if (blocks.empty()) return std::malloc(size);
  void* block = blocks.back();
  blocks.pop_back();
  return block;
}

void RecyclingAllocator::release(void* memory, std::size_t size) {
  use_.held -= static_cast<std::int64_t>(size);
  waiting_[size].push_back(memory);
}

}  // namespace zerotree::bench
