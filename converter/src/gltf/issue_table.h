// Everything that can be wrong with a progressive glTF file, as one table of messages.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace zerotree::gltf {

/// As glTF-Validator numbers them.
enum class Severity { error = 0, warning = 1, information = 2, hint = 3 };

enum class IssueCode {
  file_format_unknown,
  glb_invalid_version,
  glb_unexpected_end_of_chunk_data,
  invalid_json,
  unknown_asset_major_version,
  extension_absent,
  undeclared_extension,
  extension_required,
  extension_misplaced,
  undefined_property,
  type_mismatch,
  value_not_in_range,
  unexpected_property,
  unresolved_reference,
  array_length_not_in_list,
  array_type_mismatch,
  duplicate_elements,
  empty_entity,
  invalid_index,
  invalid_uri,
  pattern_mismatch,
  unsatisfied_dependency,
  value_multiple_of,
  value_not_in_list,
  json_key_repeated,
  attributes_unsupported,
  unknown_asset_minor_version,
  glb_length_too_small,
  glb_length_mismatch,
  glb_extra_data,
  glb_unexpected_end_of_header,
  glb_unexpected_end_of_chunk_header,
  glb_chunk_length_unaligned,
  glb_chunk_too_big,
  glb_unexpected_first_chunk,
  glb_unexpected_bin_chunk,
  glb_empty_chunk,
  glb_duplicate_chunk,
  glb_unknown_chunk_type,
  unused_extension_required,
  non_required_extension,
  scene_non_root_node,
  node_loop,
  node_parent_override,
  node_matrix_trs,
  rotation_non_unit,
  buffer_missing_glb_data,
  buffer_byte_length_mismatch,
  buffer_glb_chunk_too_big,
  buffer_view_too_big_byte_stride,
  buffer_view_invalid_byte_stride,
  buffer_view_target_override,
  accessor_offset_alignment,
  accessor_total_offset_alignment,
  accessor_small_bytestride,
  accessor_normalized_invalid,
  accessor_usage_override,
  invalid_gl_value,
  accessor_min_mismatch,
  accessor_max_mismatch,
  accessor_element_out_of_min_bound,
  accessor_element_out_of_max_bound,
  accessor_index_primitive_restart,
  accessor_vector3_non_unit,
  accessor_data_unchecked,
  mesh_primitive_invalid_attribute,
  mesh_primitive_no_position,
  mesh_primitive_incompatible_mode,
  mesh_primitive_position_accessor_without_bounds,
  mesh_primitive_attributes_accessor_invalid_format,
  mesh_primitive_attributes_accessor_unsigned_int,
  mesh_primitive_accessor_unaligned,
  mesh_primitive_accessor_without_bytestride,
  mesh_primitive_unequal_accessor_count,
  mesh_primitive_indices_accessor_invalid_format,
  mesh_primitive_indices_accessor_with_bytestride,
  prefix_order,
  prefix_end,
  io_error,
  buffer_too_short,
  buffer_view_too_long,
  accessor_too_long,
  accessor_unsupported,
  packing_broken,
  base_unsupported,
  accessor_invalid_float,
  accessor_index_oob,
  payload_view_invalid,
  payload_not_last,
  payload_truncated,
  payload_broken,
  payload_base_mismatch,
  payload_levels_mismatch,
  payload_incomplete,
  payload_too_large,
  surface_not_finite,
  surface_out_of_bounds,
  prefix_out_of_bounds,
  bounds_loose,
  source_diagonal_implausible,
  payload_trailing_bytes,
  prefix_beyond_stream,
  prefixes_sampled,
  base_seam,
  surface_seam_open,
  surface_cracked,
  source_not_measured,
  source_diagonal_mismatch,
  prefix_error_understated,
  prefix_error_overstated,
  budget_bytes,
  budget_error,
  budget_triangles,
  budget_error_unknown,
};

/// Who named a code.
enum class Origin { zerotree, gltf_validator };

/// One row of the table.
struct IssueText {
  IssueCode code;
  /// The identifier that reports print.
  const char* id;
  Severity severity;
  /// What is wrong, without the particulars.
  const char* text;
  const char* what_to_do;
  /// Of glTF-Validator: the code means the same there, and has the same pointer and severity.
  Origin origin = Origin::zerotree;
};

/// All rows, in the order of IssueCode.
std::span<const IssueText> issue_table();
const IssueText& issue_text(IssueCode code);

/// One thing found in a file.
struct Issue {
  IssueCode code;
  /// JSON pointer to the place; empty if the file as a whole is meant.
  std::string pointer;
  /// The particulars: names, values, limits.
  std::string detail;
};

using Issues = std::vector<Issue>;

/// Removes each issue whose code and pointer an earlier one has.
void remove_repeated(Issues& issues);

/// "text: detail (what to do)".
std::string issue_message(const Issue& issue);
bool is_error(const Issue& issue);
/// The first error in `issues`, nullptr if there is none.
const Issue* first_error(const Issues& issues);

}  // namespace zerotree::gltf
