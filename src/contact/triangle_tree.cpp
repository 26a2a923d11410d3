#include "triangle_tree.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBB.h>

#include <stdexcept>

namespace cosserat_cable {

// FCL builds and holds the tree; the walk over it is ours. FCL's own point query (a sphere of
// radius 0) returns an uninitialised distance for a point that lies exactly on a triangle, and
// tests boxes as if the point were a rectangle.
struct TriangleTree::Impl {
  fcl::BVHModel<fcl::OBBd> model;

  static double DistanceSquared(const fcl::OBBd& box, const Eigen::Vector3d& p) {
    const Eigen::Array3d local = (box.axis.transpose() * (p - box.To)).array().abs();
    return (local - box.extent.array()).max(0.0).square().sum();
  }

  void Descend(int node_index, const Eigen::Vector3d& p, Hit* hit) const {
    const fcl::BVNode<fcl::OBBd>& node = model.getBV(node_index);
    if (node.isLeaf()) {
      const int triangle = node.primitiveId();
      const fcl::Triangle& t = model.tri_indices[triangle];
      const ClosestPoint closest =
          ClosestOnTriangle(p, model.vertices[t[0]], model.vertices[t[1]], model.vertices[t[2]]);
      const double distance_squared = (p - closest.point).squaredNorm();
      if (distance_squared < hit->distance_squared) *hit = {triangle, distance_squared, closest};
      return;
    }
    int near = node.leftChild(), far = node.rightChild();
    double to_near = DistanceSquared(model.getBV(near).bv, p);
    double to_far = DistanceSquared(model.getBV(far).bv, p);
    if (to_far < to_near) {
      std::swap(near, far);
      std::swap(to_near, to_far);
    }
    if (to_near < hit->distance_squared) Descend(near, p, hit);
    if (to_far < hit->distance_squared) Descend(far, p, hit);
  }
};

TriangleTree::TriangleTree(const TriangleMesh& mesh) : impl_(std::make_unique<Impl>()) {
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const Eigen::Vector3i& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  const bool built =
      impl_->model.beginModel(static_cast<int>(triangles.size()),
                              static_cast<int>(mesh.vertices.size())) == fcl::BVH_OK &&
      impl_->model.addSubModel(mesh.vertices, triangles) == fcl::BVH_OK &&
      impl_->model.endModel() == fcl::BVH_OK;
  if (!built) throw std::runtime_error("FCL could not build a tree over the mesh");
}

TriangleTree::~TriangleTree() = default;
TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;

TriangleTree::Hit TriangleTree::Nearest(const Eigen::Vector3d& p, double bound) const {
  Hit hit;
  hit.distance_squared = bound * bound;
  impl_->Descend(0, p, &hit);
  return hit;
}

}  // namespace cosserat_cable
