// Memory from a resource, not touched until somebody writes it.
#pragma once

#include <cstddef>
#include <memory_resource>
#include <utility>

namespace zerotree::bitstream {

/// Owns one block, aligned to cache lines, with no content.
class RawMemory {
 public:
  RawMemory() = default;
  RawMemory(std::size_t size, std::pmr::memory_resource* resource)
      : resource_(resource), size_(size), data_(resource->allocate(size, kAlignment)) {}
  RawMemory(RawMemory&& other) noexcept
      : resource_(other.resource_),
        size_(other.size_),
        data_(std::exchange(other.data_, nullptr)) {}
  RawMemory& operator=(RawMemory&& other) noexcept {
    std::swap(resource_, other.resource_);
    std::swap(size_, other.size_);
    std::swap(data_, other.data_);
    return *this;
  }
  ~RawMemory() {
    if (data_ != nullptr) resource_->deallocate(data_, size_, kAlignment);
  }

  void* data() const { return data_; }
  std::size_t size() const { return size_; }
  std::pmr::memory_resource* resource() const { return resource_; }

 private:
  static constexpr std::size_t kAlignment = 64;

  std::pmr::memory_resource* resource_ = nullptr;
  std::size_t size_ = 0;
  void* data_ = nullptr;
};

}  // namespace zerotree::bitstream
