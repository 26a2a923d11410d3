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

/// What a point must exceed to be beyond: in the coordinates along the axis and across it, squares
/// of lengths where the name says so.
struct Limits {
  double low[3], high[3];  // of the box, the axis first
  double margin_squared, outer_squared, inner_squared;
};

// Above zero where a point of the rows (that along the axis first) is not beyond.
COSSERAT_CABLE_KERNEL
double Within(const Limits& limits, const double* along, const double* u, const double* v,
              std::size_t count) {
  const double* rows[3] = {along, u, v};
  Lanes worst(-1.0);
  for (std::size_t i = 0; i < count; i += Lanes::kCount) {
    Lanes outside[3], square[3];
    for (int k = 0; k < 3; ++k) {
      const Lanes p = LoadLanes(rows[k] + i);
      outside[k] = Max(Max(Lanes(limits.low[k]) - p, p - Lanes(limits.high[k])), Lanes(0.0));
      square[k] = p * p;
    }
    const Lanes radius = square[1] + square[2];
    const Lanes box = outside[0] * outside[0] + outside[1] * outside[1] + outside[2] * outside[2];
    // Beyond by any of the bounds is beyond.
    Lanes within = Lanes(limits.margin_squared) - box;
    within = Min(within, Lanes(limits.outer_squared) - radius);
    within = Min(within, radius - Lanes(limits.inner_squared));
    worst = Max(worst, within);
  }
  return std::max({worst[0], worst[1], worst[2], worst[3]});
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
        (radii.outer * radii.outer - radii.inner * radii.inner) * box_.sizes()[axis];
    if (volume >= least_volume) continue;
    least_volume = volume;
    axis_ = axis;
    inner_ = radii.inner;
    outer_ = radii.outer;
  }
}

double Envelope::Distance(const Eigen::Vector3d& p) const {
  const double radius = Across(p, axis_).norm();
  const double radial = std::max({radius - outer_, inner_ - radius, 0.0});
  const double along = std::max({box_.min()[axis_] - p[axis_], p[axis_] - box_.max()[axis_], 0.0});
  return std::sqrt(std::max(radial * radial + along * along, box_.squaredExteriorDistance(p)));
}

bool Envelope::IsBeyond(double margin, const PointRows& points) const {
  Limits limits;
  for (int k = 0; k < 3; ++k) {
    limits.low[k] = box_.min()[(axis_ + k) % 3];
    limits.high[k] = box_.max()[(axis_ + k) % 3];
  }
  limits.margin_squared = margin * margin;
  limits.outer_squared = (outer_ + margin) * (outer_ + margin);
  // Nothing is nearer to the axis than that where there is no room for it.
  limits.inner_squared = inner_ > margin ? (inner_ - margin) * (inner_ - margin) : -1;
  const double* rows[3] = {points.x(), points.y(), points.z()};
  return Within(limits, rows[axis_], rows[(axis_ + 1) % 3], rows[(axis_ + 2) % 3],
                points.padded_size()) < 0;
}

}  // namespace cosserat_cable
