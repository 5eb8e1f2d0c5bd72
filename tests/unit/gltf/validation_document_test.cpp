#include "validation_document.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "gltf/issue_table.h"

namespace zerotree::gltf {
namespace {

TEST(ValidationDocument, IsFresh) {
  const std::string path = std::string(ZEROTREE_SPEC_DIR) + "/VALIDATION.md";
  std::ifstream in(path);
  ASSERT_TRUE(in.is_open()) << path;
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_TRUE(text == test::validation_document())
      << path << " is not what the table of issues says: write it anew with\n"
      << "build/release/bin/write_validation_document > extension-spec/VALIDATION.md";
}

TEST(IssueTable, EveryRowIsComplete) {
  for (const IssueText& row : issue_table()) {
    EXPECT_FALSE(std::string(row.text).empty()) << row.id;
    EXPECT_FALSE(std::string(row.what_to_do).empty()) << row.id;
  }
}

TEST(IssueTable, RepeatedIssuesAreRemoved) {
  Issues issues = {{IssueCode::io_error, "/a", "1"},
                   {IssueCode::io_error, "/b", ""},
                   {IssueCode::io_error, "/a", "2"},
                   {IssueCode::type_mismatch, "/a", ""}};
  remove_repeated(issues);
  ASSERT_EQ(issues.size(), 3u);
  EXPECT_EQ(issues[0].detail, "1");
  EXPECT_EQ(issues[2].code, IssueCode::type_mismatch);
}

}  // namespace
}  // namespace zerotree::gltf
