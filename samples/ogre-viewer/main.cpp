// Shows a progressive GLB while its payload arrives.
#include <OgreException.h>
#include <OgreLogManager.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "viewer.h"

namespace {

constexpr char kUsage[] =
    "usage: zerotree-ogre-viewer IN.glb [OPTION...]\n"
    "  --bytes-per-second N   how fast the payload arrives (20000)\n"
    "  --pixels P             how far triangles may be off on the screen (0.5)\n"
    "  --up AXIS              what is up in the model: x, -x, y, -y, z or -z (y)\n"
    "  --screenshots DIR      write pictures of 2, 15 and 100 % of the payload, and end\n";

bool parse_positive(const char* text, double& value) {
  char* end = nullptr;
  value = std::strtod(text, &end);
  return end != text && *end == '\0' && value > 0 && value <= 1e12;
}

bool parse_axis(const char* text, Ogre::Vector3& axis) {
  const bool is_negative = *text == '-';
  const char letter = text[is_negative ? 1 : 0];
  if (letter < 'x' || letter > 'z' || text[is_negative ? 2 : 1] != '\0') return false;
  axis = Ogre::Vector3::ZERO;
  axis[static_cast<std::size_t>(letter - 'x')] = is_negative ? -1.0f : 1.0f;
  return true;
}

bool parse_option(const char* name, const char* value, ViewerOptions& options) {
  double number = 0;
  if (std::strcmp(name, "--screenshots") == 0) {
    options.screenshots = value;
  } else if (std::strcmp(name, "--up") == 0) {
    if (!parse_axis(value, options.up)) return false;
  } else if (std::strcmp(name, "--bytes-per-second") == 0) {
    if (!parse_positive(value, options.bytes_per_second)) return false;
  } else if (std::strcmp(name, "--pixels") == 0) {
    if (!parse_positive(value, number)) return false;
    options.pixels = static_cast<float>(number);
  } else {
    return false;
  }
  return true;
}

bool parse(int argc, char** argv, ViewerOptions& options) {
  if (argc < 2 || argc % 2 != 0 || argv[1][0] == '-') return false;
  options.file = argv[1];
  for (int k = 2; k < argc; k += 2)
    if (!parse_option(argv[k], argv[k + 1], options)) return false;
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  ViewerOptions options;
  if (!parse(argc, argv, options)) {
    std::fputs(kUsage, stderr);
    return 2;
  }
  // OGRE's log says what went wrong within OGRE; it goes to no file.
  Ogre::LogManager log;
  log.createLog("", true, false, true);
  try {
    const ProgressiveFile file(options.file);
    Viewer(options, file).show();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "zerotree-ogre-viewer: %s\n", error.what());
    return 1;
  }
  return 0;
}
