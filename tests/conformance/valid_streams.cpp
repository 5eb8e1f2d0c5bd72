// The valid streams, each with what it is there for.
#include <stdexcept>
#include <utility>

#include "bitstream/base_traversal.h"
#include "bitstream/stream_header.h"
#include "conformance_cases.h"
#include "encode/header_writer.h"
#include "stream_making.h"
#include "stream_shapes.h"

namespace zerotree::conformance {
namespace {

using encode::StreamContent;
using Shows = std::vector<std::string>;

constexpr std::size_t kExternalHeader = 11;  // bytes

constexpr auto kMirror = surface::WaveletTransform::loop_quadrature_mirror;

test::Shape base_shape(const std::string& name) {
  for (test::Shape& shape : test::base_shapes())
    if (shape.name == name) return std::move(shape);
  throw std::invalid_argument("no base shape " + name);
}

class CaseList {
 public:
  StreamCase& embedded(const std::string& name, Shows shows, const test::Shape& shape,
                       const StreamPlan& plan, Cuts cuts = Cuts::whole) {
    return add(make_case(name, std::move(shows), embedded_content(shape, plan), cuts));
  }
  StreamCase& external(const std::string& name, Shows shows, const test::Shape& shape,
                       const StreamPlan& plan, Cuts cuts = Cuts::whole) {
    return add(make_case(name, std::move(shows), external_content(shape, plan), cuts, &shape));
  }
  StreamCase& add(StreamCase one) { return cases_.emplace_back(std::move(one)); }
  std::vector<StreamCase> take() { return std::move(cases_); }

 private:
  std::vector<StreamCase> cases_;
};

/// The stream of EXAMPLE.md.
StreamContent example() {
  StreamContent content;
  const TriangleMesh mesh = test::tetrahedron();
  const bitstream::BaseTopology base{4, mesh.triangles, {}, {}};
  content.base = bitstream::reorder(base, bitstream::canonical_base_order(base));
  content.header.transform = 1;
  content.header.levels = 1;
  content.header.finest_step = 0.0625f;
  content.header.positions = {{-8, -8, -8}, 0.125f, 5, 3};
  content.positions = {27, 27, 27, 27, 4, 4, 4, 27, 4, 4, 6, 27};
  content.coefficients = {
      6, 1, {{{11, 9, 21, 13, 0, 15}, {0, 0, 5, 0, 0, 0}, {0, -3, 0, 0, 0, 0}}}};
  return content;
}

// Connectivity, tags and surfaces of every class of base.
void add_bases(CaseList& list) {
  list.add(make_case("tetrahedron", {"the stream of EXAMPLE.md", "cut at every awkward place"},
                     example(), Cuts::every));
  list.embedded("icosahedron", {"closed", "levels 2", "normals"}, base_shape("icosahedron"),
                {.detail_bits = {8, 6}}, Cuts::some)
      .with_normals = true;
  list.embedded("grid", {"boundary", "levels 2", "normals"}, base_shape("grid"),
                {.detail_bits = {7, 5}}, Cuts::half)
      .with_normals = true;
  list.embedded("cube", {"creases that end in corners", "normals"}, base_shape("cube"),
                {.detail_bits = {6, 4}}, Cuts::some)
      .with_normals = true;
  list.embedded("crease_circle", {"a closed crease", "cut at every awkward place"}, crease_circle(),
                {.detail_bits = {8, 6}}, Cuts::every);
  const Shows kinds = {"darts", "a crease that meets the boundary", "a closed crease",
                       "three creases in a vertex", "corners: smooth, on a boundary, on a crease"};
  list.embedded("crease_grid", kinds, crease_grid(), {.detail_bits = {7, 5}}, Cuts::half);
  list.embedded("crease_grid_mirror", kinds, crease_grid(),
                {.transform = kMirror, .detail_bits = {7, 5}});
  list.embedded("many_valences", {"valence 3, 4, 5, 8 and 12", "four components"}, many_valences(),
                {.detail_bits = {6, 4}});
  list.embedded("many_valences_mirror", {"valence 3, 4, 5, 8 and 12, transform 0"}, many_valences(),
                {.transform = kMirror, .detail_bits = {6, 4}});
  list.embedded("double_torus", {"genus 2", "JOIN, near and far"}, base_shape("double_torus"),
                {.levels = 1, .detail_bits = {6}}, Cuts::some);
  list.embedded("two_components", {"a closed component and one with a boundary"},
                base_shape("two_components"), {.levels = 1, .detail_bits = {5}}, Cuts::some);
  list.embedded("holes", {"several boundary loops", "transform 0"}, wild_sphere(1, 3, 0, 1),
                {.levels = 1, .transform = kMirror, .detail_bits = {6}});
  list.embedded("wild_closed", {"valence 3 to 14", "connectivity of a closed base", "levels 0"},
                wild_sphere(2, 0, 0, 7), {.levels = 0});
  list.embedded("wild_open", {"many boundary loops", "tags at random", "levels 0"},
                wild_sphere(2, 40, 0.2, 8), {.levels = 0});
  list.embedded("wild_ragged", {"more boundary than surface", "levels 0"}, wild_sphere(1, 20, 0, 1),
                {.levels = 0});
  list.embedded("wild_torn", {"triangles that hang together by edges", "levels 0"},
                wild_sphere(1, 150, 0, 1), {.levels = 0});
  list.embedded("rings", {"JOIN over every length of near distances"},
                rings({3, 4, 5, 6, 9, 12, 17, 34, 66, 131, 258}),
                {.levels = 0, .position_bits = 9});
  list.embedded("long_ring", {"JOIN farther than 512 steps in one loop"}, rings({520}),
                {.levels = 0, .position_bits = 8});
}

// The header's fields.
void add_fields(CaseList& list) {
  const test::Shape tetrahedron = base_shape("tetrahedron");
  list.embedded("zero_details", {"planes 0", "initial_planes 0"}, tetrahedron,
                {.initial_planes = 0}, Cuts::every);
  list.embedded("all_positions_first", {"initial_planes = position_bits", "transform 0"},
                tetrahedron, {.transform = kMirror, .initial_planes = 10, .detail_bits = {6, 5}},
                Cuts::every);
  list.embedded("one_bit", {"position_bits 1", "tangent_ratio_log2 0"}, tetrahedron,
                {.levels = 1,
                 .tangent_ratio_log2 = 0,
                 .position_bits = 1,
                 .initial_planes = 0,
                 .detail_bits = {6}},
                Cuts::half);
  list.embedded("many_bits", {"position_bits 24", "tangent_ratio_log2 3"},
                base_shape("icosahedron"),
                {.levels = 1,
                 .tangent_ratio_log2 = 3,
                 .position_bits = 24,
                 .initial_planes = 3,
                 .detail_bits = {6}},
                Cuts::some);
  list.embedded("most_bits", {"position_bits 28", "tangent_ratio_log2 15"}, tetrahedron,
                {.levels = 2,
                 .finest_step = 0x1p-21,
                 .tangent_ratio_log2 = 15,
                 .position_bits = 28,
                 .initial_planes = 28,
                 .detail_bits = {4, 2}});
  list.embedded("large_planes", {"24 planes: values of more than 16 bits at the finest levels"},
                base_shape("tetrahedron"), {.finest_step = 0x1p-26, .detail_bits = {24, 22}},
                Cuts::some);
  list.embedded("most_planes", {"30 planes"}, base_shape("tetrahedron"),
                {.levels = 1, .finest_step = 0x1p-33, .detail_bits = {30}}, Cuts::some);
  list.embedded(
      "four_levels", {"levels 4"}, tetrahedron,
      {.levels = 4, .finest_step = 0x1p-10, .detail_bits = {10, 8, 6, 4}, .per_mille = 300},
      Cuts::half);
  list.embedded("three_levels", {"levels 3", "many details: crowded contexts", "transform 0"},
                base_shape("icosahedron"),
                {.levels = 3,
                 .transform = kMirror,
                 .finest_step = 0x1p-11,
                 .detail_bits = {10, 8, 6},
                 .per_mille = 900});
  list.embedded("finest_only", {"details of the finest level alone: deep trees"}, tetrahedron,
                {.levels = 3, .detail_bits = {0, 0, 4}, .per_mille = 60}, Cuts::some);
  list.embedded("coarsest_only", {"details of the coarsest level alone"}, tetrahedron,
                {.levels = 3, .detail_bits = {8, 0, 0}}, Cuts::some);
  list.embedded(
      "five_levels", {"levels 5", "few details in many planes"},
      {"square", test::grid(1, 1), {}, {}},
      {.levels = 5, .finest_step = 0x1p-16, .detail_bits = {16, 15, 13, 12, 10}, .per_mille = 60});
  list.embedded("six_levels", {"levels 6", "one triangle", "trees of height 5"}, triangle(),
                {.levels = 6,
                 .finest_step = 0x1p-13,
                 .detail_bits = {12, 11, 10, 9, 8, 6},
                 .per_mille = 100});
}

/// A triangle far away in units of its own size: corners stay where they are, so nothing is lost.
StreamContent far_triangle() {
  StreamContent content = embedded_content(triangle(), {.levels = 0});
  content.header.positions.origin = {2147483647, -2147483647 - 1, 70000};
  return content;
}

/// All points in one but for the last three: neighbours foretell nearly all.
StreamContent one_point() {
  StreamContent content = embedded_content(stellated_sphere(), {.levels = 0});
  const std::size_t count = content.positions.size();
  for (std::size_t i = 0; i < count; ++i)
    content.positions[i] = i < count - 9 ? 512 : static_cast<std::uint32_t>(480 + i * i % 64);
  return content;
}

/// A register of ones only, which no encoder writes: all decisions are 0.
StreamCase all_ones() {
  const test::Shape shape = small_base(0, "octahedron");
  StreamCase one =
      make_case("all_ones", {"a code not below the range: all decisions are 0"},
                external_content(shape, {.levels = 1, .detail_bits = {6}}), Cuts::whole, &shape);
  for (std::size_t i = kExternalHeader; i < one.bytes.size(); ++i) one.bytes[i] = 0xff;
  // Two bytes of coded decisions are all there is to the sequence.
  one.prefixes = {kExternalHeader + 2, kExternalHeader + 4, one.bytes.size()};
  return one;
}

/// One triangle whose last decision needs no more than the byte before the last.
StreamCase early_end() {
  StreamCase early{"early_end", {"done one byte before the end", "levels 0"}, 0, {}, {}, {}, false};
  early.bytes = {0x5a, 0x54, 0x01, 0x00, 0x80, 0x00, 0x00, 0x3c, 0x80, 0x00,
                 0x00, 0x00, 0x03, 0x01, 0x4b, 0xff, 0xff, 0x34, 0xa9};
  early.prefixes = {17, 18, 19};
  return early;
}

void add_contexts(CaseList& list) {
  list.add(make_case("one_point", {"every context of the positions", "levels 0"}, one_point(),
                     Cuts::whole));
  list.add(all_ones());
  list.add(early_end());
  list.embedded("large_weight", {"area weight at its cap: coarse details far longer than the base"},
                base_shape("tetrahedron"),
                {.levels = 2, .finest_step = 0x1p-3, .detail_bits = {11, 6}}, Cuts::some);
  // Finer, the two sheets lie on each other and frames beside the base vertices are rounding (B.9).
  list.embedded("pillow", {"valence 2"},
                {"pillow", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}}, {{0, 1, 2}, {2, 1, 0}}}, {}, {}},
                {.levels = 1, .detail_bits = {6}}, Cuts::some);
}

void add_origins(CaseList& list) {
  list.add(make_case("far_triangle", {"origin of 3 to 5 bytes", "levels 0", "one triangle"},
                     far_triangle(), Cuts::every));
  test::Shape moved = base_shape("tetrahedron");
  for (Eigen::Vector3d& p : moved.mesh.positions) p += Eigen::Vector3d(-9.5, 7, 0.25);
  list.embedded("moved", {"origin of 2 bytes, of either sign"}, moved,
                {.levels = 1, .detail_bits = {6}});
  test::Shape large = base_shape("tetrahedron");
  for (Eigen::Vector3d& p : large.mesh.positions) p *= 0x1p40;
  list.embedded("large", {"a scale of 2^31"}, large,
                {.levels = 1, .finest_step = 0x1p33, .detail_bits = {5}});
}

void add_external(CaseList& list) {
  list.external("bound_closed", {"external base, closed", "cut at every awkward place"},
                small_base(0, "octahedron"), {.detail_bits = {7, 5}}, Cuts::every);
  list.external("bound_open", {"external base with a boundary", "transform 0"},
                small_base(1, "open"), {.transform = kMirror, .detail_bits = {6, 4}}, Cuts::some);
  list.external("bound_components", {"external base of two components"},
                small_base(2, "components"), {.levels = 1, .detail_bits = {6}}, Cuts::some);
  list.external("bound_creases", {"external base with creases", "cut in its tags"},
                small_base(3, "creased"), {.detail_bits = {6, 4}}, Cuts::every);
  list.external("bound_levels_0", {"external base", "levels 0", "nothing coded"},
                small_base(0, "octahedron"), {.levels = 0}, Cuts::whole);
  test::Shape integers = base_shape("icosahedron");
  integers.name = "integers";
  for (Eigen::Vector3d& p : integers.mesh.positions) p = (4000 * p).array().round() + 4000;
  list.external("bound_integers", {"external base of integers, as KHR_mesh_quantization gives"},
                integers, {.levels = 1, .finest_step = 8, .detail_bits = {6}}, Cuts::some);
}

// Bytes after the end are ignored.
void add_trailing(CaseList& list) {
  StreamCase one = make_case(
      "trailing_bytes", {"five bytes after the end"},
      embedded_content(base_shape("tetrahedron"), {.levels = 1, .detail_bits = {4}}), Cuts::whole);
  const std::size_t end = one.bytes.size();
  one.bytes.insert(one.bytes.end(), {0xff, 0x00, 'Z', 'T', 0x80});
  one.prefixes = {end - 1, end, end + 1, end + 5};
  list.add(std::move(one));
}

}  // namespace

std::vector<StreamCase> stream_cases() {
  CaseList list;
  add_bases(list);
  add_fields(list);
  add_contexts(list);
  add_origins(list);
  add_external(list);
  add_trailing(list);
  return list.take();
}

}  // namespace zerotree::conformance
