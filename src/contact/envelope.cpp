#include "envelope.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cosserat_cable/math/kernel.h"
#include "cosserat_cable/math/lane_rows.h"

namespace cosserat_cable {
namespace {

Eigen::Vector2d Across(const Eigen::Vector3d& p, int axis) {
  return {p[(axis + 1) % 3], p[(axis + 2) % 3]};
}

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double OriginToSegment(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double square = along.squaredNorm();
  const double t = square > 0 ? std::clamp(-a.dot(along) / square, 0.0, 1.0) : 0.0;
  return (a + t * along).norm();
}

double OriginToTriangle(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                        const Eigen::Vector2d& c) {
  const double ab = Cross(a, b), bc = Cross(b, c), ca = Cross(c, a);
  const bool inside = (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
  if (inside) return 0;
  return std::min({OriginToSegment(a, b), OriginToSegment(b, c), OriginToSegment(c, a)});
}

struct Radii {
  double inner = std::numeric_limits<double>::infinity(), outer = 0;
};

Radii RadiiAbout(int axis, const TriangleMesh& mesh) {
  Radii radii;
  double outer_squared = 0;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Eigen::Vector2d a = Across(mesh.vertices[t[0]], axis);
    const Eigen::Vector2d b = Across(mesh.vertices[t[1]], axis);
    const Eigen::Vector2d c = Across(mesh.vertices[t[2]], axis);
    outer_squared = std::max({outer_squared, a.squaredNorm(), b.squaredNorm(), c.squaredNorm()});
    // All of a triangle is as near to a corner as the farther other one.
    const double extent = std::sqrt(std::max((b - a).squaredNorm(), (c - a).squaredNorm()));
    const double reach = radii.inner + extent;
    if (a.squaredNorm() < reach * reach)
      radii.inner = std::min(radii.inner, OriginToTriangle(a, b, c));
  }
  radii.outer = std::sqrt(outer_squared);
  return radii;
}

double Smallest(const Lanes& lanes) { return std::min({lanes[0], lanes[1], lanes[2], lanes[3]}); }

// How far beyond an interval.
Lanes Beyond(double low, double high, const Lanes& p) {
  return Max(Max(Lanes(low) - p, p - Lanes(high)), Lanes(0.0));
}

COSSERAT_CABLE_KERNEL
double SmallestDistance(const Eigen::AlignedBox3d& box, const double* const* rows,
                        std::size_t count) {
  Lanes smallest(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < count; i += Lanes::kCount) {
    Lanes square(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      const Lanes outside = Beyond(box.min()[axis], box.max()[axis], LoadLanes(rows[axis] + i));
      square += outside * outside;
    }
    smallest = Min(smallest, square);
  }
  return std::sqrt(Smallest(smallest));
}

struct HollowCylinder {
  double low, high, inner, outer;  // ends and radii
};

// Rows: the coordinate along the axis, and the other two.
COSSERAT_CABLE_KERNEL
double SmallestDistance(const HollowCylinder& cylinder, const double* along, const double* u,
                        const double* v, std::size_t count) {
  Lanes smallest(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < count; i += Lanes::kCount) {
    const Lanes x = LoadLanes(u + i), y = LoadLanes(v + i);
    const Lanes radial = Beyond(cylinder.inner, cylinder.outer, Sqrt(x * x + y * y));
    const Lanes axial = Beyond(cylinder.low, cylinder.high, LoadLanes(along + i));
    smallest = Min(smallest, radial * radial + axial * axial);
  }
  return std::sqrt(Smallest(smallest));
}

}  // namespace

Envelope::Envelope(const Eigen::AlignedBox3d& box) : box_(box) {
  outer_ = Across(box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()), axis_).norm();
}

Envelope::Envelope(const TriangleMesh& mesh) {
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (int i : t) box_.extend(mesh.vertices[i]);
  }
  double least_volume = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const Radii radii = RadiiAbout(axis, mesh);
    // No surface within the inner radius, which reaches to infinity: no solid either.
    const double volume =
        M_PI * (radii.outer * radii.outer - radii.inner * radii.inner) * box_.sizes()[axis];
    if (volume >= least_volume) continue;
    least_volume = volume;
    axis_ = axis;
    inner_ = radii.inner;
    outer_ = radii.outer;
  }
  turns_ = least_volume < box_.volume();
}

double Envelope::Distance(const Eigen::Vector3d& p) const {
  const double radius = Across(p, axis_).norm();
  const double radial = std::max({radius - outer_, inner_ - radius, 0.0});
  const double along = std::max({box_.min()[axis_] - p[axis_], p[axis_] - box_.max()[axis_], 0.0});
  return std::sqrt(std::max(radial * radial + along * along, box_.squaredExteriorDistance(p)));
}

double Envelope::DistanceTurned(const PointRows& points) const {
  const double* const rows[3] = {points.x(), points.y(), points.z()};
  if (!turns_) return SmallestDistance(box_, rows, points.padded_size());
  return SmallestDistance({box_.min()[axis_], box_.max()[axis_], inner_, outer_}, rows[axis_],
                          rows[(axis_ + 1) % 3], rows[(axis_ + 2) % 3], points.padded_size());
}

}  // namespace cosserat_cable
