#include "convert/remesh_pictures.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "picture/colour_ramp.h"
#include "picture/figure.h"
#include "picture/line_overlay.h"

namespace zerotree::convert {
namespace {

using picture::Image;
using picture::Lines;
using picture::Pixel;

constexpr Pixel kEdge{60, 66, 78, 255};
constexpr Pixel kFineLine{120, 92, 60, 255};
constexpr Pixel kCrease{212, 38, 30, 255};
constexpr Pixel kBoundary{26, 92, 206, 255};
constexpr Pixel kCorner{20, 20, 24, 255};
constexpr Pixel kCornerCore{255, 206, 40, 255};
constexpr float kThin = 1.1F, kMiddle = 1.8F, kBold = 2.6F, kFeature = 4.0F;
constexpr float kDot = 14.0F, kDotCore = 8.0F;
// More triangles than this cannot be told apart at the pictures' size.
constexpr std::size_t kMostDrawnFaces = 12'000;

std::string counted(std::size_t count, const char* what) {
  return std::to_string(count).append(" ").append(what);
}

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

Image on_paper(const picture::Model& model, const PictureView& view,
               const picture::RenderOptions& options) {
  Image image = picture::paper(options.width, options.height);
  lay_over(image, picture::render(model, view.camera, options), 0, 0);
  return image;
}

// Edges of the base by what they are.
struct BaseEdges {
  std::vector<std::uint32_t> plain, creases, boundary;
};

BaseEdges sort_base_edges(const relax::RelaxedMesh& relaxed) {
  const auto& creases = relaxed.mesh.base.crease_edges;  // ascending
  const relax::SubdividedLevel& base = relaxed.levels.front();
  BaseEdges sorted;
  for (std::uint32_t e = 0; e < base.edges.size(); ++e) {
    const auto [a, b] = base.edges[e];
    const std::array<std::uint32_t, 2> key{std::min(a, b), std::max(a, b)};
    if (!base.is_feature[e])
      sorted.plain.push_back(e);
    else if (std::binary_search(creases.begin(), creases.end(), key))
      sorted.creases.push_back(e);
    else
      sorted.boundary.push_back(e);
  }
  return sorted;
}

/// The edges of a relaxed mesh as chains of its edges at another level.
class EdgeLines {
 public:
  EdgeLines(const relax::RelaxedMesh& relaxed, int drawn_level)
      : relaxed_(relaxed), drawn_level_(static_cast<std::size_t>(drawn_level)) {}

  Lines draw(int level, const std::vector<std::uint32_t>& edges, Pixel colour, float width) const {
    Lines lines{colour, width, {}};
    for (std::uint32_t e : edges) append(static_cast<std::size_t>(level), e, lines);
    return lines;
  }

  Lines draw_all(int level, Pixel colour, float width) const {
    Lines lines{colour, width, {}};
    const std::size_t count = relaxed_.levels[static_cast<std::size_t>(level)].edges.size();
    for (std::uint32_t e = 0; e < count; ++e) append(static_cast<std::size_t>(level), e, lines);
    return lines;
  }

 private:
  // The halves of edge e are 3 F + 2 e + {0, 1} of the next level.
  void append(std::size_t level, std::uint32_t e, Lines& lines) const {
    const relax::SubdividedLevel& here = relaxed_.levels[level];
    if (level == drawn_level_) {
      const auto [a, b] = here.edges[e];
      lines.segments.push_back({relaxed_.mesh.positions[a], relaxed_.mesh.positions[b]});
      return;
    }
    const std::uint32_t first = 3 * static_cast<std::uint32_t>(here.triangles.size()) + 2 * e;
    append(level + 1, first, lines);
    append(level + 1, first + 1, lines);
  }

  const relax::RelaxedMesh& relaxed_;
  std::size_t drawn_level_;
};

Lines corner_dots(const relax::RelaxedMesh& relaxed, Pixel colour, float width) {
  Lines dots{colour, width, {}};
  for (std::uint32_t v : relaxed.mesh.base.corner_vertices)
    dots.segments.push_back({relaxed.mesh.positions[v], relaxed.mesh.positions[v]});
  return dots;
}

// Creases, boundary and corners, bold, and what they mean.
void add_features(const relax::RelaxedMesh& relaxed, const BaseEdges& edges, const EdgeLines& lines,
                  std::vector<Lines>& layers, picture::FigureText& text) {
  if (!edges.creases.empty()) {
    layers.push_back(lines.draw(0, edges.creases, kCrease, kFeature));
    text.key.push_back({kCrease, kFeature, counted(edges.creases.size(), "crease edges")});
  }
  if (!edges.boundary.empty()) {
    layers.push_back(lines.draw(0, edges.boundary, kBoundary, kFeature));
    text.key.push_back({kBoundary, kFeature, counted(edges.boundary.size(), "boundary edges")});
  }
  const std::size_t corners = relaxed.mesh.base.corner_vertices.size();
  if (corners > 0) {
    layers.push_back(corner_dots(relaxed, kCorner, kDot));
    layers.push_back(corner_dots(relaxed, kCornerCore, kDotCore));
    text.key.push_back(
        {kCornerCore, kDot, counted(corners, corners == 1 ? "corner" : "corners"), true});
  }
}

int line_level(const relax::RelaxedMesh& relaxed) {
  int level = 0;
  while (level < relaxed.mesh.levels &&
         relaxed.levels[static_cast<std::size_t>(level) + 1].triangles.size() <= kMostDrawnFaces)
    ++level;
  return level;
}

// Of each vertex, relative to the diagonal of the input.
std::vector<double> relative_distances(const PictureSubject& subject, const TriangleMesh& mesh) {
  std::vector<double> distances(mesh.positions.size());
  const auto measure = [&](const tbb::blocked_range<std::size_t>& range) {
    std::uint32_t hint = measure::SurfacePoint::no_triangle;
    for (std::size_t v = range.begin(); v < range.end(); ++v) {
      const measure::SurfacePoint nearest = subject.original.closest(mesh.positions[v], hint);
      hint = nearest.triangle;
      distances[v] = std::sqrt(nearest.distance_squared) / subject.report.diagonal;
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, distances.size(), 1024), measure);
  return distances;
}

// So much of the values is not above it.
double quantile(std::vector<double> values, double share) {
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

// From 0 in steps of 1, 2 or 5 times a power of ten, at most six of them, up to `top`.
std::vector<picture::RampTick> round_ticks(double top) {
  double step = std::pow(10.0, std::floor(std::log10(top)) - 1);
  for (int k = 0; top / step > 6; ++k) step *= k % 3 == 1 ? 2.5 : 2;
  std::vector<picture::RampTick> ticks;
  for (int i = 0; i * step <= top; ++i) ticks.push_back({i * step / top, rounded(i * step)});
  return ticks;
}

}  // namespace

std::string name_of(const PictureSubject& subject) {
  return std::filesystem::path(subject.report.input).filename().string();
}

Image draw_base(const PictureSubject& subject, const PictureView& view) {
  const relax::RelaxedMesh& relaxed = *subject.model.relaxed;
  TriangleMesh base;
  base.triangles = relaxed.mesh.base.triangles;
  base.positions.assign(relaxed.mesh.positions.begin(),
                        relaxed.mesh.positions.begin() + relaxed.mesh.base.vertex_count);
  const BaseEdges edges = sort_base_edges(relaxed);
  const EdgeLines lines(relaxed, 0);
  picture::FigureText text{"Base mesh", name_of(subject) + ": " +
                                            counted(base.positions.size(), "vertices, ") +
                                            counted(base.triangles.size(), "faces")};
  std::vector<Lines> layers{lines.draw(0, edges.plain, kEdge, kMiddle)};
  add_features(relaxed, edges, lines, layers, text);
  picture::RenderOptions flat = view.render;
  flat.flat = true;
  Image image = on_paper({&base}, view, flat);
  draw_lines(image, layers, base, view.camera);
  return picture::figure(image, text);
}

Image draw_parameter_lines(const PictureSubject& subject, const PictureView& view) {
  const relax::RelaxedMesh& relaxed = *subject.model.relaxed;
  const TriangleMesh mesh{relaxed.mesh.positions, relaxed.levels.back().triangles};
  const BaseEdges edges = sort_base_edges(relaxed);
  const EdgeLines lines(relaxed, relaxed.mesh.levels);
  const int level = line_level(relaxed);
  picture::FigureText text{"Parameter lines on the input",
                           name_of(subject) + ": relaxed mesh of level " +
                               std::to_string(relaxed.mesh.levels) + ", " +
                               counted(mesh.triangles.size(), "faces, with the edges of level ") +
                               std::to_string(level)};
  std::vector<Lines> layers;
  if (level > 0) {
    layers.push_back(lines.draw_all(level, kFineLine, kThin));
    text.key.push_back({kFineLine, kMiddle, "edges of level " + std::to_string(level)});
  }
  layers.push_back(lines.draw(0, edges.plain, kEdge, kBold));
  text.key.push_back({kEdge, kBold, "base edges"});
  add_features(relaxed, edges, lines, layers, text);
  Image image = on_paper({&mesh}, view, view.render);
  draw_lines(image, layers, mesh, view.camera);
  return picture::figure(image, text);
}

Image draw_error(const PictureSubject& subject, const TriangleMesh& limit,
                 const PictureView& view) {
  const std::vector<double> distances = relative_distances(subject, limit);
  const double top = std::max(quantile(distances, 0.99), 1e-12);
  picture::Model model{&limit};
  for (double d : distances) model.colours.push_back(picture::ramp_albedo(d / top));

  picture::FigureText text{"Distance of the remesh from the input",
                           name_of(subject) + ": RMS " +
                               rounded(subject.report.remeshing_error * 1e5) + ", largest " +
                               rounded(quantile(distances, 1.0) * 1e5) +
                               "; the ramp ends where 99 % of the vertices are nearer"};
  text.ramp_title = "distance in 1e-5 of the diagonal";
  text.ticks = round_ticks(top * 1e5);
  return picture::figure(on_paper(model, view, view.render), text);
}

}  // namespace zerotree::convert
