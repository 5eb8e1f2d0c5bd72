#include "validate/junit_report.h"

#include <cstdio>
#include <pugixml.hpp>
#include <sstream>

#include "validate/printable_text.h"

namespace zerotree::validate {
namespace {

using gltf::Severity;

constexpr const char* kSuite = "zerotree validate";

std::string seconds(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", value);
  return text;
}

void set(pugi::xml_node node, const char* name, const std::string& value) {
  node.append_attribute(name).set_value(printable_text(value).c_str());
}

void add_case(pugi::xml_node suite, const ValidationReport& report) {
  pugi::xml_node test = suite.append_child("testcase");
  set(test, "classname", "zerotree.validate");
  set(test, "name", report.uri);
  set(test, "time", seconds(report.seconds));
  std::string errors, rest;
  for (const gltf::Issue& issue : report.issues)
    (gltf::is_error(issue) ? errors : rest) += issue_line(issue) + "\n";
  if (const gltf::Issue* first = gltf::first_error(report.issues)) {
    pugi::xml_node failure = test.append_child(report.is_unreadable ? "error" : "failure");
    set(failure, "type", gltf::issue_text(first->code).id);
    set(failure, "message", gltf::issue_message(*first));
    failure.text().set(printable_text(errors).c_str());
  }
  if (!rest.empty()) test.append_child("system-out").text().set(printable_text(rest).c_str());
}

void add_totals(pugi::xml_node node, std::span<const ValidationReport> reports) {
  std::size_t failures = 0, errors = 0;
  double time = 0;
  for (const ValidationReport& report : reports) {
    errors += report.is_unreadable ? 1 : 0;
    failures += !report.is_unreadable && gltf::first_error(report.issues) != nullptr ? 1 : 0;
    time += report.seconds;
  }
  set(node, "name", kSuite);
  set(node, "tests", std::to_string(reports.size()));
  set(node, "failures", std::to_string(failures));
  set(node, "errors", std::to_string(errors));
  set(node, "skipped", "0");
  set(node, "time", seconds(time));
}

}  // namespace

std::string junit_xml(std::span<const ValidationReport> reports) {
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  set(declaration, "version", "1.0");
  set(declaration, "encoding", "UTF-8");
  pugi::xml_node root = document.append_child("testsuites");
  add_totals(root, reports);
  pugi::xml_node suite = root.append_child("testsuite");
  add_totals(suite, reports);
  for (const ValidationReport& report : reports) add_case(suite, report);
  std::ostringstream text;
  document.save(text, "  ", pugi::format_default, pugi::encoding_utf8);
  return text.str();
}

}  // namespace zerotree::validate
