#include "closest_point.h"

namespace cosserat_cable {
namespace {

// A foot this near to an edge, as a fraction of the triangle, is taken to be on it: rounding
// decides otherwise, and a face's normal can give the wrong sign outside of its face while an
// edge's cannot.
constexpr double kOnFeature = 1e-12;

ClosestPoint OnEdge(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double t, Feature edge,
                    Feature start, Feature end) {
  if (t <= kOnFeature) return {from, start};
  if (t >= 1 - kOnFeature) return {to, end};
  return {from + t * (to - from), edge};
}

}  // namespace

ClosestPoint ClosestOnTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                               const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {a, Feature::kCorner0};

  const Eigen::Vector3d bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {b, Feature::kCorner1};

  const Eigen::Vector3d cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {c, Feature::kCorner2};

  // Areas of the triangles that the foot of p makes with each edge, times the whole's.
  const double at_c = d1 * d4 - d3 * d2, at_b = d5 * d2 - d1 * d6, at_a = d3 * d6 - d5 * d4;
  const double on_edge = kOnFeature * (std::abs(at_a) + std::abs(at_b) + std::abs(at_c));
  if (at_c <= on_edge && d1 >= 0 && d3 <= 0) {
    return OnEdge(a, b, d1 / (d1 - d3), Feature::kEdge0, Feature::kCorner0, Feature::kCorner1);
  }
  if (at_a <= on_edge && d4 >= d3 && d5 >= d6) {
    return OnEdge(b, c, (d4 - d3) / ((d4 - d3) + (d5 - d6)), Feature::kEdge1, Feature::kCorner1,
                  Feature::kCorner2);
  }
  if (at_b <= on_edge && d2 >= 0 && d6 <= 0) {
    return OnEdge(c, a, -d6 / (d2 - d6), Feature::kEdge2, Feature::kCorner2, Feature::kCorner0);
  }
  const double scale = 1 / (at_a + at_b + at_c);
  return {a + ab * (at_b * scale) + ac * (at_c * scale), Feature::kFace};
}

}  // namespace cosserat_cable
