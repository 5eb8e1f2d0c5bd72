#include "gltf/progressive_reader.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "gltf/packed_view.h"
#include "gltf/property_check.h"
#include "mesh/error.h"

namespace zerotree::gltf {
namespace {

constexpr std::uint64_t kTriangles = 4;
// More than a decoder with its usual limits can take.
constexpr std::size_t kMostBaseTriangles = std::size_t{1} << 24;

// Runs a step of reading; what it finds wrong becomes an issue. False if it did not come through.
template <class Step>
bool collect(Issues& issues, Step step) {
  try {
    step();
    return true;
  } catch (const IssueFound& found) {
    issues.push_back(found.issue());
    return false;
  }
}

JsonCursor extension_of(const JsonCursor& object) {
  return object.member("extensions").member(kExtensionName);
}

bool lists_extension(const JsonCursor& list) {
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list.element(i).value() == kExtensionName) return true;
  return false;
}

// Those of `mesh`, all of them objects.
JsonCursor primitives_of(const JsonCursor& mesh) {
  const JsonCursor primitives = mesh.member("primitives");
  primitives.value();
  if (primitives.size() == 0) primitives.fail(IssueCode::empty_entity, "");
  for (const nlohmann::json& primitive : primitives.value())
    if (!primitive.is_object())
      primitives.fail(IssueCode::array_type_mismatch, "objects are expected");
  return primitives;
}

void check_misplaced(const JsonCursor& object, Issues& issues) {
  collect(issues, [&] {
    const JsonCursor extension = extension_of(object);
    if (extension.exists()) extension.fail(IssueCode::extension_misplaced, "");
  });
}

void check_misplaced_everywhere(const JsonCursor& root, Issues& issues) {
  check_misplaced(root, issues);
  for (const char* list : {"accessors", "bufferViews", "buffers", "materials", "nodes", "scenes"})
    collect(issues, [&] {
      const JsonCursor objects = root.member(list);
      for (std::size_t i = 0; i < objects.size(); ++i) check_misplaced(objects.element(i), issues);
    });
}

Eigen::Vector3d read_vector(const JsonCursor& vector) {
  vector.value();
  if (vector.size() == 0) vector.fail(IssueCode::empty_entity, "");
  if (vector.size() != 3)
    vector.fail(IssueCode::array_length_not_in_list,
                std::to_string(vector.size()) + " instead of 3");
  Eigen::Vector3d values;
  for (int k = 0; k < 3; ++k) {
    const JsonCursor number = vector.element(static_cast<std::uint64_t>(k));
    if (!number.value().is_number())
      vector.fail(IssueCode::array_type_mismatch, "element " + std::to_string(k));
    values[k] = number.number();
    if (!std::isfinite(static_cast<float>(values[k])))
      number.fail(IssueCode::value_not_in_range, "beyond float's range");
  }
  return values;
}

Eigen::Vector3d read_vector(const JsonCursor& vector, const Eigen::Vector3d& otherwise) {
  return vector.exists() ? read_vector(vector) : otherwise;
}

Eigen::Vector3f read_corner(const JsonCursor& corner) {
  return read_vector(corner).cast<float>();
}

void read_bounds(const JsonCursor& bounds, ProgressiveAsset& asset) {
  asset.bounds_min = read_corner(bounds.member("min"));
  asset.bounds_max = read_corner(bounds.member("max"));
  if ((asset.bounds_min.array() > asset.bounds_max.array()).any())
    bounds.fail(IssueCode::value_not_in_range, "min is greater than max");
}

void check_attributes(const JsonCursor& attributes) {
  if (!attributes.exists()) return;
  if (attributes.size() != 1 || attributes.element(0).value() != "POSITION")
    attributes.fail(IssueCode::attributes_unsupported, attributes.value().dump());
}

void read_prefixes(const JsonCursor& prefixes, ProgressiveAsset& asset) {
  for (std::size_t i = 0; i < prefixes.size(); ++i) {
    const JsonCursor place = prefixes.element(i);
    const PrefixEntry entry{place.member("byteLength").unsigned_integer(),
                            place.member("geometricError").number()};
    if (i > 0 && entry.byte_length <= asset.prefixes.back().byte_length)
      place.member("byteLength").fail(IssueCode::prefix_order, std::to_string(entry.byte_length));
    if (i > 0 && entry.geometric_error > asset.prefixes.back().geometric_error)
      place.member("geometricError").fail(IssueCode::prefix_order, "the error rises");
    asset.prefixes.push_back(entry);
  }
}

void read_payload(GltfDocument& document, const JsonCursor& index, ProgressiveAsset& asset) {
  const ViewBytes bytes = document.view_bytes(index);
  asset.payload_length = bytes.length;
  asset.payload.assign(bytes.available.begin(), bytes.available.end());
  const JsonCursor view = index.resolve(document.root().member("bufferViews"));
  if (view.member("target").exists() || view.member("byteStride").exists() ||
      packing_of(view).exists())
    view.fail(IssueCode::payload_view_invalid, "");
  const JsonCursor buffer = view.member("buffer").resolve(document.root().member("buffers"));
  const std::uint64_t end = view.member("byteOffset").unsigned_integer_or(0) + bytes.length;
  const std::uint64_t buffer_length = buffer.member("byteLength").unsigned_integer();
  if (end != buffer_length)
    view.fail(IssueCode::payload_not_last,
              std::to_string(buffer_length - end) + " bytes of the buffer follow it");
}

// The rounding of a division must not decide about the bits that the payload's hash covers.
void refuse_normalized(const GltfDocument& document, const JsonCursor& positions) {
  const JsonCursor accessor = positions.resolve(document.root().member("accessors"));
  const JsonCursor flag = accessor.member("normalized");
  if (flag.exists() && flag.value() != false)
    accessor.fail(IssueCode::accessor_unsupported, "positions must not be normalized");
}

// glTF-Validator's code, where attributes name their accessors.
void require_index(const JsonCursor& attribute) {
  const nlohmann::json& value = attribute.value();
  if (!value.is_number() || value.get<double>() < 0 ||
      value.get<double>() != std::floor(value.get<double>()))
    attribute.fail(IssueCode::invalid_index, "");
}

// Triangles of all primitives in their order; the primitives share one array of positions.
void read_base(GltfDocument& document, const JsonCursor& mesh, ProgressiveAsset& asset) {
  const JsonCursor primitives = primitives_of(mesh);
  const JsonCursor first = primitives.element(0).member("attributes");
  if (!first.value().is_object() || !first.value().contains("POSITION"))
    first.fail(IssueCode::base_unsupported, "there is no POSITION");
  require_index(first.member("POSITION"));
  refuse_normalized(document, first.member("POSITION"));
  asset.control_points = document.read_vectors(first.member("POSITION"));
  if (first.member("NORMAL").exists()) {
    require_index(first.member("NORMAL"));
    asset.normals = document.read_vectors(first.member("NORMAL"));
    if (asset.normals.size() != asset.control_points.size())
      first.member("NORMAL").fail(IssueCode::mesh_primitive_unequal_accessor_count,
                                  "its count is not POSITION's");
  }
  if (asset.control_points.size() >= bitstream::kNone)
    first.member("POSITION").fail(IssueCode::base_unsupported, "it has too many vertices");
  asset.base.vertex_count = static_cast<std::uint32_t>(asset.control_points.size());
  const std::uint64_t positions = first.member("POSITION").index();
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const JsonCursor primitive = primitives.element(i);
    if (primitive.member("mode").unsigned_integer_or(kTriangles) != kTriangles)
      primitive.member("mode").fail(IssueCode::base_unsupported, "the mode is not TRIANGLES");
    const JsonCursor other = primitive.member("attributes").member("POSITION");
    if (other.exists()) require_index(other);
    if (!other.exists() || other.index() != positions)
      primitive.fail(IssueCode::base_unsupported, "its POSITION is not that of the first one");
    const JsonCursor place = primitive.member("indices");
    if (!place.exists()) primitive.fail(IssueCode::base_unsupported, "it has no indices");
    const std::vector<std::uint32_t> indices = document.read_indices(place);
    if (indices.size() % 3 != 0)
      place.fail(IssueCode::base_unsupported, "the number of indices is no multiple of 3");
    for (std::uint32_t index : indices)
      if (index >= asset.base.vertex_count)
        place.fail(IssueCode::accessor_index_oob, "vertex " + std::to_string(index) + " of " +
                                                      std::to_string(asset.base.vertex_count));
    // Many primitives may name the same few bytes.
    if (asset.base.triangles.size() + indices.size() / 3 > kMostBaseTriangles)
      place.fail(IssueCode::base_unsupported,
                 "the base has more than " + std::to_string(kMostBaseTriangles) + " triangles");
    for (std::size_t k = 0; k < indices.size(); k += 3)
      asset.base.triangles.push_back({indices[k], indices[k + 1], indices[k + 2]});
  }
}

// Nodes above it are left out.
Placement placement_by(const JsonCursor& node) {
  const Eigen::Vector3d scale = read_vector(node.member("scale"), Eigen::Vector3d::Ones());
  const bool is_uniform = scale.x() > 0 && scale == Eigen::Vector3d::Constant(scale.x());
  if (!is_uniform || node.member("rotation").exists() || node.member("matrix").exists()) return {};
  return {scale.x(), read_vector(node.member("translation"), Eigen::Vector3d::Zero())};
}

// As read_mesh; may name an issue twice, as the schema's and as that of a step.
std::optional<ProgressiveAsset> read_parts(GltfDocument& document, std::size_t mesh,
                                           Issues& issues) {
  ProgressiveAsset asset;
  const JsonCursor place = document.root().member("meshes").element(mesh);
  const JsonCursor extension = extension_of(place);
  if (!collect(issues, [&] { extension.member("levels"); })) return std::nullopt;
  // What follows relies on types and ranges only if the schema's rules are kept.
  Issues defects;
  checked_object(document.root(), extension, kExtensionType, defects);
  const bool keeps_schema = first_error(defects) == nullptr;
  issues.insert(issues.end(), defects.begin(), defects.end());
  bool decodes = keeps_schema;
  const auto step = [&](auto read) { decodes = collect(issues, read) && decodes; };
  if (keeps_schema) {
    asset.levels = static_cast<int>(extension.member("levels").unsigned_integer());
    asset.source_diagonal = extension.member("sourceDiagonal").number();
    step([&] { check_attributes(extension.member("attributes")); });
    step([&] { read_bounds(extension.member("bounds"), asset); });
    step([&] { read_prefixes(extension.member("prefixes"), asset); });
  }
  step([&] { read_payload(document, extension.member("bufferView"), asset); });
  step([&] { read_base(document, place, asset); });
  if (!decodes) return std::nullopt;
  collect(issues, [&] {
    if (place.member("name").exists()) asset.name = place.member("name").string();
    const JsonCursor generator = document.root().member("asset").member("generator");
    asset.generator = generator.exists() ? generator.string() : "";
  });
  if (asset.prefixes.back().byte_length != asset.payload_length)
    issues.push_back({IssueCode::prefix_end, extension.member("prefixes").pointer(),
                      std::to_string(asset.prefixes.back().byte_length) + " of " +
                          std::to_string(asset.payload_length) + " bytes"});
  if (asset.payload.size() < asset.payload_length)
    issues.push_back({IssueCode::payload_truncated, extension.member("bufferView").pointer(),
                      std::to_string(asset.payload.size()) + " of " +
                          std::to_string(asset.payload_length) + " bytes are there"});
  return asset;
}

}  // namespace

std::vector<std::size_t> progressive_meshes(const GltfDocument& document, Issues& issues) {
  const JsonCursor root = document.root();
  std::vector<std::size_t> found;
  collect(issues, [&] {
    const JsonCursor meshes = root.member("meshes");
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      const JsonCursor mesh = meshes.element(i);
      collect(issues, [&] {
        if (extension_of(mesh).exists()) found.push_back(i);
        const JsonCursor primitives = primitives_of(mesh);
        for (std::size_t k = 0; k < primitives.size(); ++k)
          check_misplaced(primitives.element(k), issues);
      });
    }
  });
  check_misplaced_everywhere(root, issues);
  collect(issues, [&] {
    if (lists_extension(root.member("extensionsUsed"))) return;
    for (std::size_t mesh : found)
      issues.push_back({IssueCode::undeclared_extension,
                        extension_of(root.member("meshes").element(mesh)).pointer(), ""});
  });
  collect(issues, [&] {
    const JsonCursor required = root.member("extensionsRequired");
    if (lists_extension(required)) required.fail(IssueCode::extension_required, "");
  });
  return found;
}

std::optional<ProgressiveAsset> read_mesh(GltfDocument& document, std::size_t mesh,
                                          Issues& issues) {
  Issues found;
  std::optional<ProgressiveAsset> asset = read_parts(document, mesh, found);
  remove_repeated(found);
  std::move(found.begin(), found.end(), std::back_inserter(issues));
  return asset;
}

std::vector<Placement> mesh_placements(const GltfDocument& document) {
  std::vector<std::optional<Placement>> placements(document.root().member("meshes").size());
  const JsonCursor nodes = document.root().member("nodes");
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const JsonCursor node = nodes.element(i);
    if (!node.member("mesh").exists()) continue;
    const std::uint64_t mesh = node.member("mesh").index();
    if (mesh < placements.size() && !placements[mesh]) placements[mesh] = placement_by(node);
  }
  std::vector<Placement> result;
  for (const std::optional<Placement>& placement : placements)
    result.push_back(placement.value_or(Placement{}));
  return result;
}

ProgressiveAsset read_progressive(const std::filesystem::path& path) {
  const auto fail = [&](const Issue& issue) {
    const std::string pointer = issue.pointer.empty() ? "" : issue.pointer + ": ";
    throw Error(ExitCode::unreadable_input, path.string() + ": " + pointer + issue_message(issue));
  };
  Issues issues;
  std::optional<ProgressiveAsset> asset;
  if (!collect(issues, [&] {
        GltfDocument document(path, read_file(path));
        const std::vector<std::size_t> meshes = progressive_meshes(document, issues);
        if (meshes.empty()) throw IssueFound({IssueCode::extension_absent, "", ""});
        if (meshes.size() > 1)
          throw Error(ExitCode::unreadable_input,
                      path.string() + ": /meshes: " + std::to_string(meshes.size()) +
                          " meshes are progressive: split the file, one mesh can be read");
        asset = read_mesh(document, meshes.front(), issues);
        if (asset) asset->placement = mesh_placements(document)[meshes.front()];
      }))
    fail(issues.back());
  // A payload that is cut off decodes like any prefix; everything else would decode wrongly.
  for (const Issue& issue : issues)
    if (is_error(issue) && issue.code != IssueCode::payload_truncated) fail(issue);
  if (!asset) fail(issues.back());
  return *asset;
}

}  // namespace zerotree::gltf
