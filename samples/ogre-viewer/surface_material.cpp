#include "surface_material.h"

#include <OgreHighLevelGpuProgram.h>
#include <OgreHighLevelGpuProgramManager.h>
#include <OgreMaterialManager.h>
#include <OgrePass.h>
#include <OgreResourceGroupManager.h>
#include <OgreTechnique.h>

#include <string>

namespace {

constexpr char kVertexShader[] = R"(#version 150
in vec4 vertex;
in vec3 normal;
uniform mat4 worldViewProj;
uniform mat4 worldView;
out vec3 viewPosition;
out vec3 viewNormal;
void main() {
  gl_Position = worldViewProj * vertex;
  viewPosition = (worldView * vertex).xyz;
  viewNormal = mat3(worldView) * normal;
}
)";

// Light is added linearly and written for screens of gamma 2.2. Below and behind there is a little
// light too, so that nothing is black.
constexpr char kFragmentShader[] = R"(#version 150
in vec3 viewPosition;
in vec3 viewNormal;
uniform vec4 toLight[2];
uniform vec4 lightColour[2];
out vec4 colour;
const vec3 clay = vec3(0.66, 0.57, 0.48);
void main() {
  vec3 n = normalize(gl_FrontFacing ? viewNormal : -viewNormal);
  vec3 toEye = normalize(-viewPosition);
  vec3 light = mix(vec3(0.06, 0.055, 0.05), vec3(0.15, 0.16, 0.18), 0.5 + 0.5 * n.y);
  vec3 shine = vec3(0.0);
  for (int k = 0; k < 2; ++k) {
    vec3 l = normalize(toLight[k].xyz);
    light += max(dot(n, l), 0.0) * lightColour[k].rgb;
    shine += pow(max(dot(n, normalize(l + toEye)), 0.0), 28.0) * 0.09 * lightColour[k].rgb;
  }
  colour = vec4(pow(clay * light + shine, vec3(1.0 / 2.2)), 1.0);
}
)";

Ogre::GpuProgramParametersSharedPtr create_program(const std::string& name,
                                                   Ogre::GpuProgramType type, const char* source) {
  const Ogre::HighLevelGpuProgramPtr program =
      Ogre::HighLevelGpuProgramManager::getSingleton().createProgram(
          name, Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME, "glsl", type);
  program->setSource(source);
  program->load();
  return program->getDefaultParameters();
}

}  // namespace

void create_surface_material(const char* name) {
  const std::string vertex = std::string(name) + "/vertex";
  const std::string fragment = std::string(name) + "/fragment";
  const auto transforms = create_program(vertex, Ogre::GPT_VERTEX_PROGRAM, kVertexShader);
  transforms->setNamedAutoConstant("worldViewProj",
                                   Ogre::GpuProgramParameters::ACT_WORLDVIEWPROJ_MATRIX);
  transforms->setNamedAutoConstant("worldView", Ogre::GpuProgramParameters::ACT_WORLDVIEW_MATRIX);
  const auto lights = create_program(fragment, Ogre::GPT_FRAGMENT_PROGRAM, kFragmentShader);
  lights->setNamedAutoConstant("toLight",
                               Ogre::GpuProgramParameters::ACT_LIGHT_POSITION_VIEW_SPACE_ARRAY, 2);
  lights->setNamedAutoConstant("lightColour",
                               Ogre::GpuProgramParameters::ACT_LIGHT_DIFFUSE_COLOUR_ARRAY, 2);
  const Ogre::MaterialPtr material = Ogre::MaterialManager::getSingleton().create(
      name, Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME);
  Ogre::Pass* pass = material->getTechnique(0)->getPass(0);
  pass->setVertexProgram(vertex);
  pass->setFragmentProgram(fragment);
  pass->setCullingMode(Ogre::CULL_NONE);
}
