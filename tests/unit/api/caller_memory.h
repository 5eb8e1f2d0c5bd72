// An allocator that tests pass to a decoder.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <limits>

#include "zerotree/zerotree.h"

namespace zerotree::test {

/// Counts what a decoder takes and gives back, and refuses what it is told to.
class CallerMemory {
 public:
  static constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();

  /// Options with this allocator, which outlives the decoder.
  zt_options options() {
    zt_options options{};
    options.struct_size = sizeof options;
    options.allocator = {&allocate, &release, this};
    return options;
  }
  /// The requests numbered `first` .. `last`, counted from 0 at the beginning, are refused.
  void refuse(std::size_t first, std::size_t last) {
    first_refused_ = first;
    last_refused_ = last;
  }

  std::size_t requests() const { return requests_; }
  std::size_t blocks() const { return blocks_; }
  std::size_t bytes() const { return bytes_; }

 private:
  static void* allocate(void* user, std::size_t size) {
    auto& self = *static_cast<CallerMemory*>(user);
    const std::size_t number = self.requests_++;
    if (number >= self.first_refused_ && number <= self.last_refused_) return nullptr;
    ++self.blocks_;
    self.bytes_ += size;
    return std::malloc(size);
  }
  static void release(void* user, void* memory, std::size_t size) {
    auto& self = *static_cast<CallerMemory*>(user);
    --self.blocks_;
    self.bytes_ -= size;
    std::free(memory);
  }

  std::size_t first_refused_ = kNever, last_refused_ = kNever;
  std::size_t requests_ = 0, blocks_ = 0, bytes_ = 0;
};

}  // namespace zerotree::test
