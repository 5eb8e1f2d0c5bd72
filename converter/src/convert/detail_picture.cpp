#include "convert/detail_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "picture/colour_ramp.h"
#include "picture/comparison_sheet.h"
#include "picture/figure.h"

namespace zerotree::convert {
namespace {

using Energies = std::vector<double>;

constexpr int kPanelWidth = 400;  // with the space around it
constexpr int kSheetWidth = 960;  // at least
constexpr double kMostDecades = 5;

enum class Part { normal, tangential };

double energy(const Eigen::Vector3d& detail, Part part) {
  return part == Part::normal ? detail[0] * detail[0] : detail.tail<2>().squaredNorm();
}

// The decades that the colours stand for, of lengths relative to the diagonal.
struct LogScale {
  double low, high;

  double share(double squared_length) const {
    return (0.5 * std::log10(std::max(squared_length, 1e-300)) - low) / (high - low);
  }
};

// From a third of the smallest RMS to four times the largest one.
LogScale scale_of(const std::vector<report::LevelDetails>& levels) {
  double least = 1, most = 0;
  for (const report::LevelDetails& level : levels)
    for (double rms : {level.normal, level.tangential}) {
      if (rms > 0) least = std::min(least, rms);
      most = std::max(most, rms);
    }
  if (most <= 0) return {-7, -2};
  const double high = std::ceil(std::log10(4 * most));
  return {std::max(std::floor(std::log10(least / 3)), high - kMostDecades), high};
}

// Of every vertex of level `level` + 1: that of its detail; old vertices get the mean around them.
Energies energies_of_level(const PictureSubject& subject, std::size_t level, Part part) {
  const relax::SubdividedLevel& coarse = subject.model.relaxed->levels[level];
  const std::vector<Eigen::Vector3d>& details = subject.local_details[level];
  const double unit = subject.report.diagonal * subject.report.diagonal;
  Energies energies(coarse.vertex_count + coarse.edges.size(), 0.0);
  std::vector<int> neighbours(coarse.vertex_count, 0);
  for (std::size_t e = 0; e < coarse.edges.size(); ++e) {
    const double own = energy(details[e], part) / unit;
    energies[coarse.vertex_count + e] = own;
    for (std::uint32_t v : coarse.edges[e]) {
      energies[v] += own;
      ++neighbours[v];
    }
  }
  for (std::size_t v = 0; v < coarse.vertex_count; ++v) energies[v] /= std::max(1, neighbours[v]);
  return energies;
}

// Goes on to the finest level, halfway between the ends of each edge.
void interpolate_to_finest(const relax::RelaxedMesh& relaxed, std::size_t level,
                           Energies& energies) {
  for (; level < static_cast<std::size_t>(relaxed.mesh.levels); ++level)
    for (const auto& [a, b] : relaxed.levels[level].edges)
      energies.push_back(0.5 * (energies[a] + energies[b]));
}

std::string caption_of(const report::LevelDetails& level, int number, Part part) {
  char text[96];
  if (part == Part::normal) {
    std::snprintf(text, sizeof text, "level %d\nnormal %.3g", number, level.normal * 1e5);
  } else {
    const double ratio = level.normal > 0 ? level.tangential / level.normal : 0;
    std::snprintf(text, sizeof text, "tangential %.3g\nenergy ratio %.3g", level.tangential * 1e5,
                  ratio * ratio);
  }
  return text;
}

std::string decade(double exponent) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", std::pow(10.0, exponent + 5));
  return text;
}

}  // namespace

picture::Image draw_details(const PictureSubject& subject, const TriangleMesh& limit,
                            const PictureView& view) {
  const std::vector<report::LevelDetails>& levels = subject.report.level_details;
  picture::FigureText text{"Details of each level",
                           name_of(subject) +
                               ": root mean squares in 1e-5 of the diagonal; energy ratio: "
                               "tangential by normal"};
  picture::SheetOptions sheet;
  sheet.columns = std::max(1, static_cast<int>(levels.size()));
  sheet.width = std::max(kSheetWidth, kPanelWidth * sheet.columns);
  picture::RenderOptions options = view.render;
  options.width = picture::panel_width(2 * sheet.columns, sheet);
  options.height = picture::panel_height(subject.input, options.width, options);
  const LogScale scale = scale_of(levels);
  std::vector<picture::CaptionedImage> panels;
  for (Part part : {Part::normal, Part::tangential})
    for (std::size_t level = 0; level < levels.size(); ++level) {
      Energies energies = energies_of_level(subject, level, part);
      interpolate_to_finest(*subject.model.relaxed, level + 1, energies);
      picture::Model model{&limit};
      for (double e : energies) model.colours.push_back(picture::ramp_albedo(scale.share(e)));
      panels.push_back({picture::render(model, view.camera, options),
                        caption_of(levels[level], static_cast<int>(level) + 1, part)});
    }
  if (panels.empty())
    return picture::figure(picture::paper(sheet.width, options.height),
                           {"Details of each level", "the base mesh has no finer levels"});
  text.ramp_title = "length of a detail in 1e-5 of the diagonal";
  const int decades = static_cast<int>(std::lround(scale.high - scale.low));
  for (int i = 0; i <= decades; ++i)
    text.ticks.push_back({static_cast<double>(i) / decades, decade(scale.low + i)});
  return picture::figure(picture::side_by_side(panels, sheet), text);
}

}  // namespace zerotree::convert
