// The view to take when nobody says.
#pragma once

#include <Eigen/Core>

#include "mesh/triangle_mesh.h"

namespace zerotree::picture {

/// The axis along which the model most likely stands upright: +y, which is glTF's, unless it has a
/// clearly broader foot for +z, -z or -y.
Eigen::Vector3d automatic_up(const TriangleMesh& mesh);

/// A direction from the model to the viewer, a little above the horizon: the one of several around
/// `up` from which most relief is visible, that is a face rather than the back of a head.
/// Cost: tens of milliseconds.
Eigen::Vector3d automatic_view(const TriangleMesh& mesh, const Eigen::Vector3d& up);

}  // namespace zerotree::picture
