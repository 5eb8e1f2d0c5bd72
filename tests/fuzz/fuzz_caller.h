// What the fuzzer's application gives to a decoder: memory, threads, buffers. And its checks.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <random>
#include <vector>

#include "zerotree/zerotree.h"

#define EXPECT_THAT(condition)                                                     \
  do {                                                                             \
    if (!(condition)) {                                                            \
      std::fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                \
    }                                                                              \
  } while (false)

namespace zerotree::fuzz {

/// Counts what is held and fails from the n-th call on.
class CountingAllocator {
 public:
  explicit CountingAllocator(std::uint64_t failing) : left_(failing), is_failing_(failing > 0) {}
  ~CountingAllocator() { EXPECT_THAT(held_ == 0); }

  zt_allocator functions() { return {&allocate, &release, this}; }
  std::size_t held() const { return held_; }
  bool has_failed() const { return has_failed_; }

 private:
  static void* allocate(void* user, std::size_t size) {
    auto& self = *static_cast<CountingAllocator*>(user);
    if (self.is_failing_ && (self.left_ == 0 || --self.left_ == 0)) {
      self.has_failed_ = true;
      return nullptr;
    }
    self.held_ += size;
    return std::malloc(size);
  }
  static void release(void* user, void* memory, std::size_t size) {
    auto& self = *static_cast<CountingAllocator*>(user);
    EXPECT_THAT(memory != nullptr && self.held_ >= size);
    self.held_ -= size;
    std::free(memory);
  }

  std::uint64_t left_;
  bool is_failing_, has_failed_ = false;
  std::size_t held_ = 0;
};

/// Runs tasks in another order each time.
inline void run_shuffled(void* user, std::uint32_t count, zt_task task, void* context) {
  std::vector<std::uint32_t> order(count);
  for (std::uint32_t i = 0; i < count; ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), *static_cast<std::minstd_rand*>(user));
  for (const std::uint32_t i : order) task(context, i);
}

/// Room for vectors in exactly as many bytes as they need.
class ExactVectors {
 public:
  ExactVectors(std::size_t vertices, std::size_t stride)
      : stride_(stride),
        size_(vertices == 0 ? 0 : (vertices - 1) * stride + 12),
        bytes_(new unsigned char[size_]) {}

  void* data() { return bytes_.get(); }
  std::size_t stride() const { return stride_; }
  std::array<float, 3> get(std::size_t vertex) const {
    std::array<float, 3> value;
    std::memcpy(value.data(), bytes_.get() + vertex * stride_, 12);
    return value;
  }

 private:
  std::size_t stride_, size_;
  std::unique_ptr<unsigned char[]> bytes_;
};

}  // namespace zerotree::fuzz
