// The values of one channel of one level, in as few bytes as they need.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory_resource>
#include <utility>

#include "bitstream/raw_memory.h"

namespace zerotree::bitstream {

/// Values as a CoefficientSet has them, indexed by cell within the level: 16 bits each until one
/// needs more, which takes a magnitude of more than 14 bits.
class LevelValues {
 public:
  /// A value whose magnitude has at most so many bit planes fits into 16 bits.
  static constexpr int kNarrowPlanes = 14;

  LevelValues() = default;
  /// Takes memory but does not write it: nothing may be read before `clear`.
  LevelValues(std::size_t count, bool wide, std::pmr::memory_resource* resource)
      : count_(count), is_wide_(wide), memory_(count * bytes_each(wide), resource) {}

  std::size_t size() const { return count_; }
  bool is_wide() const { return is_wide_; }
  /// The values: `narrow` unless `is_wide`, then `wide`.
  std::int16_t* narrow() { return static_cast<std::int16_t*>(memory_.data()); }
  const std::int16_t* narrow() const { return static_cast<const std::int16_t*>(memory_.data()); }
  std::int32_t* wide() { return static_cast<std::int32_t*>(memory_.data()); }
  const std::int32_t* wide() const { return static_cast<const std::int32_t*>(memory_.data()); }

  std::int32_t get(std::size_t cell) const { return is_wide_ ? wide()[cell] : narrow()[cell]; }
  /// Not wide: `value` fits into 16 bits.
  void set(std::size_t cell, std::int32_t value) {
    if (is_wide_) {
      wide()[cell] = value;
    } else {
      narrow()[cell] = static_cast<std::int16_t>(value);
    }
  }

  /// All values become zero.
  void clear() { std::memset(memory_.data(), 0, memory_.size()); }

  /// Values become 32 bits each. Takes memory, the only time after the beginning.
  void widen() {
    RawMemory more(count_ * bytes_each(true), memory_.resource());
    auto* values = static_cast<std::int32_t*>(more.data());
    for (std::size_t i = 0; i < count_; ++i) values[i] = narrow()[i];
    memory_ = std::move(more);
    is_wide_ = true;
  }

 private:
  static constexpr std::size_t bytes_each(bool wide) { return wide ? 4 : 2; }

  std::size_t count_ = 0;
  bool is_wide_ = false;
  RawMemory memory_;
};

}  // namespace zerotree::bitstream
