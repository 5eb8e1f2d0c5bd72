// A progressive mesh in OGRE's buffers that refines while its payload arrives.
#pragma once

#include <OgreHardwareIndexBuffer.h>
#include <OgreHardwareVertexBuffer.h>
#include <OgreMesh.h>
#include <glb_progressive.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

/// What cannot be shown, in a sentence for the user.
struct ViewerError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file that is freed with its owner. Throws ViewerError.
class ProgressiveFile {
 public:
  explicit ProgressiveFile(const std::string& path);
  ~ProgressiveFile() { glb_progressive_free(&glb_); }
  ProgressiveFile(const ProgressiveFile&) = delete;
  ProgressiveFile& operator=(const ProgressiveFile&) = delete;

  const glb_progressive& operator*() const { return glb_; }
  const glb_progressive* operator->() const { return &glb_; }

 private:
  glb_progressive glb_;
};

/// Feeds a payload to a decoder and its surface to a mesh, a little in each frame.
class StreamedModel {
 public:
  /// The mesh `name` of the base alone; needs a render system. Throws ViewerError.
  StreamedModel(const ProgressiveFile& file, const std::string& name, const std::string& material);

  /// Work of one frame: feeds what has come (the first `arrived` bytes of the payload), then brings
  /// the buffers up to date at the coarsest level with chords below `max_error`, each of both
  /// within `budget_us`. An unfinished surface goes on in the next frame; the last finished one is
  /// shown.
  void update(std::size_t arrived, float max_error, std::uint32_t budget_us);

  /// Whether the mesh shows the first `arrived` bytes.
  bool shows(std::size_t arrived) const {
    return !is_reconstructing_ && fed_ >= arrived && shown_bytes_ == fed_;
  }
  std::size_t fed() const { return fed_; }
  int level() const { return shown_level_; }
  std::uint32_t vertex_count() const { return zt_vertex_count(decoder_.get(), shown_level_); }
  /// Of the shown bytes, by the file's table; negative if not known.
  float error() const;
  const Ogre::MeshPtr& mesh() const { return mesh_; }

 private:
  struct Vertex {
    float position[3], normal[3];
  };
  struct Free {
    void operator()(zt_decoder* decoder) const { zt_free(decoder); }
  };

  void feed(std::size_t arrived, std::uint32_t budget_us);
  void choose_level(float max_error);
  void reconstruct(std::uint32_t budget_us);
  void show();
  const Ogre::HardwareIndexBufferSharedPtr& indices_of(int level);
  void create_mesh(const std::string& name, const std::string& material);
  [[noreturn]] void fail(const std::string& what) const;

  const ProgressiveFile& file_;
  std::unique_ptr<zt_decoder, Free> decoder_;
  std::vector<Vertex>
      vertices_;  // what is being reconstructed, while the buffer shows the last one
  Ogre::MeshPtr mesh_;
  Ogre::HardwareVertexBufferSharedPtr vertex_buffer_;
  std::vector<Ogre::HardwareIndexBufferSharedPtr> index_buffers_;  // by level, when first shown
  std::size_t fed_ = 0;
  std::size_t shown_bytes_ = 0;
  int level_ = 0;         // of what is being reconstructed
  int shown_level_ = -1;  // of what the buffers hold
  bool is_reconstructing_ = false;
};
