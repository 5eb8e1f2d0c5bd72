// JSON that a parser takes and a glTF reader must not.
#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "gltf/json_cursor.h"
#include "gltf/json_text.h"

namespace zerotree::gltf {
namespace {

// "CODE pointer", or "" if it was read.
std::string refusal(std::string_view text) {
  try {
    parse_json(text);
    return "";
  } catch (const IssueFound& found) {
    return std::string(issue_text(found.issue().code).id) + " " + found.issue().pointer;
  }
}

TEST(JsonText, WhatJsonAllowsIsRead) {
  EXPECT_EQ(refusal("{}"), "");
  EXPECT_EQ(refusal(" \n{\"a\": [{\"b\": 1}, {\"b\": 1}], \"b\": 1e300}\t "), "");
}

TEST(JsonText, SyntaxErrorsAreRefused) {
  for (const char* text :
       {"", "{", "{\"a\":}", "{}x", "{'a':1}", "{\"a\":1,}", "{\"a\":01}", "{\"a\":NaN}",
        "{\"a\":1e999}", "// comment\n{}", "{\"a\":\"\xff\"}", "{\"a\":\"\\ud800\"}"})
    EXPECT_EQ(refusal(text), "INVALID_JSON ") << text;
}

TEST(JsonText, ByteOrderMarksAndZerosAreRefused) {
  using namespace std::string_view_literals;
  EXPECT_EQ(refusal("\xEF\xBB\xBF{}"), "INVALID_JSON ");
  EXPECT_EQ(refusal("{}\0"sv), "INVALID_JSON ");
  EXPECT_EQ(refusal("{}\0rubbish"sv), "INVALID_JSON ");
}

TEST(JsonText, OtherValuesThanObjectsAreRefused) {
  for (const char* text : {"[]", "3", "null", "\"a\""})
    EXPECT_EQ(refusal(text), "TYPE_MISMATCH ") << text;
}

TEST(JsonText, RepeatedKeysAreRefused) {
  EXPECT_EQ(refusal(R"({"a":1,"a":1})"), "JSON_KEY_REPEATED /a");
  EXPECT_EQ(refusal(R"({"a":[0,{"b":{},"c/d":1,"c\u002fd":2}]})"), "JSON_KEY_REPEATED /a/1/c~1d");
}

TEST(JsonText, DeepNestingIsRefused) {
  const auto nested = [](std::size_t depth) {
    return "{\"a\":" + std::string(depth, '[') + std::string(depth, ']') + "}";
  };
  EXPECT_EQ(refusal(nested(kMostNesting - 1)), "");
  EXPECT_EQ(refusal(nested(kMostNesting)), "INVALID_JSON ");
  EXPECT_EQ(refusal(nested(5000000)), "INVALID_JSON ");
  EXPECT_EQ(refusal(std::string(5000000, '[')), "INVALID_JSON ");
}

TEST(JsonCursor, NamesWhatIsMissing) {
  const nlohmann::json root = parse_json(R"({"a":{"b":[1]}})");
  const auto pointer = [](const JsonCursor& place) {
    try {
      place.value();
    } catch (const IssueFound& found) {
      return found.issue().pointer + " " + found.issue().detail;
    }
    return std::string();
  };
  EXPECT_EQ(pointer(JsonCursor(root).member("a").member("c")), "/a \"c\"");
  EXPECT_EQ(pointer(JsonCursor(root).member("a").member("c").member("d")), "/a \"c\"");
  EXPECT_EQ(pointer(JsonCursor(root).member("x")), "/ \"x\"");
}

TEST(JsonCursor, NumbersEndAtDoublesExactIntegers) {
  const nlohmann::json root =
      parse_json(R"({"big":1e300,"max":18446744073709551615,"half":0.5,"less":-1})");
  EXPECT_EQ(JsonCursor(root).member("big").unsigned_integer(), std::uint64_t{1} << 53);
  EXPECT_EQ(JsonCursor(root).member("max").unsigned_integer(), std::uint64_t{1} << 53);
  EXPECT_THROW(JsonCursor(root).member("half").unsigned_integer(), IssueFound);
  EXPECT_THROW(JsonCursor(root).member("less").unsigned_integer(), IssueFound);
}

}  // namespace
}  // namespace zerotree::gltf
