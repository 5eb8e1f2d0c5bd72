#include "streamed_model.h"

#include <OgreHardwareBufferManager.h>
#include <OgreMeshManager.h>
#include <OgreResourceGroupManager.h>
#include <OgreSubMesh.h>

#include <algorithm>
#include <array>

namespace {

/// More vertices than this are no model for a viewer; a file of few bytes may ask for them.
constexpr std::uint64_t kMostVertices = 1 << 24;
/// What 16 bit indices can name: 65535 restarts a primitive.
constexpr std::uint32_t kMostShortVertices = 65535;

}  // namespace

ProgressiveFile::ProgressiveFile(const std::string& path) {
  std::array<char, 512> message{};
  if (!glb_progressive_load(path.c_str(), &glb_, message.data(), message.size()))
    throw ViewerError(message.data());
}

StreamedModel::StreamedModel(const ProgressiveFile& file, const std::string& name,
                             const std::string& material)
    : file_(file) {
  zt_options options{};
  options.struct_size = sizeof options;
  options.max_vertices = kMostVertices;
  decoder_.reset(glb_progressive_decoder(&*file, &options));
  if (!decoder_ || zt_get_status(decoder_.get()) == ZT_BROKEN) fail("the base mesh is refused");
  const std::uint32_t finest = zt_vertex_count(decoder_.get(), file->levels);
  vertices_.resize(finest);
  index_buffers_.resize(static_cast<std::size_t>(file->levels) + 1);
  create_mesh(name, material);
  reconstruct(0);
  while (is_reconstructing_) reconstruct(0);
}

void StreamedModel::create_mesh(const std::string& name, const std::string& material) {
  const glb_progressive& glb = *file_;
  auto& buffers = Ogre::HardwareBufferManager::getSingleton();
  // One buffer for all levels: the vertices of a level are the first ones of each finer level.
  vertex_buffer_ = buffers.createVertexBuffer(sizeof(Vertex), vertices_.size(),
                                              Ogre::HardwareBuffer::HBU_DYNAMIC_WRITE_ONLY);
  mesh_ = Ogre::MeshManager::getSingleton().createManual(
      name, Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME);
  auto* data = new Ogre::VertexData;  // the mesh's
  mesh_->sharedVertexData = data;
  data->vertexDeclaration->addElement(0, offsetof(Vertex, position), Ogre::VET_FLOAT3,
                                      Ogre::VES_POSITION);
  data->vertexDeclaration->addElement(0, offsetof(Vertex, normal), Ogre::VET_FLOAT3,
                                      Ogre::VES_NORMAL);
  data->vertexBufferBinding->setBinding(0, vertex_buffer_);
  Ogre::SubMesh* triangles = mesh_->createSubMesh();
  triangles->useSharedVertices = true;
  triangles->setMaterialName(material);
  const Ogre::Vector3 low(glb.bounds_min), high(glb.bounds_max);
  mesh_->_setBounds({low, high});
  mesh_->_setBoundingSphereRadius(std::max(low.length(), high.length()));
}

void StreamedModel::update(std::size_t arrived, float max_error, std::uint32_t budget_us) {
  feed(arrived, budget_us);
  if (!is_reconstructing_) choose_level(max_error);
  if (is_reconstructing_ || level_ != shown_level_ || fed_ != shown_bytes_) reconstruct(budget_us);
}

void StreamedModel::feed(std::size_t arrived, std::uint32_t budget_us) {
  const std::size_t end = std::min(arrived, file_->payload_size);
  if (fed_ >= end) return;
  std::size_t taken = 0;
  if (zt_feed_for(decoder_.get(), file_->payload + fed_, end - fed_, budget_us, &taken) ==
      ZT_BROKEN)
    fail("the payload is broken");
  fed_ += taken;
}

void StreamedModel::choose_level(float max_error) {
  std::int32_t level = 0;
  if (zt_choose_level(decoder_.get(), max_error, &level) != ZT_OK) fail("no level can be chosen");
  level_ = level;
}

void StreamedModel::reconstruct(std::uint32_t budget_us) {
  const zt_result result = zt_reconstruct_for(
      decoder_.get(), level_, vertices_.data()->position, sizeof(Vertex), vertices_.data()->normal,
      sizeof(Vertex), static_cast<std::uint32_t>(vertices_.size()), budget_us);
  is_reconstructing_ = result == ZT_UNFINISHED;
  if (result == ZT_OK) return show();
  if (result != ZT_UNFINISHED) fail("the surface cannot be reconstructed");
}

void StreamedModel::show() {
  const std::uint32_t count = zt_vertex_count(decoder_.get(), level_);
  vertex_buffer_->writeData(0, sizeof(Vertex) * count, vertices_.data(), true);
  mesh_->sharedVertexData->vertexCount = count;
  Ogre::IndexData& triangles = *mesh_->getSubMesh(0)->indexData;
  triangles.indexBuffer = indices_of(level_);
  triangles.indexCount = triangles.indexBuffer->getNumIndexes();
  shown_level_ = level_;
  shown_bytes_ = fed_;
}

const Ogre::HardwareIndexBufferSharedPtr& StreamedModel::indices_of(int level) {
  Ogre::HardwareIndexBufferSharedPtr& buffer = index_buffers_[static_cast<std::size_t>(level)];
  if (buffer) return buffer;
  const bool is_short = zt_vertex_count(decoder_.get(), level) <= kMostShortVertices;
  const std::uint32_t triangles = zt_triangle_count(decoder_.get(), level);
  buffer = Ogre::HardwareBufferManager::getSingleton().createIndexBuffer(
      is_short ? Ogre::HardwareIndexBuffer::IT_16BIT : Ogre::HardwareIndexBuffer::IT_32BIT,
      std::size_t{3} * triangles, Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY);
  std::vector<std::byte> indices(buffer->getSizeInBytes());
  if (zt_get_indices(decoder_.get(), level, indices.data(), is_short ? 2 : 4, triangles) != ZT_OK)
    fail("there are no triangles");
  buffer->writeData(0, indices.size(), indices.data(), true);
  return buffer;
}

float StreamedModel::error() const {
  zt_info info{};
  zt_get_info(decoder_.get(), &info, sizeof info);
  return info.error;
}

void StreamedModel::fail(const std::string& what) const {
  throw ViewerError(what + (decoder_ ? std::string(": ") + zt_reason(decoder_.get()) : ""));
}
