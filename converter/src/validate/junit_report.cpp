#include "validate/junit_report.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <pugixml.hpp>
#include <sstream>
#include <string_view>

namespace zerotree::validate {
namespace {

using gltf::Severity;

constexpr const char* kSuite = "zerotree validate";

// Bytes of the UTF-8 character at the front of `text` if XML 1.0 can hold it, else 0.
std::size_t character_size(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t first = byte(0);
  if (first < 0x80) return first >= 0x20 || first == '\n' || first == '\t' ? 1 : 0;
  const std::size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < size) return 0;
  std::uint32_t code = first & (0x7fu >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3fu);
  }
  const bool is_overlong = code < (size == 2 ? 0x80u : size == 3 ? 0x800u : 0x10000u);
  const bool is_no_character =
      (code >= 0xd800 && code < 0xe000) || code == 0xfffe || code == 0xffff || code > 0x10ffff;
  return is_overlong || is_no_character ? 0 : size;
}

std::string xml_text(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t size = character_size(text);
    result += size > 0 ? text.substr(0, size) : std::string_view("\xef\xbf\xbd");
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return result;
}

std::string seconds(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", value);
  return text;
}

std::string line_of(const gltf::Issue& issue) {
  const gltf::IssueText& row = gltf::issue_text(issue.code);
  std::string line = std::string(severity_name(row.severity)) + " " + row.id;
  if (!issue.pointer.empty()) line.append(" at ").append(issue.pointer);
  return line.append(": ").append(gltf::issue_message(issue)).append("\n");
}

void set(pugi::xml_node node, const char* name, const std::string& value) {
  node.append_attribute(name).set_value(xml_text(value).c_str());
}

void add_case(pugi::xml_node suite, const ValidationReport& report) {
  pugi::xml_node test = suite.append_child("testcase");
  set(test, "classname", "zerotree.validate");
  set(test, "name", report.uri);
  set(test, "time", seconds(report.seconds));
  std::string errors, rest;
  for (const gltf::Issue& issue : report.issues)
    (gltf::is_error(issue) ? errors : rest) += line_of(issue);
  if (const gltf::Issue* first = gltf::first_error(report.issues)) {
    pugi::xml_node failure = test.append_child(report.is_unreadable ? "error" : "failure");
    set(failure, "type", gltf::issue_text(first->code).id);
    set(failure, "message", gltf::issue_message(*first));
    failure.text().set(xml_text(errors).c_str());
  }
  if (!rest.empty()) test.append_child("system-out").text().set(xml_text(rest).c_str());
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
