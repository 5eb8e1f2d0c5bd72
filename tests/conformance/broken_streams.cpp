// Streams that are broken, by a right stream with some bytes replaced or by chosen decisions.
#include <initializer_list>
#include <stdexcept>
#include <utility>

#include "bitstream/base_connectivity_coding.h"
#include "bitstream/base_edges.h"
#include "bitstream/base_hash.h"
#include "bitstream/sharp_tag_coding.h"
#include "chosen_decisions.h"
#include "conformance_cases.h"
#include "encode/header_writer.h"
#include "stream_making.h"
#include "stream_shapes.h"

namespace zerotree::conformance {
namespace {

// Where the fields of a header are; those of an embedded base as in `embedded()`, whose origin
// takes a byte per coordinate.
constexpr std::size_t kKind = 2, kDepth = 3, kPlanes = 4, kStep = 6, kScale = 8, kOrigin = 9,
                      kVertices = 12, kExcess = 13;
constexpr std::size_t kStepOfExternal = 5, kHash = 7;

constexpr int kLevels = 1;

const StreamPlan& plan() {
  static const StreamPlan the_plan{.levels = kLevels, .detail_bits = {4}};
  return the_plan;
}

Bytes embedded() {
  return encode::encode_stream(
             embedded_content({"tetrahedron", test::tetrahedron(), {}, {}}, plan()))
      .bytes;
}

test::Shape octahedron() {
  return small_base(0, "octahedron");
}

Bytes external() {
  return encode::encode_stream(external_content(octahedron(), plan())).bytes;
}

/// `bytes` with `count` of them from `at` on replaced.
Bytes replaced(Bytes bytes, std::size_t at, std::size_t count,
               std::initializer_list<std::uint8_t> by) {
  const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  const auto place = bytes.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
  bytes.insert(place, by);
  return bytes;
}

class BrokenList {
 public:
  /// A stream with an embedded base.
  void embedded_case(const char* name, const char* rule, const char* complaint, Bytes bytes) {
    cases_.push_back({name, rule, complaint, {}, 0, std::move(bytes)});
  }
  /// A stream decoded with a base at hand.
  void external_case(const char* name, const char* rule, const char* complaint, Base base,
                     Bytes bytes, int levels = kLevels) {
    cases_.push_back({name, rule, complaint, std::move(base), levels, std::move(bytes)});
  }
  /// A stream with an embedded base of these counts and these decisions in its connectivity.
  void connectivity_case(const char* name, const char* rule, const char* complaint,
                         std::uint32_t vertices, std::uint32_t faces, std::string_view decisions);
  std::vector<BrokenCase> take() { return std::move(cases_); }

 private:
  std::vector<BrokenCase> cases_;
};

void BrokenList::connectivity_case(const char* name, const char* rule, const char* complaint,
                                   std::uint32_t vertices, std::uint32_t faces,
                                   std::string_view decisions) {
  bitstream::StreamHeader header;
  header.transform = 1;
  header.finest_step = 0x1p-9f;
  header.positions = {{-8, -8, -8}, 0x1p-9f, 10, 4};
  header.vertex_count = vertices;
  header.face_count = faces;
  Bytes bytes = encode::write_header(header);
  ChosenDecisions coder(decisions);
  bitstream::BaseTopology base;
  (void)bitstream::decode_base_connectivity(coder, {vertices, faces}, base);
  if (coder.starved() || coder.used() != decisions.size())
    throw std::logic_error(std::string(name) + ": not as many decisions as are asked for");
  const Bytes coded = coder.finish();
  bytes.insert(bytes.end(), coded.begin(), coded.end());
  bytes.insert(bytes.end(), 4, 0);
  embedded_case(name, rule, complaint, std::move(bytes));
}

void add_first_bytes(BrokenList& list) {
  const char* const not_ours = "this is not a Zerotree stream";
  const char* const other_version = "the stream has a format version this reader lacks";
  list.embedded_case("magic_1", "A.2 magic", not_ours, replaced(embedded(), 0, 1, {'z'}));
  list.embedded_case("magic_2", "A.2 magic", not_ours, replaced(embedded(), 1, 1, {'U'}));
  list.embedded_case("version_0", "A.2 version", other_version,
                     replaced(embedded(), kKind, 1, {0x40}));
  list.embedded_case("version_2", "A.2 version", other_version,
                     replaced(embedded(), kKind, 1, {0x42}));
  list.embedded_case("transform_2", "A.2 transform",
                     "the stream names wavelet transform 2, which this version lacks",
                     replaced(embedded(), kKind, 1, {0x81}));
  list.external_case("transform_3", "A.2 transform",
                     "the stream names wavelet transform 3, which this version lacks",
                     external_base(octahedron()), replaced(external(), kKind, 1, {0xd1}));
  list.embedded_case("levels_15", "A.2 levels", "the header's levels are out of range",
                     replaced(embedded(), kDepth, 1, {0x2f}));
}

void add_planes(BrokenList& list) {
  const char* const too_many_initial = "the header has more initial planes than position bits";
  const char* const bad_bits = "the header's position bits are out of range";
  // planes | position_bits << 5 | initial_planes << 10
  list.embedded_case("planes_31", "A.2 planes", "the header's bit planes are out of range",
                     replaced(embedded(), kPlanes, 2, {0x5f, 0x11}));
  list.embedded_case("planes_without_levels", "A.2 planes",
                     "the header has bit planes but no levels",
                     replaced(embedded(), kDepth, 1, {0x20}));
  list.embedded_case("position_bits_0", "A.2 position bits", bad_bits,
                     replaced(embedded(), kPlanes, 2, {0x04, 0x00}));
  list.embedded_case("position_bits_29", "A.2 position bits", bad_bits,
                     replaced(embedded(), kPlanes, 2, {0xa4, 0x13}));
  list.embedded_case("initial_planes_11", "A.2 initial planes", too_many_initial,
                     replaced(embedded(), kPlanes, 2, {0x44, 0x2d}));
  list.embedded_case("unnamed_bit", "A.2 zero bits", too_many_initial,
                     replaced(embedded(), kPlanes, 2, {0x44, 0x91}));
  list.external_case("unnamed_bit_external", "A.2 zero bits",
                     "the header has position planes but no base", external_base(octahedron()),
                     replaced(external(), kPlanes, 1, {0x24}));
}

void add_steps(BrokenList& list) {
  const char* const rule = "A.2 finest step";
  const char* const complaint = "the header's finest step is not positive";
  list.embedded_case("step_0", rule, complaint, replaced(embedded(), kStep, 2, {0, 0}));
  list.embedded_case("step_minus_0", rule, complaint, replaced(embedded(), kStep, 2, {0, 0x80}));
  list.embedded_case("step_negative", rule, complaint,
                     replaced(embedded(), kStep, 2, {0x80, 0xbf}));
  list.embedded_case("step_infinite", rule, complaint,
                     replaced(embedded(), kStep, 2, {0x80, 0x7f}));
  list.external_case("step_nan", rule, complaint, external_base(octahedron()),
                     replaced(external(), kStepOfExternal, 2, {0xc0, 0x7f}));
}

void add_positions(BrokenList& list) {
  const char* const bad_scale = "the header's position scale is out of range";
  const char* const malformed = "the header has a malformed number";
  list.embedded_case("scale_infinite", "A.2 scale", bad_scale,
                     replaced(embedded(), kStep, 3, {0x00, 0x7f, 0xff}));
  list.embedded_case("scale_0", "A.2 scale", bad_scale,
                     replaced(embedded(), kStep, 3, {0x01, 0x00, 0x00}));
  list.embedded_case("positions_infinite", "A.2 scale", "the header's positions are not finite",
                     replaced(embedded(), kStep, 3, {0x00, 0x6f, 0xff}));
  list.embedded_case("origin_33_bits", "A.2 origin", "the header's origin is out of range",
                     replaced(embedded(), kOrigin, 1, {0x80, 0x80, 0x80, 0x80, 0x10}));
  list.embedded_case("number_of_6_bytes", "A.2 varint", malformed,
                     replaced(embedded(), kOrigin, 1, {0x81, 0x80, 0x80, 0x80, 0x80, 0x01}));
  list.embedded_case("origin_not_shortest", "A.2 varint", malformed,
                     replaced(embedded(), kOrigin, 1, {0x8f, 0x00}));
}

void add_counts(BrokenList& list) {
  const char* const bad_faces = "the header's face count is out of range";
  list.embedded_case("vertices_not_shortest", "A.2 varint", "the header has a malformed number",
                     replaced(embedded(), kVertices, 1, {0x84, 0x00}));
  list.embedded_case("vertices_2", "A.2 counts", "the header has fewer than 3 base vertices",
                     replaced(embedded(), kVertices, 2, {2, 2}));
  list.embedded_case("vertices_beyond_3F", "A.2 counts",
                     "the header has more base vertices than base faces can use",
                     replaced(embedded(), kVertices, 2, {4, 5}));
  list.embedded_case("faces_0", "A.2 counts", bad_faces, replaced(embedded(), kExcess, 1, {7}));
  list.embedded_case(
      "faces_2_30", "A.2 counts", bad_faces,
      replaced(embedded(), kVertices, 2, {0x82, 0x80, 0x80, 0x80, 0x02, 0}));  // V = 2^29 + 2
  // 2^29 faces of 14 levels: 2^57 vertices.
  list.embedded_case("beyond_limits", "A.2 limits", "the stream has more vertices than the limit",
                     replaced(replaced(embedded(), kVertices, 2, {0x82, 0x80, 0x80, 0x80, 0x01, 0}),
                              kDepth, 1, {0x2e}));
}

/// A stream without details with the hash of this base.
Bytes bound_to(const Base& base) {
  Bytes bytes = encode::encode_stream(external_content(octahedron(), {.levels = 0})).bytes;
  const std::uint32_t hash = bitstream::hash_base(base.topology, base.positions);
  for (std::size_t i = 0; i < 4; ++i) bytes[kHash + i] = static_cast<std::uint8_t>(hash >> (8 * i));
  return bytes;
}

void add_bases(BrokenList& list) {
  const char* const rule = "A.2 hash";
  const char* const other = "the base mesh given is not the one that the stream was made for";
  const Base base = external_base(octahedron());
  list.external_case("hash", rule, other, base, replaced(external(), kHash + 1, 1, {0xff}));
  Base moved = base;
  moved.name = "octahedron_moved";
  moved.positions[4] = 1.0000001f;  // the next float
  list.external_case("base_moved", rule, other, moved, external());
  Base turned = base;
  turned.name = "octahedron_turned";
  turned.topology.triangles[2] = {turned.topology.triangles[2][1], turned.topology.triangles[2][2],
                                  turned.topology.triangles[2][0]};
  list.external_case("base_turned", rule, other, turned, external());
  list.external_case("other_levels", "README levels",
                     "the stream has 1 levels where 2 were announced", base, external(), 2);
  list.external_case("embedded_for_base", "A.2 base",
                     "the stream has a base mesh of its own, yet one was given", base, embedded());
  list.embedded_case("external_without_base", "A.2 base",
                     "the stream has no base mesh of its own and none was given", external());
  // The hash is right, so it is the base that breaks a rule.
  const Base fins{"three_at_an_edge",
                  {5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, {}, {}},
                  {base.positions.begin(), base.positions.begin() + 15}};
  list.external_case("base_three_at_an_edge", "A.4 base", "base face 2 is the third at one edge",
                     fins, bound_to(fins), 0);
  Base flipped = base;
  flipped.name = "face_turned_over";
  std::swap(flipped.topology.triangles[2][0], flipped.topology.triangles[2][1]);
  list.external_case("base_face_turned_over", "A.4 base",
                     "base face 6 is oriented against its neighbour", flipped, bound_to(flipped),
                     0);
  const auto first_points = [&](std::ptrdiff_t count) {
    return std::vector<float>(base.positions.begin(), base.positions.begin() + 3 * count);
  };
  const Base bow{"two_fans_at_a_vertex", {5, {{0, 1, 2}, {0, 3, 4}}, {}, {}}, first_points(5)};
  list.external_case("base_two_fans", "A.4 base",
                     "the base mesh given: a vertex has more than one fan of triangles", bow,
                     bound_to(bow), 0);
  const Base spare{"vertex_without_triangle", {4, {{0, 1, 3}}, {}, {}}, first_points(4)};
  list.external_case("base_unused_vertex", "A.4 base",
                     "the base mesh given: a vertex is in no triangle", spare, bound_to(spare), 0);
  const Base beyond{"corner_beyond", {3, {{0, 1, 3}}, {}, {}}, first_points(3)};
  list.external_case("base_corner_beyond", "A.4 base",
                     "base face 0 names a vertex that does not exist", beyond, bound_to(beyond), 0);
}

void add_connectivity(BrokenList& list) {
  const char* const rule_1 = "A.12 vertices";
  const char* const rule_2 = "A.12 action";
  const char* const rule_3 = "A.13 edge";
  const char* const rule_4 = "A.13 fan";
  const char* const cannot = "base connectivity: a gate joins where it cannot";
  const char* const fans = "base connectivity: a vertex has more than one fan of triangles";
  const char* const sides = "base connectivity: an edge has more than one triangle on a side";
  const char* const twice = "base connectivity: a triangle has a vertex twice";
  list.connectivity_case("too_few_vertices_for_seed", rule_1,
                         "base connectivity: there are too few vertices", 5, 5, "00111");
  list.connectivity_case("vertices_not_made", rule_1,
                         "base connectivity: fewer vertices are made than announced", 5, 4,
                         "00111");
  list.connectivity_case("join_dead_node", rule_2, cannot, 7, 10, "001100010");
  list.connectivity_case("join_missing_node", rule_2, cannot, 7, 10, "000011");
  list.connectivity_case("join_own_node", rule_2, cannot, 7, 10, "000001");
  list.connectivity_case("join_near_neighbour", rule_2, cannot, 3, 2, "00100");
  list.connectivity_case("edge_twice_in_a_direction", rule_3, sides, 4, 3, "00101");
  list.connectivity_case("edge_twice_open", rule_3, sides, 4, 3, "110101");
  list.connectivity_case("two_fans", rule_4, fans, 6, 6, "0010110100110");
  list.connectivity_case("two_fans_open", rule_4, fans, 6, 3, "1111100010");
  list.connectivity_case("vertex_twice", "A.13 corners", twice, 8, 10, "0101010011000011010101");
  list.connectivity_case("vertex_twice_open", "A.13 corners", twice, 6, 5, "11111000000110101");
  list.connectivity_case("boundary_not_announced", "A.13 boundary",
                         "base connectivity: a closed base mesh has boundary edges", 3, 1, "0");
}

// The header announces tags, and then each is "no".
Bytes tags_without_tag(bool is_external) {
  const encode::StreamContent content =
      is_external ? external_content(octahedron(), {.levels = 0})
                  : embedded_content({"tetrahedron", test::tetrahedron(), {}, {}}, {.levels = 0});
  bitstream::StreamHeader header = content.header;
  header.has_sharp_tags = true;
  header.vertex_count = content.base.vertex_count;
  header.face_count = static_cast<std::uint32_t>(content.base.triangles.size());
  Bytes bytes = encode::write_header(header);
  encode::RangeEncoder coder;
  if (!is_external) (void)bitstream::encode_base_connectivity(coder, content.base);
  const bitstream::BaseEdges edges = bitstream::number_base_edges(content.base);
  bitstream::SharpTagCoding(edges.edges, content.base.vertex_count).code(coder);
  const Bytes coded = coder.finish();
  bytes.insert(bytes.end(), coded.begin(), coded.end());
  return bytes;
}

void add_tags(BrokenList& list) {
  const char* const rule = "A.6.1 tags";
  const char* const complaint = "the header announces sharp tags, but there are none";
  list.embedded_case("no_tag", rule, complaint, tags_without_tag(false));
  list.external_case("no_tag_external", rule, complaint, external_base(octahedron()),
                     tags_without_tag(true), 0);
}

}  // namespace

std::vector<BrokenCase> broken_cases() {
  BrokenList list;
  add_first_bytes(list);
  add_planes(list);
  add_steps(list);
  add_positions(list);
  add_counts(list);
  add_bases(list);
  add_connectivity(list);
  add_tags(list);
  return list.take();
}

}  // namespace zerotree::conformance
