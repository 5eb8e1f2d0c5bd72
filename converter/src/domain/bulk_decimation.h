// Many independent collapses at a time, far above the size of the base.
#pragma once

#include "domain/collapse_choice.h"

namespace zerotree::domain {

/// Collapses about the cheapest vertices until `target` are left or few can be collapsed. Works in
/// passes: in each, the costs are brought up to date in parallel, and of the cheaper half those
/// collapses are done that don't touch each other, the cheapest first. They are chosen in parallel
/// in parts of the mesh that don't depend on the number of threads, so neither does the result.
void decimate_in_bulk(DecimationState& state, std::size_t target, const Progress& progress);

}  // namespace zerotree::domain
