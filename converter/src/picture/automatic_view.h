// The view to take when nobody says.
#pragma once

#include <Eigen/Core>

#include "mesh/triangle_mesh.h"

namespace zerotree::picture {

/// The axis, +y or +z, along which the model most likely stands upright: the one below which it
/// has the broader foot; +y, glTF's, unless +z is clearly better.
Eigen::Vector3d automatic_up(const TriangleMesh& mesh);

/// A direction from the model to the viewer, a little above the horizon: the one of several around
/// `up` from which most relief is visible, that is a face rather than the back of a head.
/// Cost: tens of milliseconds.
Eigen::Vector3d automatic_view(const TriangleMesh& mesh, const Eigen::Vector3d& up);

}  // namespace zerotree::picture
