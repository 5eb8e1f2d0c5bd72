#include "viewer.h"

#include <Ogre.h>
#include <OgreOverlay.h>
#include <OgreOverlayContainer.h>
#include <OgreOverlayManager.h>
#include <OgreOverlaySystem.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "surface_material.h"

namespace {

constexpr char kMaterial[] = "surface";
constexpr std::uint32_t kWidth = 960, kHeight = 720;
constexpr float kFieldOfView = 0.6f;  // of the height, in radians
constexpr float kFirstAngle = 0.5f;
constexpr float kTurnsPerSecond = 0.05f;
constexpr std::uint32_t kBudget = 3000;  // microseconds a frame for each of decoding and surface
constexpr std::array kPictures{0.02, 0.15, 1.0};

std::string error_text(float error) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "error %.2g %% of the diagonal", 100 * error);
  return text.data();
}

}  // namespace

Viewer::Viewer(const ViewerOptions& options, const ProgressiveFile& file)
    : OgreBites::ApplicationContext("zerotree-ogre-viewer"), options_(options), file_(file) {}

void Viewer::show() {
  initApp();
  if (options_.screenshots)
    write_screenshots();
  else
    stream_in();
  model_.reset();
  closeApp();
}

// OGRE's configuration files would load every renderer and ask for one; this sample needs one.
void Viewer::createRoot() {
  mRoot = OGRE_NEW Ogre::Root("", "", "");
  mRoot->loadPlugin(OGRE_PLUGIN_DIR "/RenderSystem_GL3Plus");
  mRoot->loadPlugin(OGRE_PLUGIN_DIR "/Codec_STBI");
  mOverlaySystem = OGRE_NEW Ogre::OverlaySystem();
}

bool Viewer::oneTimeConfig() {
  if (mRoot->getAvailableRenderers().empty())
    throw ViewerError("OGRE has no OpenGL 3 renderer; is its plugin RenderSystem_GL3Plus there?");
  mRoot->setRenderSystem(mRoot->getAvailableRenderers().front());
  return true;
}

void Viewer::locateResources() {
  auto& resources = Ogre::ResourceGroupManager::getSingleton();
  for (const char* folder : {"/RTShaderLib/materials", "/RTShaderLib/GLSL", "/ShadowVolume"})
    resources.addResourceLocation(std::string(OGRE_MEDIA_DIR) + folder, "FileSystem",
                                  Ogre::RGN_INTERNAL);
  resources.addResourceLocation(OGRE_MEDIA_DIR "/packs/SdkTrays.zip", "Zip", "Essential");
}

void Viewer::setup() {
  mRoot->initialise(false);
  createWindow(mAppName, kWidth, kHeight, {{"FSAA", "4"}, {"vsync", "true"}});
  locateResources();
  initialiseRTShaderSystem();
  loadResources();
  mRoot->addFrameListener(this);
  addInputListener(this);
  create_surface_material(kMaterial);
  model_ = std::make_unique<StreamedModel>(file_, options_.file, kMaterial);
  create_scene();
}

void Viewer::create_scene() {
  Ogre::SceneManager& scene = *mRoot->createSceneManager();
  Ogre::RTShader::ShaderGenerator::getSingleton().addSceneManager(&scene);
  scene.addRenderQueueListener(mOverlaySystem);
  scene.setAmbientLight(Ogre::ColourValue::Black);
  const Ogre::Vector3 low(file_->bounds_min), high(file_->bounds_max);
  radius_ = 0.5f * (high - low).length();
  Ogre::Entity* entity = scene.createEntity(model_->mesh());
  Ogre::SceneNode* upright = scene.getRootSceneNode()->createChildSceneNode();
  upright->setOrientation(options_.up.getRotationTo(Ogre::Vector3::UNIT_Y));
  upright->createChildSceneNode(-0.5f * (low + high))->attachObject(entity);
  create_camera(scene);
  add_light(scene, {0.5f, -0.65f, -0.7f}, 1.0f);
  add_light(scene, {-0.9f, -0.1f, -0.35f}, 0.25f);
  create_numbers();
}

void Viewer::create_camera(Ogre::SceneManager& scene) {
  camera_ = scene.createCamera("camera");
  camera_->setAutoAspectRatio(true);
  camera_->setFOVy(Ogre::Radian(kFieldOfView));
  camera_->setNearClipDistance(0.1f * radius_);
  camera_->setFarClipDistance(20 * radius_);
  camera_node_ = scene.getRootSceneNode()->createChildSceneNode();
  camera_node_->attachObject(camera_);
  turn_camera(kFirstAngle);
  getRenderWindow()->addViewport(camera_)->setBackgroundColour(Ogre::ColourValue(.84f, .85f, .86f));
}

void Viewer::create_numbers() {
  auto& overlays = Ogre::OverlayManager::getSingleton();
  numbers_ = static_cast<Ogre::TextAreaOverlayElement*>(
      overlays.createOverlayElement("TextArea", "numbers"));
  numbers_->setMetricsMode(Ogre::GMM_PIXELS);
  numbers_->setPosition(16, 14);
  numbers_->setFontName("SdkTrays/Value", "Essential");
  numbers_->setCharHeight(20);
  numbers_->setColour(Ogre::ColourValue(.15f, .16f, .18f));
  auto* panel =
      static_cast<Ogre::OverlayContainer*>(overlays.createOverlayElement("Panel", "corner"));
  panel->addChild(numbers_);
  Ogre::Overlay* overlay = overlays.create("numbers");
  overlay->add2D(panel);
  overlay->show();
}

/// A directional light that turns with the camera, as the eye is used to.
void Viewer::add_light(Ogre::SceneManager& scene, const Ogre::Vector3& towards, float brightness) {
  Ogre::Light* light = scene.createLight();
  light->setType(Ogre::Light::LT_DIRECTIONAL);
  light->setDiffuseColour(Ogre::ColourValue(1, 1, 1) * brightness);
  Ogre::SceneNode* node = camera_node_->createChildSceneNode();
  node->setDirection(towards, Ogre::Node::TS_PARENT);
  node->attachObject(light);
}

void Viewer::turn_camera(float radians) {
  const float distance = 0.8f * radius_ / std::sin(0.5f * kFieldOfView);
  const float height = 0.2f;
  angle_ = std::remainder(angle_ + radians, 2 * Ogre::Math::PI);
  camera_node_->setPosition(distance * Ogre::Vector3(std::sin(angle_) * std::cos(height),
                                                     std::sin(height),
                                                     std::cos(angle_) * std::cos(height)));
  camera_node_->lookAt(Ogre::Vector3::ZERO, Ogre::Node::TS_PARENT);
}

float Viewer::error_of_pixels() const {
  const float nearest = camera_node_->getPosition().length() - radius_;
  const float height = static_cast<float>(getRenderWindow()->getHeight());
  return 2 * std::max(nearest, 0.1f * radius_) * std::tan(0.5f * kFieldOfView) * options_.pixels /
         height;
}

void Viewer::refine(std::size_t arrived) {
  model_->update(std::min(arrived, file_->payload_size), error_of_pixels(), kBudget);
  describe();
}

void Viewer::describe() {
  const double share = static_cast<double>(model_->fed()) /
                       static_cast<double>(std::max<std::size_t>(file_->payload_size, 1));
  const float error = model_->error() / file_->source_diagonal;
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%zu bytes (%.0f %%)   level %d   %u vertices   %s",
                model_->fed(), 100 * share, model_->level(), model_->vertex_count(),
                error < 0 ? "" : error_text(error).c_str());
  numbers_->setCaption(text.data());
}

bool Viewer::frameStarted(const Ogre::FrameEvent& event) {
  OgreBites::ApplicationContext::frameStarted(event);
  if (options_.screenshots) return true;
  turn_camera(kTurnsPerSecond * 2 * Ogre::Math::PI * event.timeSinceLastFrame);
  arrived_ += options_.bytes_per_second * event.timeSinceLastFrame;
  refine(static_cast<std::size_t>(arrived_));
  return true;
}

bool Viewer::keyPressed(const OgreBites::KeyboardEvent& event) {
  if (event.keysym.sym == OgreBites::SDLK_ESCAPE) mRoot->queueEndRendering();
  return true;
}

void Viewer::stream_in() {
  mRoot->startRendering();
}

void Viewer::write_screenshots() {
  std::filesystem::create_directories(*options_.screenshots);
  for (std::size_t k = 0; k < kPictures.size(); ++k) {
    const auto bytes = static_cast<std::size_t>(
        std::ceil(kPictures[k] * static_cast<double>(file_->payload_size)));
    // Twice in a row, for the first time the level may have been chosen before the last bytes came.
    for (int settled = 0; settled < 2; settled = model_->shows(bytes) ? settled + 1 : 0) {
      refine(bytes);
      mRoot->renderOneFrame();
    }
    const auto path = *options_.screenshots / ("prefix" + std::to_string(k + 1) + ".png");
    getRenderWindow()->writeContentsToFile(path.string());
    std::printf("%s: %zu bytes, level %d, %u vertices\n", path.c_str(), model_->fed(),
                model_->level(), model_->vertex_count());
  }
}
