// Box, cylinder and sphere: closed-form signed distances.
#pragma once

#include "surface.h"

namespace cosserat_cable {

/// `index` becomes Clearance::shape. @throws std::invalid_argument where a size is not positive.
std::unique_ptr<Surface> MakeSurface(const Sphere& sphere, const Pose& X_BS, int index);
std::unique_ptr<Surface> MakeSurface(const Box& box, const Pose& X_BS, int index);
std::unique_ptr<Surface> MakeSurface(const Cylinder& cylinder, const Pose& X_BS, int index);

}  // namespace cosserat_cable
