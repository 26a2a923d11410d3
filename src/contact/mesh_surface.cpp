#include "mesh_surface.h"

namespace cosserat_cable {
namespace {

TriangleMesh Moved(TriangleMesh mesh_S, const Pose& X_BS) {
  for (Eigen::Vector3d& v : mesh_S.vertices) v = X_BS * v;
  return mesh_S;
}

class MeshSurface : public Surface {
 public:
  MeshSurface(std::shared_ptr<const MeshPart> part, const Pose& X_BS, int index)
      : part_(std::move(part)), X_BS_(X_BS), X_SB_(X_BS.Inverse()), index_(index) {
    envelope_ = Envelope(Moved(part_->mesh(), X_BS));
  }

  void Improve(const Eigen::Vector3d& p_B, double reach, Clearance* best) const override {
    Clearance found = part_->Nearest(X_SB_ * p_B, reach, best->distance);
    if (found.distance >= best->distance) return;
    found.nearest = X_BS_ * found.nearest;
    found.normal = X_BS_.q * found.normal;
    found.shape = index_;
    *best = found;
  }

 private:
  std::shared_ptr<const MeshPart> part_;
  Pose X_BS_, X_SB_;
  int index_;
};

}  // namespace

std::unique_ptr<Surface> MakeSurface(std::shared_ptr<const MeshPart> part, const Pose& X_BS,
                                     int index) {
  return std::make_unique<MeshSurface>(std::move(part), X_BS, index);
}

}  // namespace cosserat_cable
