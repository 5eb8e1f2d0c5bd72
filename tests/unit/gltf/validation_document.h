// The appendix of the specification that lists what a validator reports.
#pragma once

#include <string>

namespace zerotree::test {

/// extension-spec/VALIDATION.md as the table of issues says it.
std::string validation_document();

}  // namespace zerotree::test
