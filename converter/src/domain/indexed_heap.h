// A binary heap of vertices by cost whose entries can be changed in place.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace zerotree::domain {

/// Lowest cost first; equal costs by the lower index, so that the order never depends on history.
class IndexedHeap {
 public:
  explicit IndexedHeap(std::uint32_t index_count)
      : place_(index_count, kAbsent), cost_(index_count, 0.0) {}

  bool empty() const { return heap_.empty(); }
  bool contains(std::uint32_t index) const { return place_[index] != kAbsent; }
  std::uint32_t top() const { return heap_.front(); }
  double cost(std::uint32_t index) const { return cost_[index]; }

  /// Inserts `index` or changes its cost.
  void set(std::uint32_t index, double cost) {
    cost_[index] = cost;
    if (place_[index] == kAbsent) {
      place_[index] = static_cast<std::uint32_t>(heap_.size());
      heap_.push_back(index);
    }
    rise(place_[index]);
    sink(place_[index]);
  }

  /// Removes `index` if it is there.
  void remove(std::uint32_t index) {
    const std::uint32_t place = place_[index];
    if (place == kAbsent) return;
    swap_places(place, static_cast<std::uint32_t>(heap_.size() - 1));
    heap_.pop_back();
    place_[index] = kAbsent;
    if (place == heap_.size()) return;
    const std::uint32_t moved = heap_[place];
    rise(place_[moved]);
    sink(place_[moved]);
  }

 private:
  static constexpr std::uint32_t kAbsent = 0xffffffffu;

  bool before(std::uint32_t a, std::uint32_t b) const {
    return cost_[a] < cost_[b] || (cost_[a] == cost_[b] && a < b);
  }
  void swap_places(std::uint32_t i, std::uint32_t j) {
    std::swap(heap_[i], heap_[j]);
    place_[heap_[i]] = i;
    place_[heap_[j]] = j;
  }
  void rise(std::uint32_t i) {
    for (; i > 0 && before(heap_[i], heap_[(i - 1) / 2]); i = (i - 1) / 2)
      swap_places(i, (i - 1) / 2);
  }
  void sink(std::uint32_t i) {
    while (true) {
      std::uint32_t least = i;
      for (std::uint32_t child = 2 * i + 1; child <= 2 * i + 2 && child < heap_.size(); ++child)
        if (before(heap_[child], heap_[least])) least = child;
      if (least == i) return;
      swap_places(i, least);
      i = least;
    }
  }

  std::vector<std::uint32_t> heap_;
  std::vector<std::uint32_t> place_;
  std::vector<double> cost_;
};

}  // namespace zerotree::domain
