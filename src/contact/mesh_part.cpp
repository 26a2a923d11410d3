#include "mesh_part.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cosserat_cable {
namespace {

// Nearer to the surface than this fraction of the part, the direction to it is rounding noise and
// the normal is the feature's own.
constexpr double kOnSurface = 1e-9;

}  // namespace

MeshPart::MeshPart(OrientedMesh part) : part_(std::move(part)), tree_(part_.mesh) {
  for (const Eigen::Vector3d& v : part_.mesh.vertices) box_.extend(v);
  noise_ = kOnSurface * box_.diagonal().norm();
}

Clearance MeshPart::Nearest(const Eigen::Vector3d& p_S, double reach, double best) const {
  const bool may_be_inside = part_.closed && box_.contains(p_S);
  double bound = std::min(reach, best);
  if (bound <= 0) {
    if (!may_be_inside) return {};
    bound = std::numeric_limits<double>::infinity();
  }
  TriangleTree::Hit hit = tree_.Nearest(p_S, bound);
  if (hit.triangle < 0 && may_be_inside) {
    // No surface within reach, which also holds deep inside: only the sign matters now.
    hit = tree_.Nearest(p_S, std::numeric_limits<double>::infinity());
  }
  if (hit.triangle < 0) return {};
  const Clearance found = Resolve(p_S, hit);
  return found.distance < reach && found.distance < best ? found : Clearance();
}

Clearance MeshPart::Resolve(const Eigen::Vector3d& p_S, const TriangleTree::Hit& hit) const {
  const Feature feature = hit.closest.feature;
  const Eigen::Vector3d offset = p_S - hit.closest.point;
  Eigen::Vector3d pseudonormal = part_.Normal(hit.triangle, feature);
  if (pseudonormal.isZero()) pseudonormal = part_.faces[hit.triangle].normal;

  Clearance result;
  result.nearest = hit.closest.point;
  result.two_sided = !part_.closed;
  result.rim = part_.IsRim(hit.triangle, feature);
  const double height = offset.dot(pseudonormal);
  const double side = height < 0 ? -1 : 1;
  const double distance =
      feature == Feature::kFace ? std::abs(height) : std::sqrt(hit.distance_squared);
  const bool direction_is_noise = feature == Feature::kFace || distance < noise_;
  if (part_.closed) {
    result.distance = side * distance;
    result.normal = direction_is_noise ? pseudonormal : Eigen::Vector3d(side / distance * offset);
  } else {
    result.distance = distance;
    result.normal = direction_is_noise ? Eigen::Vector3d(side * pseudonormal)
                                       : Eigen::Vector3d(offset / distance);
  }
  return result;
}

}  // namespace cosserat_cable
