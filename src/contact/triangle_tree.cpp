#include "triangle_tree.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/AABB.h>

#include <array>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "cosserat_cable/math/kernel.h"
#include "cosserat_cable/math/lanes.h"

namespace cosserat_cable {
namespace {

constexpr int kWidth = Lanes::kCount;

}  // namespace

// FCL splits the triangles into a tree of boxes, each in two; the tree that is walked is ours: of
// four boxes side by side, in one piece of memory. FCL's own point query (a sphere of radius 0)
// returns an uninitialised distance for a point that lies exactly on a triangle, and takes many
// times as long.
struct TriangleTree::Impl {
  using Model = fcl::BVHModel<fcl::AABBd>;

  struct Triangle {
    std::array<Eigen::Vector3d, 3> corners;
    int index;  // in the mesh
  };
  struct Node {
    Lanes low[3], high[3];   // the children's boxes, by axis; of infinite distance where none is
    int child[kWidth] = {};  // a node, or where negative, ~ of a triangle
  };

  /// Takes over the tree below one of FCL's nodes, and returns where that is.
  int Flatten(const Model& model, int source) {
    const int here = static_cast<int>(nodes.size());
    nodes.emplace_back();
    int children[kWidth] = {source};
    int count = 1;
    // The first inner node among the children gives way to its own two: breadth first.
    for (int i = 0; count < kWidth && i < count;) {
      const auto& node = model.getBV(children[i]);
      if (node.isLeaf()) {
        ++i;
        continue;
      }
      for (int k = i; k + 1 < count; ++k) children[k] = children[k + 1];
      children[count - 1] = node.leftChild();
      children[count++] = node.rightChild();
    }
    for (int axis = 0; axis < 3; ++axis) {
      nodes[here].low[axis] = Lanes(std::numeric_limits<double>::infinity());
      nodes[here].high[axis] = Lanes(-std::numeric_limits<double>::infinity());
    }
    for (int i = 0; i < count; ++i) {
      const auto& child = model.getBV(children[i]);
      for (int axis = 0; axis < 3; ++axis) {
        nodes[here].low[axis].v[i] = child.bv.min_[axis];
        nodes[here].high[axis].v[i] = child.bv.max_[axis];
      }
      const int place =
          child.isLeaf() ? ~AddTriangle(model, child.primitiveId()) : Flatten(model, children[i]);
      nodes[here].child[i] = place;
    }
    return here;
  }

  int AddTriangle(const Model& model, int index) {
    const fcl::Triangle& t = model.tri_indices[index];
    triangles.push_back(
        {{model.vertices[t[0]], model.vertices[t[1]], model.vertices[t[2]]}, index});
    return static_cast<int>(triangles.size()) - 1;
  }

  void Descend(const Node& node, const Eigen::Vector3d& p, Hit* hit) const;

  // Not inlined: whichever vector unit the walk is compiled for, a distance has the same bits.
  [[gnu::noinline]] static void Try(const Triangle& triangle, const Eigen::Vector3d& p, Hit* hit) {
    const auto& [a, b, c] = triangle.corners;
    const ClosestPoint closest = ClosestOnTriangle(p, a, b, c);
    const double distance_squared = (p - closest.point).squaredNorm();
    if (distance_squared < hit->distance_squared)
      *hit = {triangle.index, distance_squared, closest};
  }

  std::vector<Node> nodes;  // the root first
  std::vector<Triangle> triangles;
};

COSSERAT_CABLE_KERNEL
void TriangleTree::Impl::Descend(const Node& node, const Eigen::Vector3d& p, Hit* hit) const {
  Lanes square(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const Lanes at(p[axis]);
    const Lanes outside = Max(Max(node.low[axis] - at, at - node.high[axis]), Lanes(0.0));
    square += outside * outside;
  }
  // Nearest first. A child beyond what is known is not even put in its place.
  std::pair<double, int> way[kWidth];
  int count = 0;
  for (int i = 0; i < kWidth; ++i) {
    const double to_child = square[i];
    if (!(to_child < hit->distance_squared)) continue;
    int k = count++;
    for (; k > 0 && way[k - 1].first > to_child; --k) way[k] = way[k - 1];
    way[k] = {to_child, node.child[i]};
  }
  for (int i = 0; i < count && way[i].first < hit->distance_squared; ++i) {
    const int child = way[i].second;
    if (child >= 0) {
      Descend(nodes[static_cast<std::size_t>(child)], p, hit);
    } else {
      Try(triangles[static_cast<std::size_t>(~child)], p, hit);
    }
  }
}

TriangleTree::TriangleTree(const TriangleMesh& mesh) : impl_(std::make_unique<Impl>()) {
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const Eigen::Vector3i& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  Impl::Model model;
  const bool built = model.beginModel(static_cast<int>(triangles.size()),
                                      static_cast<int>(mesh.vertices.size())) == fcl::BVH_OK &&
                     model.addSubModel(mesh.vertices, triangles) == fcl::BVH_OK &&
                     model.endModel() == fcl::BVH_OK;
  if (!built) throw std::runtime_error("FCL could not build a tree over the mesh");
  impl_->triangles.reserve(triangles.size());
  impl_->Flatten(model, 0);
}

TriangleTree::~TriangleTree() = default;
TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;

TriangleTree::Hit TriangleTree::Nearest(const Eigen::Vector3d& p, double bound) const {
  Hit hit;
  hit.distance_squared = bound * bound;
  impl_->Descend(impl_->nodes.front(), p, &hit);
  return hit;
}

}  // namespace cosserat_cable
