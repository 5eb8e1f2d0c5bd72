// How many vertices a base mesh needs, and how often it is subdivided: chosen together, so that the
// finest mesh has the density of the input.
#pragma once

#include <cstdint>
#include <vector>

#include "domain/domain.h"

namespace zerotree::domain {

/// One connected piece of a mesh.
struct ComponentCounts {
  std::uint32_t vertices = 0;
  std::uint32_t faces = 0;
  std::uint32_t boundary_edges = 0;
  std::uint32_t boundary_loops = 0;
  std::uint32_t corners = 0;
  std::uint32_t genus = 0;
};

/// The components of the mesh, by their first face. `kinds` may be empty: no corners then. Linear.
std::vector<ComponentCounts> count_components(const TriangleTopology& topology,
                                              const std::vector<VertexKind>& kinds);

/// Components, boundary loops, corners and total genus into `report`.
void sum_topology(const std::vector<ComponentCounts>& components, DomainReport& report);

/// Base vertices that the topology and the features take for themselves. A component that is too
/// small for a base of its own keeps all its vertices.
std::uint32_t fixed_base_size(const std::vector<ComponentCounts>& components);

/// The base size if none is asked for. The shape asks for a number that grows with the cube root of
/// its `complexity` (shape_complexity.h), features and topology for theirs besides. Of all depths
/// the largest is taken at which the finest mesh may still have so large a base without more faces
/// than `finest_face_limit`, and the base is made as large as that depth allows; but no larger than
/// the shape asks for where an error well above the discretisation error will do, because such a
/// file is small and its base a large part of it.
std::uint32_t automatic_base_size(const std::vector<ComponentCounts>& components, double complexity,
                                  const AccuracyGoal& goal);

/// Faces of the finest mesh, at most, where features and topology leave the choice: four times
/// those of the input, 1.5 times from 400,000 faces on, and 2000 for tiny meshes.
double finest_face_limit(std::size_t input_faces);

/// Levels of subdivision for a base of `base_faces`, at least one: as many as keep the finest mesh
/// within 1.5 times finest_face_limit or 3 times the input's faces, as a base that was asked for or
/// held up by its features may be too large by so much. A mesh of fewer than 2000 faces is
/// subdivided once more. If a larger error is asked for than such a mesh has, levels are left out,
/// each of which makes the error three times smaller; one is added where less than the
/// discretisation error is wanted.
int automatic_levels(std::size_t base_faces, std::size_t input_faces, const AccuracyGoal& goal);

/// Faces of the largest base that is subdivided as often as one of `base_faces`, where no goal is
/// known.
std::size_t largest_base_of_same_depth(std::size_t base_faces, std::size_t input_faces);

}  // namespace zerotree::domain
