// One part of a mesh as a piece of a body's boundary.
#pragma once

#include <memory>

#include "mesh_part.h"
#include "surface.h"

namespace cosserat_cable {

/// `index` becomes Clearance::shape.
std::unique_ptr<Surface> MakeSurface(std::shared_ptr<const MeshPart> part, const Pose& X_BS,
                                     int index);

}  // namespace cosserat_cable
