#include "gltf/json_text.h"

#include <set>
#include <string>
#include <vector>

#include "gltf/json_cursor.h"

namespace zerotree::gltf {
namespace {

using nlohmann::json;

[[noreturn]] void fail(IssueCode code, std::string pointer, std::string detail) {
  throw IssueFound({code, std::move(pointer), std::move(detail)});
}

// Sees the text before it becomes a document: keys of the open objects, and the place it is at. The
// parser with a callback would do both in one pass, but looks at all elements of an array each time
// one ends.
class NestingWatch : public nlohmann::json_sax<json> {
 public:
  bool null() override { return count_element(); }
  bool boolean(bool) override { return count_element(); }
  bool number_integer(number_integer_t) override { return count_element(); }
  bool number_unsigned(number_unsigned_t) override { return count_element(); }
  bool number_float(number_float_t, const string_t&) override { return count_element(); }
  bool string(string_t&) override { return count_element(); }
  bool binary(binary_t&) override { return count_element(); }
  bool start_object(std::size_t) override { return open(true); }
  bool start_array(std::size_t) override { return open(false); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& key) override {
    open_.back().at = key;
    if (!open_.back().keys.insert(key).second) fail(IssueCode::json_key_repeated, pointer(), "");
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const json::exception& error) override {
    fail(IssueCode::invalid_json, "", error.what());
  }

 private:
  struct Open {
    bool is_object = false;
    std::size_t elements = 0;
    std::string at;
    std::set<std::string> keys;
  };

  bool count_element() {
    if (!open_.empty() && !open_.back().is_object)
      open_.back().at = std::to_string(open_.back().elements++);
    return true;
  }

  bool open(bool is_object) {
    count_element();
    if (open_.size() == kMostNesting)
      fail(IssueCode::invalid_json, "",
           "nested more than " + std::to_string(kMostNesting) + " deep");
    open_.emplace_back().is_object = is_object;
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  std::string pointer() const {
    std::string text;
    for (const Open& open : open_) text.append("/").append(escaped_key(open.at));
    return text;
  }

  std::vector<Open> open_;
};

}  // namespace

json parse_json(std::string_view text) {
  // The parser takes these as a part of white space and as the end of the text.
  if (text.starts_with("\xEF\xBB\xBF"))
    fail(IssueCode::invalid_json, "", "it begins with a byte order mark");
  if (const std::size_t zero = text.find('\0'); zero != text.npos)
    fail(IssueCode::invalid_json, "",
         "byte " + std::to_string(zero) + " is 0: JSON is padded with spaces");
  NestingWatch watch;
  json::sax_parse(text, &watch);
  json root = json::parse(text);
  if (!root.is_object()) fail(IssueCode::type_mismatch, "", "an object is expected");
  return root;
}

}  // namespace zerotree::gltf
