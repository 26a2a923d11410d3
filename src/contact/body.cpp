#include "cosserat_cable/contact/body.h"

#include <algorithm>
#include <limits>

#include "mesh_store.h"
#include "mesh_surface.h"
#include "primitive_surface.h"

namespace cosserat_cable {

struct Body::Impl {
  std::vector<std::unique_ptr<Surface>> surfaces;
  Eigen::AlignedBox3d bounds;
  int axis = -1;
  int triangle_count = 0;

  /// The smallest of the surfaces' `distance`; -infinity where that is none.
  template <typename Distance>
  double LowerBound(const Distance& distance) const {
    double bound = std::numeric_limits<double>::infinity();
    for (const auto& surface : surfaces) {
      const double at_least = distance(surface->envelope());
      if (at_least == 0) return -std::numeric_limits<double>::infinity();
      bound = std::min(bound, at_least);
    }
    return bound;
  }

  template <typename Primitive>
  void Add(const Primitive& primitive, const Pose& X_BS, int index, MeshStore*) {
    surfaces.push_back(MakeSurface(primitive, X_BS, index));
  }

  void Add(const TriangleMesh& mesh, const Pose& X_BS, int index, MeshStore* store) {
    for (const auto& part : store ? store->impl_->PartsOf(mesh) : MakeMeshParts(mesh)) {
      triangle_count += static_cast<int>(part->mesh().triangles.size());
      surfaces.push_back(MakeSurface(part, X_BS, index));
    }
  }
};

Body::Body(const std::vector<Shape>& shapes, MeshStore* store) : impl_(std::make_unique<Impl>()) {
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    std::visit(
        [&](const auto& geometry) {
          impl_->Add(geometry, shapes[i].X_LS, static_cast<int>(i), store);
        },
        shapes[i].geometry);
  }
  for (const auto& surface : impl_->surfaces) impl_->bounds.extend(surface->envelope().box());
  if (!impl_->surfaces.empty()) impl_->axis = impl_->surfaces.front()->envelope().axis();
  for (const auto& surface : impl_->surfaces)
    if (surface->envelope().axis() != impl_->axis) impl_->axis = -1;
}

Body::~Body() = default;
Body::Body(Body&&) noexcept = default;
Body& Body::operator=(Body&&) noexcept = default;

Clearance Body::Query(const Eigen::Vector3d& p_B, double reach) const {
  Clearance best;
  if (!p_B.allFinite()) return best;
  for (const auto& surface : impl_->surfaces) {
    const double at_least = surface->envelope().Distance(p_B);
    // Only within its envelope can a shape have a distance below zero.
    if (at_least > 0 && (at_least >= reach || at_least >= best.distance)) continue;
    surface->Improve(p_B, reach, &best);
  }
  return best;
}

double Body::LowerBound(const Eigen::Vector3d& p_B) const {
  if (!p_B.allFinite()) return std::numeric_limits<double>::infinity();
  return impl_->LowerBound([&](const Envelope& envelope) { return envelope.Distance(p_B); });
}

double Body::LowerBoundTurned(const PointRows& points_B) const {
  return impl_->LowerBound(
      [&](const Envelope& envelope) { return envelope.DistanceTurned(points_B); });
}

int Body::axis() const { return impl_->axis; }
const Eigen::AlignedBox3d& Body::bounds() const { return impl_->bounds; }
int Body::triangle_count() const { return impl_->triangle_count; }

}  // namespace cosserat_cable
