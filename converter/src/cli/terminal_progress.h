// Progress of long work for a person at a terminal.
#pragma once

#include <string>

#include "mesh/progress.h"

namespace zerotree::cli {

/// One line on standard error that is rewritten as work goes on and cleared at the end. Silent
/// when standard error is not a terminal.
class TerminalProgress {
 public:
  TerminalProgress();
  ~TerminalProgress();
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;

  /// The callback to hand to a stage; valid as long as this object lives.
  Progress callback();

 private:
  void show(std::string_view step, double share);

  bool is_terminal_;
  std::string shown_;
};

}  // namespace zerotree::cli
