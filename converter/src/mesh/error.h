// The one exception type of the converter and the exit code it ends in.
#pragma once

#include <stdexcept>
#include <string>

namespace zerotree {

/// Exit codes of the command `zerotree` (README, "Exit codes").
enum class ExitCode {
  done = 0,
  internal = 1,
  usage = 2,
  unreadable_input = 3,
  refused_topology = 4,
  target_not_reachable = 5,
  memory_limit = 6,
  output_failed_check = 7,
};

/// A failure that is told to a person: the message names the file or the place and what to do.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

}  // namespace zerotree
