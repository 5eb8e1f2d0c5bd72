// The caller's allocator as the library's containers take it.
#pragma once

#include <cstddef>
#include <memory_resource>

#include "zerotree/zerotree.h"

namespace zerotree::api {

/// Takes memory from a zt_allocator, or from operator new if it has no functions, and counts it.
class DecoderMemory : public std::pmr::memory_resource {
 public:
  explicit DecoderMemory(const zt_allocator& allocator) : allocator_(allocator) {}

  std::size_t bytes_held() const { return held_; }

  /// Unaligned beyond 16 bytes, for the decoder itself. Null when out of memory.
  static void* take(const zt_allocator& allocator, std::size_t size);
  static void give_back(const zt_allocator& allocator, void* memory, std::size_t size);

 private:
  void* do_allocate(std::size_t size, std::size_t alignment) override;
  void do_deallocate(void* memory, std::size_t size, std::size_t alignment) override;
  bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override {
    return this == &other;
  }

  zt_allocator allocator_;
  std::size_t held_ = 0;
};

}  // namespace zerotree::api
