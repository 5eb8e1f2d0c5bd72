#include "convert/debug_pictures.h"

#include <string>
#include <system_error>

#include "convert/detail_picture.h"
#include "convert/limit_mesh.h"
#include "convert/remesh_pictures.h"
#include "export/atomic_file.h"
#include "mesh/error.h"
#include "picture/comparison_sheet.h"
#include "picture/image.h"

namespace zerotree::convert {
namespace {

constexpr int kWidth = 1200;

// One camera for all, so that places can be found again from picture to picture.
PictureView view_of(const TriangleMesh& input, int threads) {
  PictureView view;
  view.render.width = kWidth;
  view.render.threads = threads;
  view.render.ground_shadow = false;
  view.render.supersampling = 2;
  view.render.even_light = true;
  view.render.height = picture::panel_height(input, kWidth, view.render);
  view.camera = picture::choose_camera(input, view.render);
  return view;
}

}  // namespace

void make_picture_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error && std::filesystem::is_directory(folder, error)) return;
  throw Error(ExitCode::usage, "cannot make the folder " + folder.string() +
                                   " for --debug-pictures" +
                                   (error ? ": " + error.message() : std::string()));
}

void write_debug_pictures(const std::filesystem::path& folder, const PictureSubject& subject,
                          int threads, const Progress& progress) {
  const PictureView view = view_of(subject.input, threads);
  const TriangleMesh limit = limit_mesh(subject.model);
  const auto write = [&](const char* name, double share, const auto& draw) {
    report_progress(progress, "drawing pictures", share);
    exporter::write_file_atomically(folder / name, picture::png_bytes(draw()));
  };
  write("base.png", 0.0, [&] { return draw_base(subject, view); });
  write("parameter-lines.png", 0.2, [&] { return draw_parameter_lines(subject, view); });
  write("error.png", 0.4, [&] { return draw_error(subject, limit, view); });
  write("detail-energy.png", 0.6, [&] { return draw_details(subject, limit, view); });
}

}  // namespace zerotree::convert
