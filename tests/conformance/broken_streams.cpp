#include "conformance_cases.h"
namespace zerotree::conformance {
std::vector<BrokenCase> broken_cases() {
  return {};
}
std::vector<FileCase> file_cases() {
  return {};
}
}  // namespace zerotree::conformance
