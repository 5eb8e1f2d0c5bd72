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
  glb_malformed,
  glb_truncated,
  json_invalid,
  gltf_version_unsupported,
  extension_absent,
  extension_not_listed,
  extension_required,
  extension_misplaced,
  property_missing,
  property_type,
  property_value,
  property_unknown,
  index_unresolved,
  prefix_order,
  prefix_end,
  buffer_unreadable,
  buffer_too_short,
  view_out_of_buffer,
  accessor_out_of_view,
  accessor_unsupported,
  packing_broken,
  base_unsupported,
  base_value_not_finite,
  base_index_out_of_range,
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

/// One row of the table.
struct IssueText {
  IssueCode code;
  /// The identifier that reports print.
  const char* id;
  Severity severity;
  /// What is wrong, without the particulars.
  const char* text;
  const char* what_to_do;
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

/// "text: detail (what to do)".
std::string issue_message(const Issue& issue);
bool is_error(const Issue& issue);
/// The first error in `issues`, nullptr if there is none.
const Issue* first_error(const Issues& issues);

}  // namespace zerotree::gltf
