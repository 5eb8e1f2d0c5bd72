// The picture of the wavelet details.
#pragma once

#include "convert/remesh_pictures.h"

namespace zerotree::convert {

/// One small picture of `limit`, the remesh, per level and kind: in the upper row it is coloured by
/// the size of the normal details, in the lower one by that of the tangential ones; one logarithmic
/// scale serves all.
picture::Image draw_details(const PictureSubject& subject, const TriangleMesh& limit,
                            const PictureView& view);

}  // namespace zerotree::convert
