#include "report/convert_report.h"

#include <nlohmann/json.hpp>

namespace zerotree::report {
namespace {

nlohmann::ordered_json prefixes_json(const std::vector<PrefixError>& prefixes) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const PrefixError& prefix : prefixes)
    list.push_back({{"bytes", prefix.bytes},
                    {"bitsPerVertex", prefix.bits_per_vertex},
                    {"error", prefix.error},
                    {"hausdorff", prefix.hausdorff}});
  return list;
}

nlohmann::ordered_json repairs_json(const std::vector<Repair>& repairs) {
  nlohmann::ordered_json list = nlohmann::ordered_json::object();
  for (const Repair& repair : repairs) list[repair.what] = repair.count;
  return list;
}

nlohmann::ordered_json stages_json(const std::vector<StageCost>& stages) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const StageCost& stage : stages)
    list.push_back(
        {{"name", stage.name}, {"seconds", stage.seconds}, {"peakMemoryBytes", stage.peak_memory}});
  return list;
}

nlohmann::ordered_json levels_to_json(const std::vector<LevelDetails>& levels) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const LevelDetails& level : levels)
    json.push_back(
        {{"level", json.size() + 1}, {"normal", level.normal}, {"tangential", level.tangential}});
  return json;
}

nlohmann::ordered_json transform_json(const std::string& name, const TransformErrors& errors,
                                      const std::string& note) {
  nlohmann::ordered_json json{{"name", name}};
  if (errors.local > 0) json["meanErrors"] = {{"local", errors.local}, {"mirror", errors.mirror}};
  if (!note.empty()) json["note"] = note;
  return json;
}

nlohmann::ordered_json stream_json(std::uint64_t bytes, const std::vector<PrefixError>& prefixes,
                                   const ReachedTargets& targets) {
  nlohmann::ordered_json json{{"bytes", bytes}, {"prefixes", prefixes_json(prefixes)}};
  if (bytes == 0) return json;
  nlohmann::ordered_json asked = nlohmann::ordered_json::object();
  if (targets.max_error > 0) asked["maxError"] = targets.max_error;
  if (targets.size > 0) asked["size"] = targets.size;
  json["targets"] = {{"asked", std::move(asked)},
                     {"error", targets.reached_error},
                     {"size", targets.reached_size},
                     {"finestStep", targets.finest_step},
                     {"wholeStream", targets.is_whole_stream}};
  return json;
}

}  // namespace

nlohmann::ordered_json to_json(const ConvertReport& r) {
  return {{"input",
           {{"file", r.input},
            {"format", r.format},
            {"vertices", r.input_vertices},
            {"faces", r.input_faces},
            {"diagonal", r.diagonal},
            {"notCarried", r.not_carried}}},
          {"clean",
           {{"repairs", repairs_json(r.repairs)},
            {"vertices", r.clean_vertices},
            {"faces", r.clean_faces},
            {"components", r.components},
            {"boundaryLoops", r.boundary_loops},
            {"genus", r.genus}}},
          {"holes",
           {{"filled", r.filled_rims.size()},
            {"facesAdded", r.filling_faces},
            {"filledRims", r.filled_rims},
            {"leftRims", r.left_rims}}},
          {"handles",
           {{"removed", r.handle_loops.size()},
            {"genusBefore",
             r.handle_loops.empty() ? static_cast<std::uint64_t>(r.genus) : r.genus_before},
            {"genusAfter", r.genus},
            {"loops", r.handle_loops}}},
          {"base",
           {{"vertices", r.base_vertices},
            {"faces", r.base_faces},
            {"creaseEdges", r.crease_edges},
            {"corners", r.corners}}},
          {"remesh",
           {{"levels", r.levels},
            {"finestVertices", r.finest_vertices},
            {"coneSwaps", r.cone_swaps},
            {"error", r.remeshing_error},
            {"rejectedMoves", r.rejected_moves},
            {"negativeTriangles", r.negative_triangles},
            {"turnedFaces", r.turned_faces},
            {"pinnedLimbs", r.pinned_limbs},
            {"levelDetails", levels_to_json(r.level_details)},
            {"discretisationError", r.discretisation_error},
            {"remark", r.remesh_remark}}},
          {"transform", transform_json(r.transform, r.transform_errors, r.transform_note)},
          {"payload", stream_json(r.payload_bytes, r.payload_prefixes, r.payload_targets)},
          {"stream", stream_json(r.stream_bytes, r.stream_prefixes, r.stream_targets)},
          {"file", {{"bytes", r.file_bytes}}},
          {"stages", stages_json(r.stages)}};
}

}  // namespace zerotree::report
