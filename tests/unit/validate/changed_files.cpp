#include "changed_files.h"

#include "encoded_assets.h"
#include "export/atomic_file.h"
#include "gltf/glb_container.h"
#include "gltf/progressive_writer.h"
#include "sample_assets.h"

namespace zerotree::test {

using nlohmann::json;

std::vector<std::uint8_t> with_json(const gltf::ProgressiveAsset& asset,
                                    const std::function<void(json&)>& change) {
  const auto whole = gltf::glb_bytes(asset);
  const gltf::GlbChunks chunks = gltf::split_glb(whole);
  json root = json::parse(chunks.json);
  change(root);
  std::vector<std::uint8_t> bytes = gltf::glb_head(root.dump(), chunks.binary.size());
  bytes.insert(bytes.end(), chunks.binary.begin(), chunks.binary.end());
  return bytes;
}

std::vector<std::uint8_t> with_json(const std::function<void(json&)>& change) {
  return with_json(encoded_asset(base_shapes()[0]), change);
}

json& extension(json& root) {
  return root["meshes"][0]["extensions"][gltf::kExtensionName];
}

std::vector<std::string> codes(const validate::ValidationReport& report) {
  std::vector<std::string> ids;
  for (const gltf::Issue& issue : report.issues) ids.push_back(gltf::issue_text(issue.code).id);
  return ids;
}

gltf::Issue issue_with(const validate::ValidationReport& report, const std::string& code) {
  for (const gltf::Issue& issue : report.issues)
    if (gltf::issue_text(issue.code).id == code) return issue;
  return {};
}

validate::ValidationReport validate_bytes(std::span<const std::uint8_t> bytes,
                                          const std::string& name,
                                          const validate::ValidateOptions& options) {
  const TemporaryFolder folder;
  exporter::write_file_atomically(folder / name, bytes);
  return validate::validate_file(folder / name, options);
}

}  // namespace zerotree::test
