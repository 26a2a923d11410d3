// One part of a mesh as a piece of a body's boundary.
#pragma once

#include "mesh_topology.h"
#include "surface.h"

namespace cosserat_cable {

/// `index` becomes Clearance::shape. The part's vertices are in the body's frame.
std::unique_ptr<Surface> MakeSurface(OrientedMesh part, int index);

}  // namespace cosserat_cable
