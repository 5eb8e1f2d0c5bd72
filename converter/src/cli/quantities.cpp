#include "cli/quantities.h"

#include <charconv>
#include <cmath>
#include <string_view>

#include "mesh/error.h"

namespace zerotree::cli {

Distance parse_distance(const std::string& text, const std::string& option) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  const bool is_number = error == std::errc() && std::isfinite(value) && value > 0;
  if (is_number && unit.empty()) return {value, false};
  if (is_number && unit == "mm") return {value * 1e-3, true};
  if (is_number && unit == "cm") return {value * 1e-2, true};
  if (is_number && unit == "m") return {value, true};
  throw Error(ExitCode::usage, option + ": \"" + text +
                                   "\" is not a distance: write a positive number, relative to "
                                   "the diagonal (1e-4) or with a unit (0.5mm, 0.2cm, 0.001m)");
}

}  // namespace zerotree::cli
