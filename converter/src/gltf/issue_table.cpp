#include "gltf/issue_table.h"

#include <array>

namespace zerotree::gltf {
namespace {

using enum Severity;
using enum IssueCode;

// clang-format off
constexpr std::array kTable = {
    IssueText{file_format_unknown, "FILE_FORMAT_UNKNOWN", error,
              "The file is neither GLB nor glTF JSON nor a zerotree stream",
              "name a .glb, .gltf or .zt file"},
    IssueText{glb_malformed, "GLB_MALFORMED", error,
              "The GLB container is malformed",
              "write the file again"},
    IssueText{glb_truncated, "GLB_TRUNCATED", error,
              "The GLB file is cut off",
              "fetch the rest of the file"},
    IssueText{json_invalid, "JSON_INVALID", error,
              "The glTF JSON cannot be parsed",
              "write the file again"},
    IssueText{gltf_version_unsupported, "GLTF_VERSION_UNSUPPORTED", error,
              "Only glTF 2 is supported",
              "convert the file to glTF 2.0"},
    IssueText{extension_absent, "EXTENSION_ABSENT", information,
              "No mesh has the extension ZEROTREE_mesh_progressive",
              "make a progressive file with `zerotree convert`"},
    IssueText{extension_not_listed, "EXTENSION_NOT_LISTED", error,
              "The extension is used but not listed in extensionsUsed",
              "add ZEROTREE_mesh_progressive to extensionsUsed"},
    IssueText{extension_required, "EXTENSION_REQUIRED", error,
              "The extension must not be required: its base mesh shows everywhere",
              "remove ZEROTREE_mesh_progressive from extensionsRequired"},
    IssueText{extension_misplaced, "EXTENSION_MISPLACED", error,
              "The extension sits where it has no meaning",
              "move it to the mesh object"},
    IssueText{property_missing, "PROPERTY_MISSING", error,
              "A required property is missing",
              "add it"},
    IssueText{property_type, "PROPERTY_TYPE", error,
              "A property has the wrong type",
              "write it as the schema says"},
    IssueText{property_value, "PROPERTY_VALUE", error,
              "A property has a value out of its range",
              "write it as the schema says"},
    IssueText{property_unknown, "PROPERTY_UNKNOWN", warning,
              "The extension object has a property that the specification does not know",
              "remove it or put it into extras"},
    IssueText{index_unresolved, "INDEX_UNRESOLVED", error,
              "An index names an object that does not exist",
              "name an existing one"},
    IssueText{prefix_order, "PREFIX_ORDER", error,
              "The prefixes table must ascend in bytes and never rise in error",
              "sort it and state the largest error of the same or any longer prefix"},
    IssueText{prefix_end, "PREFIX_END", error,
              "The last entry of the prefixes table must be the whole payload",
              "end the table with the byteLength of the payload's bufferView"},
    IssueText{buffer_unreadable, "BUFFER_UNREADABLE", error,
              "The data of a buffer cannot be read",
              "put the file its uri names beside the glTF file"},
    IssueText{buffer_too_short, "BUFFER_TOO_SHORT", error,
              "A buffer ends before the base mesh is complete",
              "fetch the rest of it"},
    IssueText{view_out_of_buffer, "VIEW_OUT_OF_BUFFER", error,
              "A bufferView reaches beyond its buffer",
              "correct byteOffset and byteLength"},
    IssueText{accessor_out_of_view, "ACCESSOR_OUT_OF_VIEW", error,
              "An accessor reaches beyond its bufferView",
              "correct byteOffset and count"},
    IssueText{accessor_unsupported, "ACCESSOR_UNSUPPORTED", error,
              "An accessor of the base mesh has a form the extension does not allow",
              "use VEC3 attributes of floats, or of integers with KHR_mesh_quantization, and "
              "unsigned scalar indices, not sparse"},
    IssueText{packing_broken, "PACKING_BROKEN", error,
              "The data of a bufferView under EXT_meshopt_compression does not decode",
              "write the file again"},
    IssueText{base_unsupported, "BASE_UNSUPPORTED", error,
              "The primitives cannot be a base mesh",
              "use indexed triangles that share one POSITION accessor"},
    IssueText{base_value_not_finite, "BASE_VALUE_NOT_FINITE", error,
              "The base mesh has a value that is not finite",
              "write the file again"},
    IssueText{base_index_out_of_range, "BASE_INDEX_OUT_OF_RANGE", error,
              "A triangle of the base mesh names a vertex that does not exist",
              "write the file again"},
    IssueText{payload_view_invalid, "PAYLOAD_VIEW_INVALID", error,
              "The payload's bufferView must have no target, no byteStride and no compression",
              "remove them"},
    IssueText{payload_not_last, "PAYLOAD_NOT_LAST", error,
              "The payload must be the last bytes of its buffer",
              "move it behind all other data"},
    IssueText{payload_truncated, "PAYLOAD_TRUNCATED", error,
              "The payload is shorter than its bufferView",
              "fetch the rest of it; what is there decodes"},
    IssueText{payload_broken, "PAYLOAD_BROKEN", error,
              "The payload does not decode",
              "write the file again"},
    IssueText{payload_base_mismatch, "PAYLOAD_BASE_MISMATCH", error,
              "The payload belongs to another base mesh",
              "keep the base mesh's positions and indices as the encoder wrote them"},
    IssueText{payload_levels_mismatch, "PAYLOAD_LEVELS_MISMATCH", error,
              "The extension and the payload state different levels",
              "write the payload's value"},
    IssueText{payload_incomplete, "PAYLOAD_INCOMPLETE", information,
              "The stream ends before its last coded pass",
              "nothing, if it was cut to a size on purpose"},
    IssueText{payload_too_large, "PAYLOAD_TOO_LARGE", error,
              "The finest surface is larger than this validator may decode",
              "raise the limit to validate it"},
    IssueText{surface_not_finite, "SURFACE_NOT_FINITE", error,
              "A prefix decodes to a position that is not finite",
              "write the file again"},
    IssueText{surface_out_of_bounds, "SURFACE_OUT_OF_BOUNDS", error,
              "A prefix decodes to a surface outside the stated bounds",
              "state bounds over the surfaces of all prefixes"},
    IssueText{prefix_out_of_bounds, "PREFIX_OUT_OF_BOUNDS", warning,
              "A prefix that is no entry of the table decodes to a surface outside the stated "
              "bounds",
              "widen the bounds by half a percent of sourceDiagonal"},
    IssueText{bounds_loose, "BOUNDS_LOOSE", warning,
              "The bounds are much larger than the surfaces of all prefixes decoded",
              "state bounds over these surfaces with a margin of half a percent of sourceDiagonal"},
    IssueText{source_diagonal_implausible, "SOURCE_DIAGONAL_IMPLAUSIBLE", warning,
              "sourceDiagonal does not fit the size of the base mesh",
              "state the bounding box diagonal of the mesh that was encoded, in the mesh's unit"},
    IssueText{payload_trailing_bytes, "PAYLOAD_TRAILING_BYTES", warning,
              "Bytes follow the end of the stream, which decoders ignore",
              "cut the payload where the stream ends"},
    IssueText{prefix_beyond_stream, "PREFIX_BEYOND_STREAM", warning,
              "An entry of the prefixes table lies beyond the end of the stream",
              "end the table with the end of the stream"},
    IssueText{prefixes_sampled, "PREFIXES_SAMPLED", information,
              "Not every entry of the prefixes table was decoded",
              "shorten the table: a few entries say all that is needed"},
    IssueText{base_seam, "BASE_SEAM", hint,
              "Boundary edges of the base mesh lie on each other with vertices of their own",
              "join the vertices if the surface is to be smooth there"},
    IssueText{surface_seam_open, "SURFACE_SEAM_OPEN", warning,
              "Boundary edges lie on each other in the base mesh and come apart in the surface of "
              "a prefix",
              "join the vertices before encoding if no gap is meant"},
    IssueText{surface_cracked, "SURFACE_CRACKED", error,
              "The surface of a prefix cracks between two primitives",
              "let the primitives share the vertices of their common edges and encode again"},
    IssueText{source_not_measured, "SOURCE_NOT_MEASURED", information,
              "The file was not measured against its source",
              "correct the errors first"},
    IssueText{source_diagonal_mismatch, "SOURCE_DIAGONAL_MISMATCH", error,
              "sourceDiagonal is not the diagonal of the source's bounding box",
              "state that of the mesh that was encoded; check that this is the right source"},
    IssueText{prefix_error_understated, "PREFIX_ERROR_UNDERSTATED", error,
              "A prefix is farther from the source than its entry states",
              "measure again and state the larger error; check that this is the right source"},
    IssueText{prefix_error_overstated, "PREFIX_ERROR_OVERSTATED", warning,
              "A prefix and all later ones are much closer to the source than their entry states",
              "measure again and state the smaller error"},
    IssueText{budget_bytes, "BUDGET_BYTES", error,
              "The file and those it names are larger than allowed",
              "convert with a smaller --target-size, or raise --max-bytes"},
    IssueText{budget_error, "BUDGET_ERROR", error,
              "The whole payload has a larger error than allowed",
              "convert with a smaller --max-error, or raise --max-error here"},
    IssueText{budget_triangles, "BUDGET_TRIANGLES", error,
              "The finest surfaces have more triangles than allowed",
              "convert with fewer --levels, or raise --max-triangles"},
    IssueText{budget_error_unknown, "BUDGET_ERROR_UNKNOWN", error,
              "No table states an error that could be compared with the one allowed",
              "check the glTF file instead, which has a table"},
};
// clang-format on

constexpr bool is_in_order() {
  for (std::size_t i = 0; i < kTable.size(); ++i)
    if (static_cast<std::size_t>(kTable[i].code) != i) return false;
  return true;
}
static_assert(is_in_order() && kTable.back().code == budget_error_unknown);

}  // namespace

std::span<const IssueText> issue_table() {
  return kTable;
}

const IssueText& issue_text(IssueCode code) {
  return kTable[static_cast<std::size_t>(code)];
}

std::string issue_message(const Issue& issue) {
  const IssueText& row = issue_text(issue.code);
  std::string message = row.text;
  if (!issue.detail.empty()) message.append(": ").append(issue.detail);
  return message.append(" (").append(row.what_to_do).append(")");
}

bool is_error(const Issue& issue) {
  return issue_text(issue.code).severity == Severity::error;
}

const Issue* first_error(const Issues& issues) {
  for (const Issue& issue : issues)
    if (is_error(issue)) return &issue;
  return nullptr;
}

}  // namespace zerotree::gltf
