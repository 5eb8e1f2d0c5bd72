#include "cli/terminal_progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace zerotree::cli {

TerminalProgress::TerminalProgress() : is_terminal_(isatty(STDERR_FILENO) != 0) {}

TerminalProgress::~TerminalProgress() {
  if (!shown_.empty()) std::fputs("\r\033[K", stderr);
}

Progress TerminalProgress::callback() {
  if (!is_terminal_) return {};
  return [this](std::string_view step, double share) { show(step, share); };
}

void TerminalProgress::show(std::string_view step, double share) {
  const int percent = static_cast<int>(std::clamp(share, 0.0, 1.0) * 100);
  char line[128];
  std::snprintf(line, sizeof line, "\r\033[K%-28.*s %3d %%", static_cast<int>(step.size()),
                step.data(), percent);
  if (shown_ == line) return;
  shown_ = line;
  std::fputs(line, stderr);
  std::fflush(stderr);
}

}  // namespace zerotree::cli
