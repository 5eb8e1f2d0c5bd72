// The local high pass filter of Loop wavelets: what a detail does beside its odd vertex.
#pragma once

#include <array>
#include <vector>

#include "surface/edge_forest.h"
#include "surface/loop_refiner.h"

namespace zerotree::surface {

/// Weights of each edge's detail at its end points {tail, head}. With d the details of the edges,
///   even vertices:  dip(v)  = sum of dips[e] d(e)     over the edges e at v
///   coarse points:  lift(v) = sum of lifts[e] d(e)
///   fine = P (coarse - lift), then every even vertex moves by -dip and every odd one by +d.
struct LocalFilter {
  std::vector<std::array<float, 2>> dips, lifts;
};

/// What a detail of weight 1 of an edge at a vertex does there.
struct EndWeights {
  float dip, lift;
};
/// Of an edge at a vertex of this rule and number of edges.
EndWeights end_weights(OpenSubdiv::Sdc::Crease::Rule rule, int valence, bool edge_is_sharp);
/// At a smooth vertex of valence 6.
EndWeights regular_weights();
/// The vertex's dip in units of its lift: the same for all edges that move it; 0 if none does.
float dip_per_lift(OpenSubdiv::Sdc::Crease::Rule rule);

/// The filter of `level`, whose edges are `edges`. At a smooth or dart vertex of valence k the dip
/// is 0.30 and the lift 0.05, both times 6 / k: a wavelet that dips beside its peak is close to
/// orthogonal to Loop's scaling functions, and the two together give it zero mean on the regular
/// lattice (1 - 2 * 0.30 - 2 * 0.05 * 4). Along boundaries and creases the curve has a filter of
/// its own (cubic B-spline), and no detail of an edge beside it moves it but where it ends in a
/// dart. Corners stay where they are.
LocalFilter local_filter(const RefinerLevel& level, const EdgeLevel& edges);

}  // namespace zerotree::surface
