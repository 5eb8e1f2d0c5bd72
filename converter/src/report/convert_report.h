// The JSON report of a conversion: everything a script needs to judge it.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace zerotree::report {

/// Time and memory of one stage.
struct StageCost {
  std::string name;
  double seconds = 0;
  /// Highest resident memory of the process while the stage ran, in bytes.
  std::uint64_t peak_memory = 0;
};

/// A prefix of the stream and the measured distance of its surface from the input.
struct PrefixError {
  std::uint64_t bytes = 0;
  double bits_per_vertex = 0;
  /// Symmetric RMS distance relative to the input's bounding box diagonal.
  double error = 0;
  /// Symmetric Hausdorff distance relative to the same.
  double hausdorff = 0;
};

/// One repair of the clean stage; listed only if its count is not zero.
struct Repair {
  std::string what;
  std::uint64_t count = 0;
};

/// What the details of one level add to the surface: root mean squares relative to the diagonal.
struct LevelDetails {
  double normal = 0;
  double tangential = 0;
};

/// What a stream was asked to meet and what it reached.
struct ReachedTargets {
  /// Relative to the diagonal; 0: none was asked for.
  double max_error = 0;
  /// In bytes of what is written; 0: none was asked for.
  std::uint64_t size = 0;
  /// Of the stream as it was cut, relative to the diagonal.
  double reached_error = 0;
  /// Of what is written: the .zt file, the .glb file, or with --split all files together.
  std::uint64_t reached_size = 0;
  /// Finest quantisation step, relative to the diagonal.
  double finest_step = 0;
  /// Nothing was cut off.
  bool is_whole_stream = true;
};

/// Geometric means of the errors of both wavelet transforms over the rates of the prefixes table,
/// relative to the diagonal; both 0 if only one was tried.
struct TransformErrors {
  double local = 0;
  double mirror = 0;
};

/// Results of a conversion. Lengths are in the input's unit unless they are called relative.
struct ConvertReport {
  std::string input;
  std::string format;
  std::uint64_t input_vertices = 0;
  std::uint64_t input_faces = 0;
  double diagonal = 0;
  std::vector<std::string> not_carried;

  std::vector<Repair> repairs;
  std::uint64_t clean_vertices = 0;
  std::uint64_t clean_faces = 0;
  std::uint64_t components = 0;
  std::uint64_t boundary_loops = 0;
  std::int64_t genus = 0;

  /// Rims of the boundary loops that were filled on request and of those that are left then,
  /// relative to the diagonal; both empty if nothing was asked for.
  std::vector<double> filled_rims;
  std::vector<double> left_rims;
  std::uint64_t filling_faces = 0;
  /// Lengths of the loops along which handles were cut on request, relative to the diagonal, and
  /// the genus before that; `genus` is what is left.
  std::vector<double> handle_loops;
  std::uint64_t genus_before = 0;

  std::uint64_t base_vertices = 0;
  std::uint64_t base_faces = 0;
  std::uint64_t crease_edges = 0;
  std::uint64_t corners = 0;
  int levels = 0;
  std::uint64_t finest_vertices = 0;
  std::uint64_t cone_swaps = 0;
  /// Symmetric RMS distance of the surface with every detail unquantised, relative.
  double remeshing_error = 0;
  /// RMS distance of the input from a smooth surface through its vertices, relative: what its
  /// density can show.
  double discretisation_error = 0;
  /// Why the remeshing error is far above that; empty if it is not.
  std::string remesh_remark;

  /// Moves of the relaxation that would have turned a triangle over and were taken back.
  std::uint64_t rejected_moves = 0;
  /// Triangles of the finest level that are turned over in the parameter domain.
  std::uint64_t negative_triangles = 0;
  /// Finest faces whose normal opposes the input's at their point.
  std::uint64_t turned_faces = 0;
  /// Vertices kept in the base because a limb would have been squeezed without them.
  std::uint64_t pinned_limbs = 0;
  /// Of the details that lead to level 1, 2, ...
  std::vector<LevelDetails> level_details;

  /// The wavelet transform: local or mirror.
  std::string transform;
  /// Why both transforms could not be compared; empty if they were or need not be.
  std::string transform_note;
  TransformErrors transform_errors;
  /// Of the glTF file's payload and of the elementary stream; as made if that was not written.
  ReachedTargets payload_targets, stream_targets;
  std::uint64_t stream_bytes = 0;
  std::uint64_t payload_bytes = 0;
  std::uint64_t file_bytes = 0;
  /// Prefixes of the payload bound to the base mesh in the glTF file.
  std::vector<PrefixError> payload_prefixes;
  /// Prefixes of the elementary stream; empty if none was written.
  std::vector<PrefixError> stream_prefixes;

  std::vector<StageCost> stages;
};

/// The report as JSON: camelCase keys, grouped by stage; extension-spec does not depend on it.
nlohmann::ordered_json to_json(const ConvertReport& report);

}  // namespace zerotree::report
