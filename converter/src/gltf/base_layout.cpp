#include "gltf/base_layout.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <span>
#include <utility>

#include "gltf/packed_view.h"
#include "gltf/triangle_packing.h"

namespace zerotree::gltf {
namespace {

using nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "buffers are written as they lie");
static_assert(sizeof(Eigen::Vector3f) == 12);

constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr int kByte = 5120;
constexpr int kUnsignedByte = 5121;
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;
constexpr float kLargestShort = 65535;
// Whole numbers up to here are exact in doubles, and short without an exponent.
constexpr double kLargestWhole = 1e15;

// The bytes of all vertices, one after the other.
struct VertexData {
  std::vector<std::uint8_t> bytes;
  std::size_t stride = 0, normal_offset = 0;

  template <class Value>
  void append(const Value& value) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof value);
  }
};

VertexData float_vertices(const ProgressiveAsset& asset) {
  VertexData data;
  data.normal_offset = sizeof(Eigen::Vector3f);
  data.stride = asset.normals.empty() ? data.normal_offset : 2 * data.normal_offset;
  for (std::size_t v = 0; v < asset.control_points.size(); ++v) {
    data.append(asset.control_points[v]);
    if (!asset.normals.empty()) data.append(asset.normals[v]);
  }
  return data;
}

// Attributes begin at multiples of 4: three shorts take eight bytes, three bytes four.
VertexData quantised_vertices(const ProgressiveAsset& asset) {
  VertexData data;
  data.normal_offset = 4 * sizeof(std::uint16_t);
  data.stride = data.normal_offset + (asset.normals.empty() ? 0 : 4 * sizeof(std::int8_t));
  for (std::size_t v = 0; v < asset.control_points.size(); ++v) {
    std::array<std::uint16_t, 4> position{};
    for (int axis = 0; axis < 3; ++axis)
      position[static_cast<std::size_t>(axis)] =
          static_cast<std::uint16_t>(asset.control_points[v][axis]);
    data.append(position);
    if (asset.normals.empty()) continue;
    std::array<std::int8_t, 4> normal{};
    for (int axis = 0; axis < 3; ++axis)
      normal[static_cast<std::size_t>(axis)] =
          static_cast<std::int8_t>(std::lround(127 * asset.normals[v][axis]));
    data.append(normal);
  }
  return data;
}

template <class Index>
std::vector<std::uint8_t> index_bytes(const bitstream::BaseTopology& base) {
  std::vector<std::uint8_t> bytes;
  for (const auto& triangle : base.triangles)
    for (std::uint32_t v : triangle)
      for (std::size_t k = 0; k < sizeof(Index); ++k)
        bytes.push_back(static_cast<std::uint8_t>(v >> 8 * k));
  return bytes;
}

class LayoutMaker {
 public:
  LayoutMaker(const ProgressiveAsset& asset, const BaseForm& form, int unpacked_buffer)
      : asset_(asset), form_(form), unpacked_buffer_(unpacked_buffer) {}

  BaseLayout make() {
    add_vertex_view();
    add_triangle_view();
    if (!asset_.normals.empty()) add_normal_accessor();
    return std::move(layout_);
  }

 private:
  static constexpr int kVertexView = 0, kTriangleView = 1;

  void add_vertex_view() {
    const VertexData data = form_.quantised ? quantised_vertices(asset_) : float_vertices(asset_);
    normal_offset_ = data.normal_offset;
    if (form_.packs_vertices) {
      add_packed_view(pack_attributes(data.bytes, data.stride), asset_.control_points.size(),
                      data.stride, "ATTRIBUTES");
    } else {
      add_view(data.bytes);
    }
    ordered_json& view = layout_.views.back();
    // Floats without normals follow each other; all else has to say how far apart vertices are.
    if (form_.quantised || !asset_.normals.empty()) view["byteStride"] = data.stride;
    view["target"] = kArrayBuffer;
  }

  // In the smallest type: with 112 base vertices 32 bit would cost 2 kB, a quarter of what the
  // details of a good surface need. The largest value of each type is reserved (primitive restart).
  void add_triangle_view() {
    const bitstream::BaseTopology& base = asset_.base;
    int type = kUnsignedInt;
    if (form_.packs_triangles) {
      const bool is_short = base.vertex_count <= 0xffff;
      type = is_short ? kUnsignedShort : kUnsignedInt;
      add_packed_view(pack_triangles(base.triangles), 3 * base.triangles.size(),
                      is_short ? sizeof(std::uint16_t) : sizeof(std::uint32_t), "TRIANGLES");
    } else if (base.vertex_count <= 0xff) {
      type = kUnsignedByte;
      add_view(index_bytes<std::uint8_t>(base));
    } else if (base.vertex_count <= 0xffff) {
      type = kUnsignedShort;
      add_view(index_bytes<std::uint16_t>(base));
    } else {
      add_view(index_bytes<std::uint32_t>(base));
    }
    layout_.views.back()["target"] = kElementArrayBuffer;
    layout_.accessors.push_back({{"bufferView", kTriangleView},
                                 {"componentType", type},
                                 {"count", 3 * base.triangles.size()},
                                 {"type", "SCALAR"}});
    add_position_accessor();
  }

  void add_position_accessor() {
    Eigen::Vector3f low = asset_.control_points.front(), high = low;
    for (const Eigen::Vector3f& p : asset_.control_points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    layout_.accessors.push_back({{"bufferView", kVertexView},
                                 {"componentType", form_.quantised ? kUnsignedShort : kFloat},
                                 {"count", asset_.control_points.size()},
                                 {"type", "VEC3"},
                                 {"min", short_numbers(low)},
                                 {"max", short_numbers(high)}});
  }

  void add_normal_accessor() {
    ordered_json accessor{{"bufferView", kVertexView},
                          {"byteOffset", normal_offset_},
                          {"componentType", form_.quantised ? kByte : kFloat},
                          {"count", asset_.normals.size()},
                          {"type", "VEC3"}};
    if (form_.quantised) accessor["normalized"] = true;
    layout_.accessors.push_back(std::move(accessor));
  }

  void add_packed_view(const std::vector<std::uint8_t>& packed, std::size_t count,
                       std::size_t stride, const char* mode) {
    ordered_json packing{{"buffer", 0}};
    const std::size_t offset = append(packed);
    if (offset > 0) packing["byteOffset"] = offset;
    packing["byteLength"] = packed.size();
    packing["byteStride"] = stride;
    packing["count"] = count;
    packing["mode"] = mode;
    ordered_json view{{"buffer", unpacked_buffer_}};
    if (layout_.unpacked_length > 0) view["byteOffset"] = layout_.unpacked_length;
    view["byteLength"] = count * stride;
    view["extensions"][kPackingExtension] = std::move(packing);
    layout_.views.push_back(std::move(view));
    layout_.unpacked_length += (count * stride + 3) / 4 * 4;
  }

  void add_view(const std::vector<std::uint8_t>& data) {
    ordered_json view{{"buffer", 0}};
    const std::size_t offset = append(data);
    if (offset > 0) view["byteOffset"] = offset;
    view["byteLength"] = data.size();
    layout_.views.push_back(std::move(view));
  }

  // Returns where in the buffer it begins.
  std::size_t append(const std::vector<std::uint8_t>& data) {
    layout_.bytes.resize((layout_.bytes.size() + 3) / 4 * 4);
    const std::size_t offset = layout_.bytes.size();
    layout_.bytes.insert(layout_.bytes.end(), data.begin(), data.end());
    return offset;
  }

  const ProgressiveAsset& asset_;
  const BaseForm form_;
  const int unpacked_buffer_;
  std::size_t normal_offset_ = 0;
  BaseLayout layout_;
};

}  // namespace

ordered_json short_number(double value) {
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, static_cast<float>(value)).ptr;
  double result = 0;
  std::from_chars(text, end, result);
  if (result == std::trunc(result) && std::abs(result) < kLargestWhole)
    return static_cast<std::int64_t>(result);
  return result;
}

ordered_json short_numbers(const Eigen::Vector3f& vector) {
  return {short_number(vector.x()), short_number(vector.y()), short_number(vector.z())};
}

bool fits_quantisation(const ProgressiveAsset& asset) {
  // A negative zero would come back positive, and the payload's hash is of the bits.
  const auto is_short = [](float value) {
    return !std::signbit(value) && value <= kLargestShort && value == std::trunc(value);
  };
  return std::all_of(asset.control_points.begin(), asset.control_points.end(), [&](const auto& p) {
    return is_short(p.x()) && is_short(p.y()) && is_short(p.z());
  });
}

BaseLayout lay_out_base(const ProgressiveAsset& asset, const BaseForm& form, int unpacked_buffer) {
  return LayoutMaker(asset, form, unpacked_buffer).make();
}

}  // namespace zerotree::gltf
