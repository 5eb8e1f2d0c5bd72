#include "gltf/scene_check.h"

#include <cmath>
#include <string>
#include <vector>

#include "gltf/property_check.h"

namespace zerotree::gltf {
namespace {

using nlohmann::json;

// glTF-Validator's; a quaternion of bytes can be off by as much.
constexpr double kRotationTolerance = 0.00769;

bool has(const json& object, const char* key) {
  return object.is_object() && object.contains(key) && !object[key].is_null();
}

std::string node_pointer(std::size_t node) {
  return "/nodes/" + std::to_string(node);
}

void check_transform(const json& node, const std::string& pointer, Issues& issues) {
  if (has(node, "matrix") &&
      (has(node, "translation") || has(node, "rotation") || has(node, "scale")))
    issues.push_back({IssueCode::node_matrix_trs, pointer + "/matrix", ""});
  if (!has(node, "rotation")) return;
  double squares = 0;
  for (const json& value : node["rotation"]) squares += value.get<double>() * value.get<double>();
  if (std::abs(std::sqrt(squares) - 1) > kRotationTolerance)
    issues.push_back({IssueCode::rotation_non_unit, pointer + "/rotation",
                      "its length is " + std::to_string(std::sqrt(squares))});
}

// The parent of each node, kNoIndex for roots; the last one where several claim it.
std::vector<std::uint64_t> find_parents(const json& nodes, Issues& issues) {
  std::vector<std::uint64_t> parents(nodes.size(), kNoIndex);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    std::size_t place = 0;
    for (const json& entry : list_or_empty(nodes[i], "children")) {
      if (!entry.is_null()) {
        std::uint64_t& parent = parents[entry.get<std::uint64_t>()];
        if (parent != kNoIndex)
          issues.push_back(
              {IssueCode::node_parent_override,
               node_pointer(i) + "/children/" + std::to_string(place),
               "node " + entry.dump() + " is a child of node " + std::to_string(parent)});
        parent = i;
      }
      ++place;
    }
  }
  return parents;
}

// A node has one parent, so each walk towards the root ends in one, in a loop, or where an earlier
// walk has been.
void check_loops(const std::vector<std::uint64_t>& parents, Issues& issues) {
  std::vector<std::size_t> walk_of(parents.size(), 0);
  for (std::size_t start = 0; start < parents.size(); ++start) {
    const std::size_t walk = start + 1;
    std::uint64_t node = start;
    while (node != kNoIndex && walk_of[node] == 0) {
      walk_of[node] = walk;
      node = parents[node];
    }
    if (node == kNoIndex || walk_of[node] != walk) continue;
    const std::uint64_t first = node;
    do {
      issues.push_back({IssueCode::node_loop, node_pointer(node), ""});
      node = parents[node];
    } while (node != first);
  }
}

}  // namespace

void check_scenes(const json& core, Issues& issues) {
  const json& nodes = list_or_empty(core, "nodes");
  for (std::size_t i = 0; i < nodes.size(); ++i) check_transform(nodes[i], node_pointer(i), issues);
  const std::vector<std::uint64_t> parents = find_parents(nodes, issues);
  check_loops(parents, issues);
  const json& scenes = list_or_empty(core, "scenes");
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    std::size_t place = 0;
    for (const json& entry : list_or_empty(scenes[i], "nodes")) {
      if (!entry.is_null() && parents[entry.get<std::uint64_t>()] != kNoIndex)
        issues.push_back({IssueCode::scene_non_root_node,
                          "/scenes/" + std::to_string(i) + "/nodes/" + std::to_string(place),
                          "node " + entry.dump()});
      ++place;
    }
  }
}

}  // namespace zerotree::gltf
