// Numbers as people write them on the command line.
#pragma once

#include <string>

namespace zerotree::cli {

/// A distance: relative to the bounding box diagonal, or in metres if a unit was given.
struct Distance {
  double value = 0;
  bool in_metres = false;

  /// The distance relative to `diagonal` (in metres, glTF's unit).
  double relative_to(double diagonal) const { return in_metres ? value / diagonal : value; }
};

/// "1e-4", "0.5mm", "0.2cm", "0.001m". Throws Error(usage) naming `option` for anything else.
Distance parse_distance(const std::string& text, const std::string& option);

}  // namespace zerotree::cli
