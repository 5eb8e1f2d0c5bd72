#include "validate/junit_report.h"

#include <gtest/gtest.h>

#include <pugixml.hpp>

#include "validate/file_validation.h"

namespace zerotree::validate {
namespace {

using gltf::IssueCode;

ValidationReport report_of(const std::string& uri, gltf::Issues issues) {
  ValidationReport report;
  report.uri = uri;
  report.issues = std::move(issues);
  report.seconds = 0.25;
  return report;
}

pugi::xml_document parsed(const std::string& xml) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_string(xml.c_str());
  EXPECT_TRUE(result) << result.description() << "\n" << xml;
  return document;
}

TEST(Junit, HasACaseForEachFile) {
  const std::vector<ValidationReport> reports{
      report_of("right.glb", {{IssueCode::payload_incomplete, "/a", ""}}),
      report_of("wrong.glb", {{IssueCode::bounds_loose, "", ""},
                              {IssueCode::prefix_end, "/meshes/0", "3 of 4 bytes"},
                              {IssueCode::budget_bytes, "", "7 bytes, allowed are 5"}}),
      unreadable_report("gone.glb", "there is no such file")};
  const std::string xml = junit_xml(reports);
  EXPECT_EQ(junit_xml(reports), xml);
  const pugi::xml_document document = parsed(xml);
  for (const pugi::xml_node node :
       {document.child("testsuites"), document.child("testsuites").child("testsuite")}) {
    EXPECT_STREQ(node.attribute("tests").value(), "3");
    EXPECT_STREQ(node.attribute("failures").value(), "1");
    EXPECT_STREQ(node.attribute("errors").value(), "1");
    EXPECT_STREQ(node.attribute("time").value(), "0.500");
  }
  auto test = document.child("testsuites").child("testsuite").child("testcase");
  EXPECT_STREQ(test.attribute("name").value(), "right.glb");
  EXPECT_STREQ(test.attribute("time").value(), "0.250");
  EXPECT_FALSE(test.child("failure") || test.child("error"));
  EXPECT_NE(
      std::string(test.child("system-out").text().get()).find("info PAYLOAD_INCOMPLETE at /a"),
      std::string::npos);
  test = test.next_sibling("testcase");
  EXPECT_STREQ(test.attribute("name").value(), "wrong.glb");
  EXPECT_STREQ(test.child("failure").attribute("type").value(), "PREFIX_END");
  const std::string failure = test.child("failure").text().get();
  EXPECT_NE(failure.find("error PREFIX_END at /meshes/0: "), std::string::npos);
  EXPECT_NE(failure.find("3 of 4 bytes"), std::string::npos);
  EXPECT_NE(failure.find("7 bytes, allowed are 5"), std::string::npos);
  EXPECT_EQ(failure.find("BOUNDS_LOOSE"), std::string::npos);
  test = test.next_sibling("testcase");
  EXPECT_FALSE(test.child("failure"));
  EXPECT_STREQ(test.child("error").attribute("type").value(), "IO_ERROR");
}

TEST(Junit, EscapesWhatXmlCannotHold) {
  const std::string name = "a<b>&\"c' \xc3\xa4 \xf0\x9f\x90\x87 .glb";
  const auto case_name = [](const std::string& uri) {
    const std::vector<ValidationReport> reports{report_of(uri, {{IssueCode::prefix_end, "", uri}})};
    const pugi::xml_document document = parsed(junit_xml(reports));
    const auto test = document.child("testsuites").child("testsuite").child("testcase");
    EXPECT_NE(std::string(test.child("failure").text().get()).find(test.attribute("name").value()),
              std::string::npos);
    return std::string(test.attribute("name").value());
  };
  EXPECT_EQ(case_name(name), name);
  const std::string bad = "\xef\xbf\xbd";
  EXPECT_EQ(case_name("a\x01"
                      "b"),
            "a" + bad + "b");
  EXPECT_EQ(case_name("a\xff\xc3("
                      "b\xc0\x80"),
            "a" + bad + bad + "(b" + bad + bad);
  EXPECT_EQ(case_name("\xed\xa0\x80"), bad + bad + bad);  // half of a surrogate pair
  EXPECT_EQ(case_name("cut \xf0\x9f\x90"), "cut " + bad + bad + bad);
  EXPECT_EQ(case_name("\xef\xbf\xbe"), bad + bad + bad);  // no character
}

}  // namespace
}  // namespace zerotree::validate
