#include <cstdio>
#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "convert/transform_choice.h"
#include "decode/prefix_surface.h"
#include "decode/stream_file.h"

namespace zerotree::cli {
namespace {

// `scale`: of the unit that the header counts lengths in.
void print_header(const bitstream::StreamHeader& header, double scale) {
  std::printf("  base           %u vertices, %u faces, %s%s\n", header.vertex_count,
              header.face_count, header.external_base ? "in the glTF accessors" : "embedded",
              header.has_sharp_tags ? ", with creases or corners" : "");
  std::printf("  levels         %d\n", header.levels);
  std::printf("  transform      %s\n",
              convert::transform_name(static_cast<surface::WaveletTransform>(header.transform)));
  std::printf("  bit planes     %d, finest step %g, tangential x %d\n", header.planes,
              scale * static_cast<double>(header.finest_step), 1 << header.tangent_ratio_log2);
  if (!header.external_base)
    std::printf("  embedded base  positions %d bits per coordinate, %d of them first\n",
                header.positions.bits, header.positions.initial_planes);
}

void print_levels(const bitstream::StreamDecoder& decoder) {
  std::uint64_t vertices = decoder.header().vertex_count, faces = decoder.header().face_count,
                edges = decoder.base_edges().size();
  std::printf("  %5s  %12s  %12s\n", "level", "vertices", "faces");
  for (int level = 0; level <= decoder.header().levels; ++level) {
    std::printf("  %5d  %12llu  %12llu\n", level, static_cast<unsigned long long>(vertices),
                static_cast<unsigned long long>(faces));
    vertices += edges;
    edges = 2 * edges + 3 * faces;
    faces *= 4;
  }
}

void print_prefixes(const decode::StreamFile& file) {
  if (file.prefixes.empty()) return;
  std::printf("  %12s  %s\n", "prefix bytes", "error (1e-4 of the diagonal)");
  for (const decode::MeasuredPrefix& prefix : file.prefixes)
    std::printf("  %12llu  %.3f\n", static_cast<unsigned long long>(prefix.bytes),
                prefix.error * 1e4);
}

void run_info(const std::filesystem::path& input) {
  const decode::StreamFile file = decode::open_stream_file(input);
  decode::PrefixSurface prefix(file);
  prefix.advance_to(file.bytes.size());
  const bitstream::StreamDecoder& decoder = prefix.decoder();
  std::printf("%s: %s of %zu bytes%s\n", input.string().c_str(),
              file.external_base ? "glTF payload" : "elementary stream", file.bytes.size(),
              decoder.status() == bitstream::DecodeStatus::done ? "" : ", cut off: a prefix");
  if (decoder.header_ready()) print_header(decoder.header(), file.placement.scale);
  if (decoder.base_ready()) print_levels(decoder);
  print_prefixes(file);
}

}  // namespace

void add_info(CLI::App& app, int& exit_code) {
  auto input = std::make_shared<std::filesystem::path>();
  CLI::App* command =
      app.add_subcommand("info", "Show what is inside: levels, counts, bytes and error per prefix");
  command->add_option("input", *input, "Progressive .glb/.gltf or elementary .zt")->required();
  command->callback([input, &exit_code] {
    run_info(*input);
    exit_code = 0;
  });
}

}  // namespace zerotree::cli
