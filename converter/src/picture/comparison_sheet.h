// Several surfaces side by side in one picture.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"
#include "picture/image.h"
#include "picture/mesh_picture.h"

namespace zerotree::picture {

/// One surface of a sheet. Refers to the mesh, which must outlive it.
struct Panel {
  Model model;
  /// UTF-8; the first line is set in bold, further ones after '\n' smaller.
  std::string caption;
};

/// An image with its caption.
struct CaptionedImage {
  Image image;
  std::string caption;
};

struct SheetOptions {
  /// Width of the sheet in pixels, 64 to 32768.
  int width = 2400;
  /// Panels in a row; 0 chooses: all up to four, else two or more even rows.
  int columns = 0;
  /// How each panel is drawn; its size is set by the sheet.
  RenderOptions render = {};
};

/// Width in pixels of each of so many panels of a sheet. Throws Error(usage) for none or a size out
/// of range.
int panel_width(int panels, const SheetOptions& options);

/// Height of a picture `width` pixels wide that is only as high as `mesh` needs, between a third
/// and four thirds of the width.
int panel_height(const TriangleMesh& mesh, int width, RenderOptions render_options);

/// The images in rows with their captions under them, on light paper. All images must have one
/// size. Throws Error(usage) if there is none or a size is out of range.
Image side_by_side(const std::vector<CaptionedImage>& panels, const SheetOptions& options);

/// Draws all panels with the camera that fits the first one and lays them side by side. Panels are
/// as high as the first model needs. Throws what render and side_by_side throw.
Image comparison(const std::vector<Panel>& panels, const SheetOptions& options = {});

/// The same, written to `path` as PNG; the file appears complete or not at all.
void write_comparison(const std::filesystem::path& path, const std::vector<Panel>& panels,
                      const SheetOptions& options = {});

}  // namespace zerotree::picture
