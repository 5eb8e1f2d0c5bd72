// The window: a camera that turns around a model, its lights, and a line of numbers.
#pragma once

#include <OgreApplicationContext.h>
#include <OgreInput.h>
#include <OgreTextAreaOverlayElement.h>
#include <OgreVector.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "streamed_model.h"

struct ViewerOptions {
  std::string file;
  /// Where pictures of three prefixes go; none: an interactive window.
  std::optional<std::filesystem::path> screenshots;
  double bytes_per_second = 20000;
  /// Chords of the triangles drawn may be off by this much on the screen.
  float pixels = 0.5f;
  /// The direction in the model that is shown upwards.
  Ogre::Vector3 up = Ogre::Vector3::UNIT_Y;
};

class Viewer : public OgreBites::ApplicationContext, public OgreBites::InputListener {
 public:
  Viewer(const ViewerOptions& options, const ProgressiveFile& file);

  /// Opens the window and draws until it is closed, or until the pictures are written.
  void show();

 private:
  void createRoot() override;
  bool oneTimeConfig() override;
  void locateResources() override;
  void setup() override;
  bool frameStarted(const Ogre::FrameEvent& event) override;
  bool keyPressed(const OgreBites::KeyboardEvent& event) override;

  void create_scene();
  void create_camera(Ogre::SceneManager& scene);
  void create_numbers();
  void add_light(Ogre::SceneManager& scene, const Ogre::Vector3& towards, float brightness);
  void turn_camera(float radians);
  void refine(std::size_t arrived);
  void describe();
  void stream_in();
  void write_screenshots();
  /// Length in the model that covers `options_.pixels` on the screen where it is nearest.
  float error_of_pixels() const;

  const ViewerOptions& options_;
  const ProgressiveFile& file_;
  std::unique_ptr<StreamedModel> model_;
  Ogre::TextAreaOverlayElement* numbers_ = nullptr;
  Ogre::SceneNode* camera_node_ = nullptr;
  Ogre::Camera* camera_ = nullptr;
  float radius_ = 1;  // of a sphere around the bounds
  float angle_ = 0;
  double arrived_ = 0;
};
