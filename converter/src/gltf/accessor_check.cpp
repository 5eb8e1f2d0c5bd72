#include "gltf/accessor_check.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "gltf/accessor_values.h"
#include "gltf/packed_view.h"
#include "gltf/property_check.h"

namespace zerotree::gltf {
namespace {

using nlohmann::json;

constexpr std::uint64_t kElementArrayBuffer = 34963;
// Accessors of real files share few bytes; those of a hostile one may all name the whole buffer.
constexpr std::uint64_t kMostLooksPerByte = 16;
constexpr std::uint64_t kFreeBytes = 1 << 20;
// Packed bytes stand for at most as many times their number.
constexpr std::uint64_t kMostExpansion = 64;

// Columns of matrices begin at multiples of 4.
std::uint64_t element_bytes(std::string_view type, std::uint64_t component, std::size_t count) {
  if (component == 1 && type == "MAT2") return 6;
  if (component == 1 && type == "MAT3") return 11;
  if (component == 2 && type == "MAT3") return 22;
  return component * count;
}

std::uint64_t known(std::uint64_t value) {
  return value == kNoIndex ? 0 : value;
}

bool is_index(const JsonCursor& place) {
  if (!place.exists() || !place.value().is_number()) return false;
  const double number = place.value().get<double>();
  return number >= 0 && number == std::floor(number);
}

std::string bytes_text(std::uint64_t count) {
  return std::to_string(count) + " bytes";
}

}  // namespace

void AccessorCheck::add(const JsonCursor& place, IssueCode code, std::string detail) {
  issues_.push_back({code, place.pointer(), std::move(detail)});
}

std::vector<LinkedAccessor> AccessorCheck::check() {
  bytes_left_ = kFreeBytes;
  for (std::size_t i = 0; i < list_or_empty(core_, "buffers").size(); ++i) check_buffer(i);
  for (std::size_t i = 0; i < list_or_empty(core_, "bufferViews").size(); ++i) check_view(i);
  std::vector<LinkedAccessor> accessors;
  for (std::size_t i = 0; i < list_or_empty(core_, "accessors").size(); ++i)
    accessors.push_back(link(i));
  return accessors;
}

void AccessorCheck::check_buffer(std::size_t index) {
  readable_buffers_.push_back(false);
  const json& buffer = element_or_null(core_, "buffers", index);
  if (buffer.is_null()) return;
  const JsonCursor place = document_.root().member("buffers").element(index);
  const std::uint64_t length = integer_or(buffer, "byteLength", kNoIndex);
  try {
    if (place.member("uri").exists() && !place.member("uri").value().is_string()) return;
    const auto stored = document_.stored_bytes(index);
    const bool is_binary_chunk = document_.is_binary() && index == 0 && !buffer.contains("uri");
    if (!stored && is_binary_chunk) add(place, IssueCode::buffer_missing_glb_data, "");
    if (!stored) return;
    bytes_left_ += kMostLooksPerByte * *stored;
    readable_buffers_.back() = true;
    if (length == kNoIndex) return;
    // That a GLB was cut off is said already.
    if (*stored < length && !(is_binary_chunk && document_.is_truncated()))
      add(place, IssueCode::buffer_byte_length_mismatch,
          bytes_text(*stored) + " of " + std::to_string(length));
    if (is_binary_chunk && *stored > (length + 3) / 4 * 4)
      add(place, IssueCode::buffer_glb_chunk_too_big,
          bytes_text(*stored) + " instead of " + std::to_string(length));
  } catch (const IssueFound& found) {
    issues_.push_back(found.issue());
  }
}

void AccessorCheck::check_view(std::size_t index) {
  fitting_views_.push_back(false);
  const json& view = element_or_null(core_, "bufferViews", index);
  if (view.is_null()) return;
  const JsonCursor place = document_.root().member("bufferViews").element(index);
  const std::uint64_t offset = integer_or(view, "byteOffset", 0);
  const std::uint64_t length = integer_or(view, "byteLength", kNoIndex);
  const std::uint64_t stride = known(integer_or(view, "byteStride", 0));
  if (stride != 0 && length != kNoIndex && stride > length)
    add(place.member("byteStride"), IssueCode::buffer_view_too_big_byte_stride,
        std::to_string(stride) + " in " + bytes_text(length));
  if (stride % 4 != 0)
    add(place.member("byteStride"), IssueCode::value_multiple_of,
        std::to_string(stride) + " is no multiple of 4");
  if (stride != 0 && integer_or(view, "target", 0) == kElementArrayBuffer)
    add(place.member("byteStride"), IssueCode::buffer_view_invalid_byte_stride, "");
  const std::uint64_t number = integer_or(view, "buffer", kNoIndex);
  const std::uint64_t buffer_length =
      integer_or(element_or_null(core_, "buffers", number), "byteLength", kNoIndex);
  if (buffer_length == kNoIndex || offset == kNoIndex || length == kNoIndex) return;
  fitting_views_.back() = offset < buffer_length && offset + length <= buffer_length;
  if (!fitting_views_.back())
    issues_.push_back({IssueCode::buffer_view_too_long,
                       place.pointer() + (offset >= buffer_length ? "/byteOffset" : "/byteLength"),
                       "bytes " + std::to_string(offset) + " to " +
                           std::to_string(offset + length) + " of " +
                           std::to_string(buffer_length)});
}

LinkedAccessor AccessorCheck::link(std::size_t index) {
  LinkedAccessor accessor;
  const json& checked = element_or_null(core_, "accessors", index);
  if (checked.is_null()) return accessor;
  const JsonCursor place = document_.root().member("accessors").element(index);
  accessor.exists = true;
  accessor.component_type = known(integer_or(checked, "componentType", 0));
  accessor.count = known(integer_or(checked, "count", 0));
  accessor.byte_offset = integer_or(checked, "byteOffset", 0);
  accessor.component_size = component_size(accessor.component_type);
  const auto type = checked.find("type");
  if (type != checked.end() && type->is_string()) {
    const auto name = std::find(std::begin(kAccessorTypes), std::end(kAccessorTypes),
                                type->get_ref<const std::string&>());
    accessor.type = *name;
    accessor.components = kComponentCounts[name - std::begin(kAccessorTypes)];
  }
  accessor.element_size =
      element_bytes(accessor.type, accessor.component_size, accessor.components);
  const auto normalized = checked.find("normalized");
  accessor.is_normalized = normalized != checked.end() && *normalized == true;
  if (accessor.is_normalized && accessor.component_size == 4)
    add(place.member("normalized"), IssueCode::accessor_normalized_invalid, "");
  if (accessor.element_size != 0) {
    accessor.min = read_bounds(place.member("min"), accessor);
    accessor.max = read_bounds(place.member("max"), accessor);
  }
  accessor.view = integer_or(checked, "bufferView", kNoIndex);
  if (!is_index(place.member("bufferView")) && checked.contains("byteOffset"))
    add(place.member("byteOffset"), IssueCode::unsatisfied_dependency, "bufferView");
  const json& view = element_or_null(core_, "bufferViews", accessor.view);
  accessor.byte_stride = known(integer_or(view, "byteStride", 0));
  accessor.target = known(integer_or(view, "target", 0));
  if (!view.is_null() && check_place(accessor, place) && !checked.contains("sparse"))
    read_values(place, accessor);
  return accessor;
}

// Of floats they are numbers, of integers values of the component's type.
std::vector<double> AccessorCheck::read_bounds(const JsonCursor& bounds,
                                               const LinkedAccessor& accessor) {
  if (!bounds.exists()) return {};
  const json& list = bounds.value();
  const bool is_float = accessor.component_type == kFloatType;
  std::vector<double> values;
  if (!list.is_array()) {
    add(bounds, IssueCode::type_mismatch, "an array is expected");
  } else if (list.empty() && is_float) {
    add(bounds, IssueCode::empty_entity, "");
  } else if (list.size() != accessor.components) {
    add(bounds, IssueCode::array_length_not_in_list,
        std::to_string(list.size()) + " instead of " + std::to_string(accessor.components));
  } else {
    const auto [low, high] = component_range(accessor.component_type);
    for (const json& value : list) {
      const double number = value.is_number() ? value.get<double>() : 0;
      if (!value.is_number() || (!is_float && number != std::floor(number)))
        add(bounds, IssueCode::array_type_mismatch, value.dump());
      else if (!is_float && (number < low || number > high))
        add(bounds, IssueCode::invalid_gl_value, value.dump());
      else
        values.push_back(is_float ? static_cast<double>(static_cast<float>(number)) : number);
    }
    if (values.size() != accessor.components) values.clear();
  }
  return values;
}

// False if there is no place where the values could be.
bool AccessorCheck::check_place(const LinkedAccessor& accessor, const JsonCursor& place) {
  if (accessor.element_size == 0 || accessor.count == 0) return false;
  const json& view = element_or_null(core_, "bufferViews", accessor.view);
  const std::size_t before = issues_.size();
  if (accessor.byte_stride != 0 && accessor.byte_stride < accessor.element_size)
    add(place, IssueCode::accessor_small_bytestride,
        std::to_string(accessor.byte_stride) + " of " + bytes_text(accessor.element_size));
  const std::uint64_t view_offset = integer_or(view, "byteOffset", 0);
  const std::uint64_t length = integer_or(view, "byteLength", kNoIndex);
  if (accessor.byte_offset == kNoIndex || view_offset == kNoIndex || length == kNoIndex)
    return false;
  if (accessor.byte_offset % accessor.component_size != 0)
    add(place.member("byteOffset"), IssueCode::accessor_offset_alignment,
        std::to_string(accessor.byte_offset));
  const std::uint64_t total = view_offset + accessor.byte_offset;
  if (total % accessor.component_size != 0)
    add(place, IssueCode::accessor_total_offset_alignment, std::to_string(total));
  const std::uint64_t stride =
      accessor.byte_stride == 0 ? accessor.element_size : accessor.byte_stride;
  const std::string detail = std::to_string(accessor.count) + " elements from byte " +
                             std::to_string(accessor.byte_offset) + " in a view of " +
                             bytes_text(length);
  // Divided: the product of stride and count may overflow.
  if (accessor.byte_offset > length)
    add(place.member("byteOffset"), IssueCode::accessor_too_long, detail);
  else if (length - accessor.byte_offset < accessor.element_size ||
           (length - accessor.byte_offset - accessor.element_size) / stride < accessor.count - 1)
    add(place, IssueCode::accessor_too_long, detail);
  return issues_.size() == before && fitting_views_[accessor.view] &&
         stride % accessor.component_size == 0;
}

bool AccessorCheck::is_readable(const JsonCursor& buffer) const {
  const std::uint64_t index = buffer.index();
  return index < readable_buffers_.size() && readable_buffers_[index];
}

bool AccessorCheck::spend(std::uint64_t bytes) {
  if (bytes > bytes_left_) return false;
  bytes_left_ -= bytes;
  return true;
}

void AccessorCheck::read_values(const JsonCursor& place, LinkedAccessor& accessor) {
  try {
    const JsonCursor view =
        place.member("bufferView").resolve(document_.root().member("bufferViews"));
    const JsonCursor packing = packing_of(view);
    if (!is_readable((packing.exists() ? packing : view).member("buffer"))) return;
    const std::uint64_t view_length = view.member("byteLength").unsigned_integer();
    const std::uint64_t cost = packing.exists() ? view_length / kMostExpansion + 1
                                                : accessor.count * accessor.element_size;
    if (!spend(cost)) {
      add(place, IssueCode::accessor_data_unchecked, "");
      return;
    }
    const ViewBytes bytes = document_.unpacked_bytes(place.member("bufferView"));
    const std::uint64_t stride =
        accessor.byte_stride == 0 ? accessor.element_size : accessor.byte_stride;
    const std::uint64_t end =
        accessor.byte_offset + stride * (accessor.count - 1) + accessor.element_size;
    if (bytes.available.size() < end) return;
    accessor.values = check_values(bytes.available.subspan(accessor.byte_offset), stride, accessor,
                                   place, issues_);
  } catch (const IssueFound& found) {
    issues_.push_back(found.issue());
  }
}

}  // namespace zerotree::gltf
