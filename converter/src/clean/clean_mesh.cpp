#include "clean/clean_mesh.h"

#include <numeric>

#include "clean/face_pairing.h"
#include "clean/half_edges.h"
#include "clean/index_repairs.h"
#include "clean/manifold_check.h"
#include "clean/vertex_fans.h"
#include "clean/zero_area.h"
#include "mesh/error.h"

namespace zerotree::clean {
namespace {

WorkingMesh copy_of(const TriangleMesh& input) {
  WorkingMesh mesh{input.positions, input.triangles, {}, {}};
  mesh.source_vertex.resize(input.positions.size());
  std::iota(mesh.source_vertex.begin(), mesh.source_vertex.end(), 0u);
  mesh.source_face.resize(input.triangles.size());
  std::iota(mesh.source_face.begin(), mesh.source_face.end(), 0u);
  return mesh;
}

void refuse_if_empty(const WorkingMesh& mesh, const TriangleMesh& input) {
  if (!mesh.triangles.empty()) return;
  std::string message =
      "no surface is left: all " + std::to_string(input.triangles.size()) + " faces have no area";
  if (!input.triangles.empty())
    message += ", the first at vertex " + std::to_string(input.triangles.front().front());
  throw Error(ExitCode::refused_topology, message + "; export the mesh again");
}

void repair_indices(WorkingMesh& mesh, CleanReport& report) {
  const std::uint64_t unreferenced = drop_unreferenced_vertices(mesh);
  report.welded_vertices = weld_equal_positions(mesh);
  report.degenerate_faces = drop_degenerate_faces(mesh);
  std::vector<std::uint8_t> folded;
  report.duplicate_faces = drop_duplicate_faces(mesh, folded);
  report.folded_faces = drop_folded_faces(mesh, folded);
  const std::uint64_t dropped = drop_unreferenced_vertices(mesh);
  // Of the second, those that welding took the name from are counted there.
  report.unreferenced_vertices = unreferenced + dropped - report.welded_vertices;
}

void separate_sheets(WorkingMesh& mesh, FacePairing& pairing, CleanReport& report) {
  report.non_manifold_edges = pairing.non_manifold_edges;
  const OrientationCounts turned = orient_faces(mesh, pairing.forest, pairing.mates);
  report.turned_faces = turned.turned_faces;
  report.turned_components = turned.turned_components;
  report.split_vertices = split_vertex_fans(mesh, pairing.mates);
  // Where no edge had more than two faces, all its faces are mates.
  if (pairing.non_manifold_edges > 0)
    report.divided_edges = divide_shared_edges(mesh, pairing.mates);
}

void repair_areas(WorkingMesh& mesh, std::vector<std::uint32_t> mates, const CleanOptions& options,
                  CleanReport& report) {
  const ZeroAreaCounts counts = repair_zero_area(mesh, std::move(mates), options);
  report.flipped_edges = counts.flipped_edges;
  report.removed_zero_area_faces = counts.removed_faces;
  report.nudged_vertices = counts.nudged_vertices;
  if (counts.removed_faces == 0) return;
  report.split_vertices +=
      split_vertex_fans(mesh, find_mates(mesh.triangles, mesh.positions.size()));
  report.unreferenced_vertices += drop_unreferenced_vertices(mesh);
}

void describe_surface(SurfaceTopology topology, CleanMesh& clean) {
  clean.face_component = std::move(topology.face_component);
  clean.component_count = topology.component_count;
  clean.report.components = topology.component_count;
  clean.report.boundary_loops = topology.boundary_loops;
  clean.report.boundary_edges = topology.boundary_edges;
  clean.report.euler_characteristic = topology.euler_characteristic;
  clean.report.genus = topology.genus;
}

}  // namespace

CleanMesh clean_mesh(const TriangleMesh& input, const CleanOptions& options,
                     const Progress& progress) {
  CleanMesh clean;
  report_progress(progress, "cleaning", 0.0);
  check_input(input);
  WorkingMesh mesh = copy_of(input);
  repair_indices(mesh, clean.report);
  refuse_if_empty(mesh, input);
  report_progress(progress, "cleaning", 0.3);
  FacePairing pairing = pair_faces(mesh);
  separate_sheets(mesh, pairing, clean.report);
  report_progress(progress, "cleaning", 0.6);
  repair_areas(mesh, std::move(pairing.mates), options, clean.report);
  refuse_if_empty(mesh, input);
  report_progress(progress, "cleaning", 0.8);

  clean.mesh = {std::move(mesh.positions), std::move(mesh.triangles)};
  clean.source_vertex = std::move(mesh.source_vertex);
  SurfaceInspection inspection = inspect_surface(clean.mesh);
  if (!inspection.problem.empty())
    throw Error(ExitCode::internal, "cleaning left a surface that is no manifold: " +
                                        inspection.problem + "; please report this file");
  describe_surface(std::move(inspection.topology), clean);
  report_progress(progress, "cleaning", 1.0);
  return clean;
}

std::vector<std::pair<std::string, std::uint64_t>> list_repairs(const CleanReport& report) {
  std::vector<std::pair<std::string, std::uint64_t>> all = {
      {"vertices welded to another at the same place", report.welded_vertices},
      {"faces with a repeated vertex dropped", report.degenerate_faces},
      {"duplicate faces dropped", report.duplicate_faces},
      {"flat folds dropped", report.folded_faces},
      {"edges of more than two faces separated", report.non_manifold_edges},
      {"faces turned to agree with their neighbours", report.turned_faces},
      {"closed components turned inside out", report.turned_components},
      {"vertices added where several fans met", report.split_vertices},
      {"edges divided where a surface touches itself", report.divided_edges},
      {"edges flipped to remove faces of no area", report.flipped_edges},
      {"faces of no area removed", report.removed_zero_area_faces},
      {"vertices moved to give a face an area", report.nudged_vertices},
      {"unreferenced vertices dropped", report.unreferenced_vertices}};
  std::erase_if(all, [](const auto& repair) { return repair.second == 0; });
  return all;
}

}  // namespace zerotree::clean
