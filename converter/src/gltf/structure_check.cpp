#include "gltf/structure_check.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <string>
#include <string_view>

#include "gltf/accessor_check.h"
#include "gltf/base_layout.h"
#include "gltf/primitive_check.h"
#include "gltf/property_check.h"
#include "gltf/scene_check.h"

namespace zerotree::gltf {
namespace {

using nlohmann::json;

// Extensions without which a file that uses them shows wrong shapes.
constexpr std::array<std::string_view, 1> kNeverOptional = {kQuantisationExtension};

std::set<std::string> names_in(const json& core, const char* list) {
  std::set<std::string> names;
  for (const json& name : list_or_empty(core, list)) names.insert(name.get<std::string>());
  return names;
}

void check_extension_lists(const json& core, Issues& issues) {
  if (core.contains("extensionsRequired") && !core.contains("extensionsUsed"))
    issues.push_back({IssueCode::unsatisfied_dependency, "/extensionsRequired", "extensionsUsed"});
  const std::set<std::string> used = names_in(core, "extensionsUsed");
  const std::set<std::string> required = names_in(core, "extensionsRequired");
  std::size_t index = 0;
  for (const json& entry : list_or_empty(core, "extensionsUsed")) {
    const auto& name = entry.get_ref<const std::string&>();
    const bool is_never_optional =
        std::find(kNeverOptional.begin(), kNeverOptional.end(), name) != kNeverOptional.end();
    if (is_never_optional && !required.contains(name))
      issues.push_back(
          {IssueCode::non_required_extension, "/extensionsUsed/" + std::to_string(index), name});
    ++index;
  }
  index = 0;
  for (const json& entry : list_or_empty(core, "extensionsRequired")) {
    const auto& name = entry.get_ref<const std::string&>();
    if (!used.contains(name))
      issues.push_back({IssueCode::unused_extension_required,
                        "/extensionsRequired/" + std::to_string(index), name});
    ++index;
  }
}

void check_minor_version(const JsonCursor& root, Issues& issues) {
  const auto asset = root.value().find("asset");
  if (asset == root.value().end() || !asset->is_object()) return;
  const auto place = asset->find("version");
  if (place == asset->end() || !place->is_string()) return;
  const auto& version = place->get_ref<const std::string&>();
  const std::string minor = version.substr(version.find('.') + 1);
  if (minor.find_first_not_of('0') != minor.npos)
    issues.push_back({IssueCode::unknown_asset_minor_version, "/asset/version", version});
}

}  // namespace

void check_structure(GltfDocument& document, Issues& issues) {
  Issues found;
  const json core = checked_object(document.root(), document.root(), kRootType, found);
  check_minor_version(document.root(), found);
  check_extension_lists(core, found);
  check_scenes(core, found);
  AccessorCheck accessors(document, core, found);
  const std::vector<LinkedAccessor> linked = accessors.check();
  check_primitives(core, linked, found);
  remove_repeated(found);
  std::move(found.begin(), found.end(), std::back_inserter(issues));
}

}  // namespace zerotree::gltf
