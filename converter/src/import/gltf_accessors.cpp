#include "import/gltf_accessors.h"

#include <meshoptimizer.h>

#include <algorithm>

#include "import/import_error.h"

namespace zerotree::importer {
namespace {

using nlohmann::json;

// A component as glTF means it: normalised integers are c / max, at least -1.
double component(const char* from, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
      const double c = load_scalar<std::int8_t>(from, false);
      return normalized ? std::max(c / 127.0, -1.0) : c;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
      const double c = load_scalar<std::uint8_t>(from, false);
      return normalized ? c / 255.0 : c;
    }
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
      const double c = load_scalar<std::int16_t>(from, false);
      return normalized ? std::max(c / 32767.0, -1.0) : c;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
      const double c = load_scalar<std::uint16_t>(from, false);
      return normalized ? c / 65535.0 : c;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load_scalar<std::uint32_t>(from, false);
    default:
      return static_cast<double>(load_scalar<float>(from, false));
  }
}

std::size_t component_size(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

const json* meshopt_extension(const json& document, int view) {
  const json& value = document.at("bufferViews").at(static_cast<std::size_t>(view));
  const auto extensions = value.find("extensions");
  if (extensions == value.end() || !extensions->is_object()) return nullptr;
  const auto meshopt = extensions->find("EXT_meshopt_compression");
  return meshopt == extensions->end() || !meshopt->is_object() ? nullptr : &*meshopt;
}

bool decode_mode(const std::string& mode, std::string& out, std::size_t count, std::size_t stride,
                 std::string_view packed) {
  const auto* from = reinterpret_cast<const unsigned char*>(packed.data());
  if (mode == "ATTRIBUTES")
    return stride % 4 == 0 && stride <= 256 &&
           meshopt_decodeVertexBuffer(out.data(), count, stride, from, packed.size()) == 0;
  if (stride != 2 && stride != 4) return false;
  if (mode == "TRIANGLES")
    return count % 3 == 0 &&
           meshopt_decodeIndexBuffer(out.data(), count, stride, from, packed.size()) == 0;
  return mode == "INDICES" &&
         meshopt_decodeIndexSequence(out.data(), count, stride, from, packed.size()) == 0;
}

bool apply_filter(const std::string& filter, std::string& out, std::size_t count,
                  std::size_t stride) {
  if (filter == "NONE") return true;
  if (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) {
    meshopt_decodeFilterOct(out.data(), count, stride);
  } else if (filter == "QUATERNION" && stride == 8) {
    meshopt_decodeFilterQuat(out.data(), count, stride);
  } else if (filter == "EXPONENTIAL" && stride % 4 == 0) {
    meshopt_decodeFilterExp(out.data(), count, stride);
  } else {
    return false;
  }
  return true;
}

std::string text_of(const json& object, const char* key, const char* otherwise) {
  const auto value = object.find(key);
  return value != object.end() && value->is_string() ? value->get<std::string>() : otherwise;
}

}  // namespace

GltfAccessors::GltfAccessors(const tinygltf::Model& model, const GltfContainer& container,
                             const ImportOptions& options, const std::string& file)
    : model_(model),
      container_(container),
      options_(options),
      file_(file),
      decoded_views_(model.bufferViews.size()) {}

const tinygltf::Accessor& GltfAccessors::get(int accessor) const {
  if (accessor < 0 || static_cast<std::size_t>(accessor) >= model_.accessors.size())
    refuse(file_, "accessor " + std::to_string(accessor) + " does not exist; export it again");
  return model_.accessors[static_cast<std::size_t>(accessor)];
}

std::size_t GltfAccessors::count(int accessor) const {
  return get(accessor).count;
}

int GltfAccessors::components(int accessor) const {
  switch (get(accessor).type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    default:
      refuse(file_, "accessor " + std::to_string(accessor) + " holds matrices; export it again");
  }
}

std::string_view GltfAccessors::view_bytes(int view) const {
  if (view < 0 || static_cast<std::size_t>(view) >= model_.bufferViews.size())
    refuse(file_, "buffer view " + std::to_string(view) + " does not exist; export it again");
  const tinygltf::BufferView& v = model_.bufferViews[static_cast<std::size_t>(view)];
  const auto buffer = static_cast<std::size_t>(v.buffer);
  if (v.buffer < 0 || buffer >= container_.buffers.size() ||
      v.byteOffset > container_.buffers[buffer].size() ||
      v.byteLength > container_.buffers[buffer].size() - v.byteOffset)
    refuse(file_, "buffer view " + std::to_string(view) +
                      " lies outside its buffer; fetch or export the file again");
  return std::string_view(container_.buffers[buffer]).substr(v.byteOffset, v.byteLength);
}

std::string GltfAccessors::decode_meshopt(const json& extension, int view) const {
  const auto fail = [&](const std::string& problem) {
    refuse(file_, "buffer view " + std::to_string(view) + ": its EXT_meshopt_compression " +
                      problem + "; compress the file again");
  };
  constexpr std::uint64_t missing = ~std::uint64_t{0};
  const std::uint64_t buffer = json_count(extension, "buffer", missing);
  const std::uint64_t offset = json_count(extension, "byteOffset", 0);
  const std::uint64_t length = json_count(extension, "byteLength", missing);
  const std::uint64_t stride = json_count(extension, "byteStride", missing);
  const std::uint64_t count = json_count(extension, "count", missing);
  if (buffer >= container_.buffers.size() || offset > container_.buffers[buffer].size() ||
      length > container_.buffers[buffer].size() - offset)
    fail("lies outside its buffer");
  // The codecs spend at least a byte on 64 bytes of output; so this bounds the allocation.
  if (stride == 0 || stride > 256 || count > options_.max_elements ||
      count * stride > 128 * (length + 64))
    fail("states sizes that cannot be");
  std::string out(static_cast<std::size_t>(count * stride), '\0');
  const std::string_view packed =
      std::string_view(container_.buffers[buffer]).substr(offset, length);
  if (!decode_mode(text_of(extension, "mode", ""), out, count, stride, packed))
    fail("cannot be decoded");
  if (!apply_filter(text_of(extension, "filter", "NONE"), out, count, stride))
    fail("names a filter that does not fit its data");
  return out;
}

std::string_view GltfAccessors::decoded_view(int view) {
  if (view < 0 || static_cast<std::size_t>(view) >= model_.bufferViews.size())
    refuse(file_, "buffer view " + std::to_string(view) + " does not exist; export it again");
  const json* extension = meshopt_extension(container_.document, view);
  if (extension == nullptr) return view_bytes(view);
  std::optional<std::string>& decoded = decoded_views_[static_cast<std::size_t>(view)];
  if (!decoded) decoded = decode_meshopt(*extension, view);
  return *decoded;
}

GltfAccessors::Elements GltfAccessors::elements(int view, std::size_t offset, std::size_t count,
                                                std::size_t element_size) {
  Elements result;
  result.bytes = decoded_view(view);
  result.stride = model_.bufferViews[static_cast<std::size_t>(view)].byteStride;
  if (result.stride == 0) result.stride = element_size;
  const std::size_t size = result.bytes.size();
  const bool fits = element_size > 0 && result.stride >= element_size && offset <= size &&
                    (count == 0 || (element_size <= size - offset &&
                                    (count - 1) <= (size - offset - element_size) / result.stride));
  if (!fits)
    refuse(file_, "an accessor reads beyond buffer view " + std::to_string(view) +
                      "; fetch or export the file again");
  result.bytes = result.bytes.substr(offset);
  return result;
}

std::vector<double> GltfAccessors::values(int accessor_index) {
  const tinygltf::Accessor& accessor = get(accessor_index);
  const auto width = static_cast<std::size_t>(components(accessor_index));
  const std::size_t size = component_size(accessor.componentType);
  // An accessor without a view is all zeros and needs no bytes in the file.
  constexpr std::size_t most_zeros = 1 << 24;
  if (accessor.count > (accessor.bufferView < 0 ? most_zeros : options_.max_elements))
    refuse(file_, "accessor " + std::to_string(accessor_index) + " states too many elements");
  std::vector<double> result;
  if (accessor.bufferView < 0) {
    result.resize(accessor.count * width);
  } else {
    const Elements from =
        elements(accessor.bufferView, accessor.byteOffset, accessor.count, size * width);
    result.reserve(accessor.count * width);
    for (std::size_t i = 0; i < accessor.count; ++i)
      for (std::size_t c = 0; c < width; ++c)
        result.push_back(component(from.bytes.data() + i * from.stride + c * size,
                                   accessor.componentType, accessor.normalized));
  }
  if (accessor.sparse.isSparse) overlay_sparse(accessor, result);
  return result;
}

void GltfAccessors::overlay_sparse(const tinygltf::Accessor& accessor,
                                   std::vector<double>& values) {
  const auto& sparse = accessor.sparse;
  const std::size_t width = accessor.count == 0 ? 0 : values.size() / accessor.count;
  const std::size_t size = component_size(accessor.componentType);
  const std::size_t index_size = component_size(sparse.indices.componentType);
  if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0 ||
      static_cast<std::size_t>(sparse.count) > accessor.count)
    refuse(file_, "a sparse accessor with more values than elements; export it again");
  const auto count = static_cast<std::size_t>(sparse.count);
  const Elements indices =
      elements(sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset),
               count, index_size);
  const Elements from =
      elements(sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), count,
               size * width);
  for (std::size_t i = 0; i < count; ++i) {
    const double index =
        component(indices.bytes.data() + i * indices.stride, sparse.indices.componentType, false);
    if (!(index >= 0 && index < static_cast<double>(accessor.count)))
      refuse(file_, "a sparse accessor names an element that is not there; export it again");
    for (std::size_t c = 0; c < width; ++c)
      values[static_cast<std::size_t>(index) * width + c] =
          component(from.bytes.data() + i * from.stride + c * size, accessor.componentType,
                    accessor.normalized);
  }
}

std::vector<std::uint32_t> GltfAccessors::indices(int accessor_index) {
  const tinygltf::Accessor& accessor = get(accessor_index);
  const int type = accessor.componentType;
  if (accessor.type != TINYGLTF_TYPE_SCALAR || (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
                                                type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
                                                type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT))
    refuse(file_, "accessor " + std::to_string(accessor_index) +
                      " is used for indices but holds no unsigned integers; export it again");
  std::vector<std::uint32_t> result;
  for (double value : values(accessor_index)) result.push_back(static_cast<std::uint32_t>(value));
  return result;
}

}  // namespace zerotree::importer
