#include "picture/comparison_sheet.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "export/atomic_file.h"
#include "mesh/error.h"
#include "picture/caption_text.h"
#include "picture/figure.h"

namespace zerotree::picture {
namespace {

constexpr Pixel ink{38, 42, 50, 255};
constexpr Pixel grey_ink{96, 102, 114, 255};

struct Layout {
  int columns = 0, rows = 0;
  int panel_width = 0, panel_height = 0;
  int gap = 0;           // between panels and around the sheet
  int line_height = 0;   // of the first line of a caption
  int small_height = 0;  // of the others
  int caption_height = 0;
};

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

int automatic_columns(int panels) {
  constexpr int most = 4;
  const int rows = (panels + most - 1) / most;
  return (panels + rows - 1) / rows;
}

Layout layout_of(const std::vector<CaptionedImage>& panels, const SheetOptions& options) {
  Layout layout;
  const int count = static_cast<int>(panels.size());
  layout.panel_width = panel_width(count, options);
  layout.columns = options.columns > 0 ? options.columns : automatic_columns(count);
  layout.rows = (count + layout.columns - 1) / layout.columns;
  layout.panel_height = panels.front().image.height;
  layout.gap = options.width / 100;
  layout.line_height = std::max(9, layout.panel_width / 15);
  layout.small_height = layout.line_height * 5 / 6;
  std::size_t lines = 0;
  for (const CaptionedImage& panel : panels) {
    lines = std::max(lines, lines_of(panel.caption).size());
    if (panel.image.width != layout.panel_width || panel.image.height != layout.panel_height)
      throw Error(ExitCode::usage, "pictures side by side must all have the panels' size");
  }
  if (lines > 0)
    layout.caption_height = layout.line_height + static_cast<int>(lines - 1) * layout.small_height +
                            layout.line_height / 2;
  return layout;
}

// Lines that are wider than the panel are set smaller.
void draw_caption(Image& sheet, std::string_view caption, int left, int top, const Layout& layout,
                  const CaptionFont& bold, const CaptionFont& regular) {
  float y = static_cast<float>(top);
  bool first = true;
  for (std::string_view line : lines_of(caption)) {
    const CaptionFont& font = first ? bold : regular;
    float height = static_cast<float>(first ? layout.line_height : layout.small_height);
    const float room = static_cast<float>(layout.panel_width);
    height *= std::min(1.0F, room / std::max(1.0F, font.width(line, height)));
    const float x = static_cast<float>(left) + 0.5F * (room - font.width(line, height));
    font.draw(sheet, line, x, y, height, first ? ink : grey_ink);
    y += height;
    first = false;
  }
}

}  // namespace

int panel_width(int panels, const SheetOptions& options) {
  if (panels < 1) throw Error(ExitCode::usage, "a picture needs at least one mesh");
  if (options.width < 64 || options.width > 32768 || options.columns < 0)
    throw Error(ExitCode::usage, "a picture of several meshes is 64 to 32768 pixels wide");
  const int columns = options.columns > 0 ? options.columns : automatic_columns(panels);
  const int gap = options.width / 100;
  const int width = (options.width - (columns + 1) * gap) / columns;
  if (width < 8) throw Error(ExitCode::usage, "too many columns for the width of the picture");
  return width;
}

int panel_height(const TriangleMesh& mesh, int width, RenderOptions render_options) {
  render_options.width = render_options.height = 1000;
  const Camera camera = choose_camera(mesh, render_options);
  float half_width = 0.0F, half_height = 0.0F;
  for (const Triangle& t : mesh.triangles)
    for (std::uint32_t v : t) {
      const Eigen::Vector3f p = camera.frame(mesh.positions[v]) - camera.eye;
      const float depth = -p.dot(camera.axes.back);
      half_width = std::max(half_width, std::abs(p.dot(camera.axes.right)) / depth);
      half_height = std::max(half_height, std::abs(p.dot(camera.axes.up)) / depth);
    }
  const float ratio = half_height / std::max(half_width, 1e-6F);
  return static_cast<int>(std::lround(static_cast<float>(width) * std::clamp(ratio, 0.34F, 1.34F)));
}

Image side_by_side(const std::vector<CaptionedImage>& panels, const SheetOptions& options) {
  if (panels.empty()) throw Error(ExitCode::usage, "a picture needs at least one mesh");
  const Layout layout = layout_of(panels, options);
  const int cell_height = layout.panel_height + layout.caption_height + layout.gap;
  Image sheet = paper(options.width, layout.rows * cell_height + layout.gap);
  const CaptionFont bold(FontWeight::bold), regular(FontWeight::regular);
  const int count = static_cast<int>(panels.size());
  for (int i = 0; i < count; ++i) {
    const int row = i / layout.columns, column = i % layout.columns;
    const int in_row = std::min(layout.columns, count - row * layout.columns);
    const int row_width = in_row * layout.panel_width + (in_row - 1) * layout.gap;
    const int left = (options.width - row_width) / 2 + column * (layout.panel_width + layout.gap);
    const int top = layout.gap + row * cell_height;
    lay_over(sheet, panels[i].image, left, top);
    draw_caption(sheet, panels[i].caption, left, top + layout.panel_height, layout, bold, regular);
  }
  return sheet;
}

Image comparison(const std::vector<Panel>& panels, const SheetOptions& options) {
  RenderOptions drawn = options.render;
  drawn.width = panel_width(static_cast<int>(panels.size()), options);
  const TriangleMesh& original = *panels.front().model.mesh;
  drawn.height = panel_height(original, drawn.width, drawn);
  const Camera camera = choose_camera(original, drawn);
  std::vector<CaptionedImage> images;
  for (const Panel& panel : panels)
    images.push_back({render(panel.model, camera, drawn), panel.caption});
  return side_by_side(images, options);
}

void write_comparison(const std::filesystem::path& path, const std::vector<Panel>& panels,
                      const SheetOptions& options) {
  exporter::write_file_atomically(path, png_bytes(comparison(panels, options)));
}

}  // namespace zerotree::picture
