// What the runtime needs beside time: memory, allocations, and how well it keeps to a budget.
#pragma once

#include "stream_session.h"

namespace zerotree::bench {

/// Prints one JSON object.
void print_runtime_facts(const Bytes& stream);

}  // namespace zerotree::bench
