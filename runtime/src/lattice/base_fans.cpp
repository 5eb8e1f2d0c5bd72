#include "lattice/base_fans.h"

#include <map>
#include <stdexcept>
#include <string>

#include "surface/fan_masks.h"
#include "surface/local_filter.h"
#include "surface/loop_refiner.h"

namespace zerotree::surface {

namespace {

using Rule = OpenSubdiv::Sdc::Crease::Rule;

/// Vertices of finer levels are numbered by OpenSubdiv's base edges: the format relies on these
/// being the stream's.
void check_numbering(const RefinerLevel& base, const std::vector<bitstream::BaseEdge>& edges) {
  bool is_same = static_cast<std::size_t>(base.GetNumEdges()) == edges.size();
  for (int edge = 0; is_same && edge < base.GetNumEdges(); ++edge) {
    const auto& [tail, head] = edges[static_cast<std::size_t>(edge)].vertices;
    const auto ends = base.GetEdgeVertices(edge);
    is_same = ends[0] == static_cast<int>(tail) && ends[1] == static_cast<int>(head);
  }
  if (!is_same) throw std::invalid_argument("OpenSubdiv numbers the base edges in another way");
}

Fan fan_of(const RefinerLevel& base, int vertex) {
  Fan fan{base.IsVertexBoundary(vertex), {}};
  for (const int edge : base.GetVertexEdges(vertex))
    fan.sharpness.push_back(base.GetEdgeSharpness(edge));
  return fan;
}

}  // namespace

/// Finds the weights of vertices; those of fans that are alike once.
class BaseFans::Builder {
 public:
  Builder(BaseFans& fans, const RefinerLevel& base) : fans_(fans), base_(base) {}

  std::uint32_t weights_of(int vertex) {
    const auto [place, is_new] =
        known_.try_emplace(kind_of(vertex), static_cast<std::uint32_t>(fans_.weights_.size()));
    if (is_new) add_weights(vertex);
    return place->second;
  }

 private:
  /// All that the weights depend on: tags are infinitely sharp, so an edge is sharp or not.
  std::string kind_of(int vertex) const {
    std::string kind{static_cast<char>(base_.GetVertexRule(vertex)),
                     base_.IsVertexBoundary(vertex) ? 'b' : 'i'};
    for (const int edge : base_.GetVertexEdges(vertex)) kind += is_sharp(base_, edge) ? 's' : '-';
    return kind;
  }

  void add_weights(int vertex) {
    const Fan fan = fan_of(base_, vertex);
    const Rule rule = base_.GetVertexRule(vertex);
    const FanMask child = child_mask(fan, rule);
    const LimitMasks limit = limit_masks(fan, rule);
    fans_.weights_.push_back(
        {{child.vertex, limit.position.vertex, limit.tangent1.vertex, limit.tangent2.vertex, 0.0f},
         dip_per_lift(rule),
         static_cast<std::uint32_t>(fans_.spoke_weights_.size())});
    const auto around = base_.GetVertexEdges(vertex);
    for (int k = 0; k < around.size(); ++k) {
      const auto spoke = static_cast<std::size_t>(k);
      const float lift = end_weights(rule, around.size(), is_sharp(base_, around[k])).lift;
      fans_.spoke_weights_.push_back({child.edges[spoke], limit.position.edges[spoke],
                                      limit.tangent1.edges[spoke], limit.tangent2.edges[spoke],
                                      lift});
    }
  }

  BaseFans& fans_;
  const RefinerLevel& base_;
  std::map<std::string, std::uint32_t> known_;
};

BaseFans::BaseFans(const bitstream::BaseTopology& topology,
                   const std::vector<bitstream::BaseEdge>& edges, std::pmr::memory_resource* memory)
    : strips_(memory),
      spoke_begin_(memory),
      spokes_(memory),
      weights_of_(memory),
      weights_(memory),
      spoke_weights_(memory) {
  const auto refiner = make_loop_refiner(topology, edges, 0);
  const RefinerLevel& base = refiner->GetLevel(0);
  check_numbering(base, edges);
  strips_.reserve(edges.size());
  for (const bitstream::BaseEdge& edge : edges) {
    const bool sharp = is_sharp(base, static_cast<int>(strips_.size()));
    strips_.push_back({edge.faces, edge.local, sharp});
  }
  spoke_begin_.reserve(std::size_t{topology.vertex_count} + 1);
  spokes_.reserve(2 * edges.size());
  weights_of_.reserve(topology.vertex_count);
  Builder builder(*this, base);
  for (int vertex = 0; vertex < base.GetNumVertices(); ++vertex) {
    spoke_begin_.push_back(static_cast<std::uint32_t>(spokes_.size()));
    for (const int edge : base.GetVertexEdges(vertex))
      spokes_.emplace_back(static_cast<std::uint32_t>(edge),
                           base.GetEdgeVertices(edge)[1] == vertex);
    weights_of_.push_back(builder.weights_of(vertex));
  }
  spoke_begin_.push_back(static_cast<std::uint32_t>(spokes_.size()));
}

BaseFans::View BaseFans::fan(std::size_t vertex) const {
  const std::size_t first = spoke_begin_[vertex], count = spoke_begin_[vertex + 1] - first;
  const SharedWeights& weights = weights_[weights_of_[vertex]];
  return {weights.vertex, weights.dip_per_lift, std::span(spokes_).subspan(first, count),
          std::span(spoke_weights_).subspan(weights.first_spoke, count)};
}

}  // namespace zerotree::surface
