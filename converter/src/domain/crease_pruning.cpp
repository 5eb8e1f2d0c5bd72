#include "domain/crease_pruning.h"

#include <numeric>

namespace zerotree::domain {
namespace {

constexpr int kMostRounds = 20;

class ArcPruner {
 public:
  ArcPruner(std::size_t vertex_count, const std::vector<CreaseSegment>& segments,
            const PruningRule& rule)
      : segments_(segments),
        rule_(rule),
        alive_(segments.size(), 1),
        visited_(segments.size(), 0),
        degree_(vertex_count, 0),
        begin_(vertex_count + 1, 0) {
    for (const CreaseSegment& segment : segments)
      for (std::uint32_t v : segment.ends) ++begin_[v + 1];
    for (std::size_t v = 0; v < vertex_count; ++v) degree_[v] = begin_[v + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    incident_.resize(2 * segments.size());
    std::vector<std::uint32_t> end(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t s = 0; s < segments.size(); ++s)
      for (std::uint32_t v : segments[s].ends) incident_[end[v]++] = s;
  }

  // Whether an arc went. `only_free`: only arcs of which an end is free.
  bool prune(bool only_free) {
    visited_.assign(segments_.size(), 0);
    bool changed = false;
    for (std::uint32_t s = 0; s < segments_.size(); ++s) {
      if (alive_[s] == 0 || visited_[s] != 0) continue;
      trace(s);
      if ((only_free && !has_free_end_) || !is_weak_and_short()) continue;
      for (std::uint32_t gone : arc_) {
        alive_[gone] = 0;
        for (std::uint32_t v : segments_[gone].ends) --degree_[v];
      }
      changed = true;
    }
    return changed;
  }

  std::vector<std::uint8_t> take_alive() { return std::move(alive_); }

 private:
  // The arc of segment `s`, into arc_.
  void trace(std::uint32_t s) {
    arc_.assign(1, s);
    visited_[s] = 1;
    has_free_end_ = false;
    for (std::uint32_t v : segments_[s].ends) {
      std::uint32_t last = s;
      while (degree_[v] == 2) {
        const std::uint32_t next = other_segment(v, last);
        if (visited_[next] != 0) break;  // a closed arc
        visited_[next] = 1;
        arc_.push_back(next);
        last = next;
        const auto& ends = segments_[next].ends;
        v = ends[0] == v ? ends[1] : ends[0];
      }
      has_free_end_ = has_free_end_ || degree_[v] == 1;
    }
  }

  std::uint32_t other_segment(std::uint32_t v, std::uint32_t segment) const {
    for (std::uint32_t i = begin_[v]; i < begin_[v + 1]; ++i)
      if (alive_[incident_[i]] != 0 && incident_[i] != segment) return incident_[i];
    return segment;
  }

  bool is_weak_and_short() const {
    std::size_t strong = 0;
    double length = 0;
    for (std::uint32_t s : arc_) {
      strong += segments_[s].strong ? 1 : 0;
      length += segments_[s].length;
    }
    return 2 * strong < arc_.size() && (length < rule_.min_length || arc_.size() < rule_.min_edges);
  }

  const std::vector<CreaseSegment>& segments_;
  const PruningRule rule_;
  std::vector<std::uint8_t> alive_, visited_;
  std::vector<std::uint32_t> degree_, begin_, incident_;
  std::vector<std::uint32_t> arc_;
  bool has_free_end_ = false;
};

}  // namespace

std::vector<std::uint8_t> prune_weak_arcs(std::size_t vertex_count,
                                          const std::vector<CreaseSegment>& segments,
                                          const PruningRule& rule) {
  ArcPruner pruner(vertex_count, segments, rule);
  for (int round = 0; round < kMostRounds; ++round)
    if (!pruner.prune(true) && !pruner.prune(false)) break;
  return pruner.take_alive();
}

}  // namespace zerotree::domain
