// Buffers, bufferViews and accessors: does each fit into the other, and are the values right?
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gltf/gltf_document.h"
#include "gltf/issue_table.h"

namespace zerotree::gltf {

/// What the values of an accessor are like.
struct AccessorValues {
  /// Of scalars.
  double largest = 0;
  std::uint64_t largest_at = 0;
  /// The first element, a vector of three, that is not of unit length.
  std::optional<std::uint64_t> non_unit;
};

/// An accessor with what glTF's defaults add. Numbers are 0 where the file has none that is valid.
struct LinkedAccessor {
  bool exists = false;
  std::uint64_t component_type = 0, count = 0;
  /// As in the file; empty if invalid.
  std::string_view type;
  bool is_normalized = false;
  std::uint64_t byte_offset = 0;
  std::uint64_t view = ~std::uint64_t{0};
  /// Of its bufferView; 0 if that states none.
  std::uint64_t byte_stride = 0;
  /// Of that bufferView; 0 if it states none.
  std::uint64_t target = 0;
  /// Bytes of one element, and of a component.
  std::uint64_t element_size = 0, component_size = 0;
  std::size_t components = 0;
  /// Empty if there are none that are valid.
  std::vector<double> min, max;
  /// Nothing if the values are not there, or do not lie where they may.
  std::optional<AccessorValues> values;
};

/// One pass over the buffers, bufferViews and accessors of a document.
class AccessorCheck {
 public:
  /// `core` is the checked document. All arguments must outlive this.
  AccessorCheck(GltfDocument& document, const nlohmann::json& core, Issues& issues)
      : document_(document), core_(core), issues_(issues) {}

  /// Adds what is wrong; returns the accessors.
  std::vector<LinkedAccessor> check();

 private:
  void check_buffer(std::size_t index);
  void check_view(std::size_t index);
  LinkedAccessor link(std::size_t index);
  std::vector<double> read_bounds(const JsonCursor& bounds, const LinkedAccessor& accessor);
  bool check_place(const LinkedAccessor& accessor, const JsonCursor& place);
  void read_values(const JsonCursor& place, LinkedAccessor& accessor);
  bool spend(std::uint64_t bytes);
  bool is_readable(const JsonCursor& buffer) const;
  void add(const JsonCursor& place, IssueCode code, std::string detail);

  GltfDocument& document_;
  const nlohmann::json& core_;
  Issues& issues_;
  std::vector<bool> readable_buffers_, fitting_views_;
  std::uint64_t bytes_left_ = 0;
};

}  // namespace zerotree::gltf
