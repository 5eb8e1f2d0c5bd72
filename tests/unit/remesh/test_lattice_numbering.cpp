#include <gtest/gtest.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <memory>
#include <set>

#include "remesh/lattice_numbering.h"
#include "shapes.h"

namespace zerotree::remesh {
namespace {

namespace Far = OpenSubdiv::Far;

std::unique_ptr<Far::TopologyRefiner> refine(const bitstream::BaseTopology& base, int levels) {
  using Descriptor = Far::TopologyDescriptor;
  std::vector<int> sizes(base.triangles.size(), 3), corners;
  for (const Triangle& t : base.triangles)
    for (std::uint32_t v : t) corners.push_back(static_cast<int>(v));
  Descriptor descriptor;
  descriptor.numVertices = static_cast<int>(base.vertex_count);
  descriptor.numFaces = static_cast<int>(sizes.size());
  descriptor.numVertsPerFace = sizes.data();
  descriptor.vertIndicesPerFace = corners.data();
  OpenSubdiv::Sdc::Options options;
  options.SetVtxBoundaryInterpolation(OpenSubdiv::Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
  std::unique_ptr<Far::TopologyRefiner> refiner(Far::TopologyRefinerFactory<Descriptor>::Create(
      descriptor,
      Far::TopologyRefinerFactory<Descriptor>::Options(OpenSubdiv::Sdc::SCHEME_LOOP, options)));
  Far::TopologyRefiner::UniformOptions uniform(levels);
  uniform.fullTopologyInLastLevel = true;
  refiner->RefineUniform(uniform);
  return refiner;
}

std::multiset<std::set<std::uint32_t>> lattice_faces(const bitstream::BaseTopology& base,
                                                     const LatticeNumbering& numbering) {
  std::multiset<std::set<std::uint32_t>> faces;
  const std::uint32_t n = numbering.steps();
  for (std::uint32_t t = 0; t < base.triangles.size(); ++t)
    for (std::uint32_t j = 0; j < n; ++j)
      for (std::uint32_t i = 0; i + j < n; ++i) {
        faces.insert({numbering.at(t, i, j), numbering.at(t, i + 1, j), numbering.at(t, i, j + 1)});
        if (i + j + 1 < n)
          faces.insert({numbering.at(t, i + 1, j), numbering.at(t, i + 1, j + 1),
                        numbering.at(t, i, j + 1)});
      }
  return faces;
}

// The lattices' small triangles are exactly the faces of OpenSubdiv's refinement.
TEST(LatticeNumbering, IsOpenSubdivs) {
  for (const test::Shape& shape : test::base_shapes())
    for (int levels : {0, 1, 2, 4}) {
      SCOPED_TRACE(shape.name);
      bitstream::BaseTopology base;
      base.vertex_count = static_cast<std::uint32_t>(shape.mesh.positions.size());
      base.triangles = shape.mesh.triangles;
      const LatticeNumbering numbering = number_lattices(base, levels);
      const auto refiner = refine(base, levels);
      const Far::TopologyLevel& finest = refiner->GetLevel(levels);
      ASSERT_EQ(static_cast<int>(numbering.vertex_count), finest.GetNumVertices());
      EXPECT_EQ(count_finest_vertices(base, levels), numbering.vertex_count);
      std::multiset<std::set<std::uint32_t>> expected;
      for (int f = 0; f < finest.GetNumFaces(); ++f) {
        const auto corners = finest.GetFaceVertices(f);
        expected.insert({static_cast<std::uint32_t>(corners[0]),
                         static_cast<std::uint32_t>(corners[1]),
                         static_cast<std::uint32_t>(corners[2])});
      }
      EXPECT_EQ(lattice_faces(base, numbering), expected);
    }
}

}  // namespace
}  // namespace zerotree::remesh
