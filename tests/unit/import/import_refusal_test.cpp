// Every way to be no mesh: refused with exit code 3 and a sentence that names file and place.
#include <gtest/gtest.h>

#include "mesh/error.h"
#include "mesh_file_bytes.h"
#include "shapes.h"

namespace zerotree::test {
namespace {

struct Refusal {
  std::string name;  // of the file
  std::string bytes;
  std::vector<std::string> said;  // parts of the message, beside the file's name
};

std::string ply(const std::string& body, const std::string& counts = "3 1") {
  const std::size_t space = counts.find(' ');
  return "ply\nformat ascii 1.0\nelement vertex " + counts.substr(0, space) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
         counts.substr(space + 1) + "\nproperty list uchar int vertex_indices\nend_header\n" + body;
}

std::vector<Refusal> refusals() {
  const std::string three = "0 0 0\n1 0 0\n0 1 0\n";
  return {
      {"empty.ply", "", {"empty"}},
      {"empty.obj.gz", gzipped(""), {"empty"}},
      {"blank.obj", "# nothing\n\n", {"no vertices and no faces"}},
      {"points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", {"no faces"}},
      {"points.ply", ply(three, "3 0"), {"no faces"}},
      {"unknown.xyz", "0 0 0\n", {"no known format"}},
      {"no_header_end.ply", "ply\nformat ascii 1.0\n", {"line 3", "end_header"}},
      {"no_format.ply", "ply\nend_header\n", {"line 2", "format"}},
      {"type.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n", {"line 4"}},
      {"lying.ply", ply(three + "3 0 1 2\n", "3000000000 1"), {"3000000000", "truncated"}},
      {"short.ply", ply("0.00 0.00 0.00\n1.00 0.00 0.00\n0 1"), {"line 12", "ends"}},
      {"index.ply", ply(three + "3 0 1 3\n"), {"line 13", "vertex 3"}},
      {"minus.ply", ply(three + "3 0 -1 2\n"), {"line 13", "vertex -1"}},
      {"nan.ply", ply("0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"), {"line 11", "not a finite number"}},
      {"inf.obj", "v 0 0 1e999\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", {"line 1", "finite"}},
      {"word.obj", "v 0 0 zero\n", {"line 1", "\"zero\""}},
      {"index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n", {"line 5", "vertex 4"}},
      {"zero.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", {"line 4", "vertex 0"}},
      {"back.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -4 1 2\n", {"line 4", "vertex -4"}},
      {"flat.obj", "v 0 0\n", {"line 1", "fewer than 3"}},
      {"lying.off", "OFF\n999999999999 1 0\n" + three, {"line 2", "999999999999"}},
      {"index.off", "OFF\n3 1 0\n" + three + "3 0 1 3\n", {"line 6", "vertex 3"}},
      {"short.off", "OFF\n3 2 0\n" + three + "3 0 1 2\n", {"ends"}},
      {"binary.off", "OFF BINARY\n", {"binary OFF"}},
      {"four.off", "4OFF\n3 1 0\n", {"4OFF"}},
      {"short.stl", stl_binary_bytes(icosahedron()).substr(0, 500), {"byte 500", "20 facets"}},
      {"tiny.stl", "abc", {"84 bytes"}},
      {"cut.stl", "solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\n", {"inside a facet"}},
      {"quad.stl", "solid a\nfacet\nvertex 0 0 0\nvertex 0 0 0\nendfacet\n", {"2 corners"}},
      {"broken.gz", gzipped(obj_bytes(icosahedron())).substr(0, 60), {"gzip", "ends early"}},
      {"broken.drc", draco_bytes(icosahedron()).substr(0, 40), {"Draco"}},
  };
}

TEST(Refusal, NamesFileAndPlaceAndEndsInCodeThree) {
  for (const Refusal& refusal : refusals()) {
    SCOPED_TRACE(refusal.name);
    try {
      import_bytes(refusal.name, refusal.bytes);
      ADD_FAILURE() << "was read";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::unreadable_input);
      const std::string message = error.what();
      EXPECT_NE(message.find(refusal.name), std::string::npos) << message;
      for (const std::string& part : refusal.said)
        EXPECT_NE(message.find(part), std::string::npos) << part << " is not in: " << message;
    }
  }
}

TEST(Refusal, OfWhatIsNoFile) {
  EXPECT_THROW(importer::import_mesh("does/not/exist.ply", {}, {}), Error);
  EXPECT_THROW(importer::import_mesh(testing::TempDir(), {}, {}), Error);
}

TEST(Refusal, OfMoreThanTheLimits) {
  importer::ImportOptions options;
  options.max_decoded_bytes = 1000;
  const auto path = write_temporary("bomb.obj.gz", gzipped(std::string(100'000, '\n')));
  EXPECT_THROW(importer::import_mesh(path, options, {}), Error);
  options = {};
  options.max_polygon_corners = 5;
  const auto polygon = write_temporary(
      "six.obj", "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 2 0\nv -1 1 0\nf 1 2 3 4 5 6\n");
  EXPECT_THROW(importer::import_mesh(polygon, options, {}), Error);
  options.max_polygon_corners = 6;
  EXPECT_EQ(importer::import_mesh(polygon, options, {}).mesh.triangles.size(), 4u);
}

}  // namespace
}  // namespace zerotree::test
