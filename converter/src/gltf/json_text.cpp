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

// Watches the parser: keys of the open objects, and the place it is at.
class NestingWatch {
 public:
  void operator()(json::parse_event_t event, const json& value) {
    switch (event) {
      case json::parse_event_t::object_start:
      case json::parse_event_t::array_start:
        count_element();
        if (open_.size() == kMostNesting)
          fail(IssueCode::invalid_json, "",
               "nested more than " + std::to_string(kMostNesting) + " deep");
        open_.emplace_back().is_object = event == json::parse_event_t::object_start;
        break;
      case json::parse_event_t::object_end:
      case json::parse_event_t::array_end:
        open_.pop_back();
        break;
      case json::parse_event_t::key:
        open_.back().at = value.get_ref<const std::string&>();
        if (!open_.back().keys.insert(open_.back().at).second)
          fail(IssueCode::json_key_repeated, pointer(), "");
        break;
      case json::parse_event_t::value:
        count_element();
        break;
    }
  }

 private:
  struct Open {
    bool is_object = false;
    std::size_t elements = 0;
    std::string at;
    std::set<std::string> keys;
  };

  void count_element() {
    if (open_.empty() || open_.back().is_object) return;
    open_.back().at = std::to_string(open_.back().elements++);
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
  json root;
  try {
    root = json::parse(text, [&](int, json::parse_event_t event, json& value) {
      watch(event, value);
      return true;
    });
  } catch (const json::exception& error) {
    fail(IssueCode::invalid_json, "", error.what());
  }
  if (!root.is_object()) fail(IssueCode::type_mismatch, "", "an object is expected");
  return root;
}

}  // namespace zerotree::gltf
