// Makes a triangle soup fit for distance queries.
#pragma once

#include "cosserat_cable/contact/shape.h"

namespace cosserat_cable {

/// Welds vertices that agree in all digits that a file's floats hold (4 float epsilons of the
/// largest coordinate), drops triangles whose height is below that, and vertices that no triangle
/// uses. Where a dropped sliver sat along a longer edge, its neighbour there is split, so that a
/// closed mesh stays closed. @pre all vertices finite, all indices in range.
TriangleMesh CleanMesh(const TriangleMesh& mesh);

}  // namespace cosserat_cable
