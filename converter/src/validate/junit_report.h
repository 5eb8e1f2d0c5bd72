// Reports as JUnit XML, which continuous integration shows test by test.
#pragma once

#include <span>
#include <string>

#include "validate/validation_report.h"

namespace zerotree::validate {

/// One test suite with a test case per file: a failure if the file has errors, an error if it could
/// not be read; the messages of all severities are in its output. Bytes that XML cannot hold become
/// replacement characters.
std::string junit_xml(std::span<const ValidationReport> reports);

}  // namespace zerotree::validate
