#include "primitive_surface.h"

#include <cmath>
#include <stdexcept>

namespace cosserat_cable {
namespace {

// Nearer to the surface than this fraction of the shape, the direction to it is rounding noise and
// the normal comes from the faces instead.
constexpr double kOnSurface = 1e-9;

void RequirePositive(bool all_positive, const char* what) {
  if (!all_positive)
    throw std::invalid_argument(std::string(what) + " must be positive and finite");
}

struct Local {
  double distance;
  Eigen::Vector3d nearest, normal;
};

// Signed distance to the box |x_i| <= half_i in N dimensions.
template <int N>
struct Orthotope {
  using Vector = Eigen::Matrix<double, N, 1>;

  static double Distance(const Vector& p, const Vector& half, Vector* nearest, Vector* normal) {
    const Vector excess = p.cwiseAbs() - half;  // positive: beyond that pair of faces
    const Vector side = p.unaryExpr([](double x) { return std::copysign(1.0, x); });
    int axis;
    const double deepest = excess.maxCoeff(&axis);
    if (deepest <= 0) {
      *nearest = p;
      (*nearest)[axis] = side[axis] * half[axis];
      *normal = Vector::Zero();
      (*normal)[axis] = side[axis];
      return deepest;
    }
    *nearest = p.cwiseMax(-half).cwiseMin(half);
    const double distance = (p - *nearest).norm();
    const double noise = kOnSurface * half.maxCoeff();
    if (distance > noise) {
      *normal = (p - *nearest) / distance;
    } else {
      *normal =
          ((excess.array() > -noise).template cast<double>() * side.array()).matrix().normalized();
    }
    return distance;
  }
};

Local Evaluate(const Sphere& sphere, const Eigen::Vector3d& p) {
  const double r = p.norm();
  const Eigen::Vector3d normal =
      r > kOnSurface * sphere.radius ? Eigen::Vector3d(p / r) : Eigen::Vector3d::UnitZ();
  return {r - sphere.radius, sphere.radius * normal, normal};
}

Local Evaluate(const Box& box, const Eigen::Vector3d& p) {
  Local local;
  local.distance = Orthotope<3>::Distance(p, box.size / 2, &local.nearest, &local.normal);
  return local;
}

// In the half-plane of axis and point, a cylinder is a rectangle.
Local Evaluate(const Cylinder& cylinder, const Eigen::Vector3d& p) {
  const double rho = p.head<2>().norm();
  const Eigen::Vector2d radial = rho > kOnSurface * cylinder.radius
                                     ? Eigen::Vector2d(p.head<2>() / rho)
                                     : Eigen::Vector2d::UnitX();
  Eigen::Vector2d nearest, normal;
  Local local;
  local.distance = Orthotope<2>::Distance({rho, p.z()}, {cylinder.radius, cylinder.length / 2},
                                          &nearest, &normal);
  local.nearest << radial * nearest[0], nearest[1];
  local.normal << radial * normal[0], normal[1];
  return local;
}

// Half of the edge lengths of the axis-aligned box around the shape, turned by R.
Eigen::Vector3d HalfExtent(const Sphere& sphere, const Eigen::Matrix3d&) {
  return Eigen::Vector3d::Constant(sphere.radius);
}
Eigen::Vector3d HalfExtent(const Box& box, const Eigen::Matrix3d& R) {
  return R.cwiseAbs() * box.size / 2;
}
Eigen::Vector3d HalfExtent(const Cylinder& cylinder, const Eigen::Matrix3d& R) {
  const Eigen::Array3d axis = R.col(2).array().abs();
  return cylinder.length / 2 * axis + cylinder.radius * (1 - axis.square()).max(0).sqrt();
}

template <typename Geometry>
class PrimitiveSurface : public Surface {
 public:
  PrimitiveSurface(const Geometry& geometry, const Pose& X_BS, int index)
      : geometry_(geometry), X_BS_(X_BS), X_SB_(X_BS.Inverse()), index_(index) {
    const Eigen::Vector3d half = HalfExtent(geometry, X_BS.q.toRotationMatrix());
    envelope_ = Envelope(Eigen::AlignedBox3d(X_BS.p - half, X_BS.p + half));
  }

  void Improve(const Eigen::Vector3d& p_B, double reach, Clearance* best) const override {
    const Local local = Evaluate(geometry_, X_SB_ * p_B);
    if (local.distance >= reach || local.distance >= best->distance) return;
    *best = Clearance();
    best->distance = local.distance;
    best->nearest = X_BS_ * local.nearest;
    best->normal = X_BS_.q * local.normal;
    best->shape = index_;
  }

 private:
  Geometry geometry_;
  Pose X_BS_, X_SB_;
  int index_;
};

}  // namespace

std::unique_ptr<Surface> MakeSurface(const Sphere& sphere, const Pose& X_BS, int index) {
  RequirePositive(std::isfinite(sphere.radius) && sphere.radius > 0, "sphere radius");
  return std::make_unique<PrimitiveSurface<Sphere>>(sphere, X_BS, index);
}

std::unique_ptr<Surface> MakeSurface(const Box& box, const Pose& X_BS, int index) {
  RequirePositive(box.size.allFinite() && box.size.minCoeff() > 0, "box size");
  return std::make_unique<PrimitiveSurface<Box>>(box, X_BS, index);
}

std::unique_ptr<Surface> MakeSurface(const Cylinder& cylinder, const Pose& X_BS, int index) {
  RequirePositive(std::isfinite(cylinder.radius) && cylinder.radius > 0 &&
                      std::isfinite(cylinder.length) && cylinder.length > 0,
                  "cylinder radius and length");
  return std::make_unique<PrimitiveSurface<Cylinder>>(cylinder, X_BS, index);
}

}  // namespace cosserat_cable
