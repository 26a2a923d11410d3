#include "rod_shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "legendre.h"

namespace cosserat_cable::generator {
namespace {

constexpr double kSamePlace = 1e-9;  // of the length: breaks nearer than this are one

Eigen::Matrix3d rotationOf(const Eigen::Vector3d& v) {
  const double angle2 = v.squaredNorm();
  double a = 1.0 - angle2 / 6.0;  // sin/angle and (1 - cos)/angle^2, to rounding below 1e-4 rad
  double b = 0.5 - angle2 / 24.0;
  if (angle2 > 1e-8) {
    const double angle = std::sqrt(angle2);
    a = std::sin(angle) / angle;
    b = (1.0 - std::cos(angle)) / angle2;
  }
  Eigen::Matrix3d R = b * v * v.transpose();
  R.diagonal().array() += 1.0 - b * angle2;
  const Eigen::Vector3d u = a * v;
  R(0, 1) -= u.z();
  R(0, 2) += u.y();
  R(1, 0) += u.z();
  R(1, 2) -= u.x();
  R(2, 0) -= u.y();
  R(2, 1) += u.x();
  return R;
}

}  // namespace

RodShape::RodShape(double length, const std::vector<double>& breaks, const Resolution& resolution)
    : length_(length), nodes_per_element_(resolution.nodes) {
  std::vector<double> inner = breaks;
  std::sort(inner.begin(), inner.end());
  for (double s : inner) {
    const double previous = ends_.empty() ? 0.0 : ends_.back();
    if (s > previous + kSamePlace * length && s < length * (1.0 - kSamePlace)) ends_.push_back(s);
  }
  ends_.push_back(length);

  const int E = elements();
  const int N = nodes_per_element_;
  const GaussRule rule = gaussRule(N);
  const GaussRule three = gaussRule(3);
  offset_[0] = 0;
  for (int c = 0; c < 6; ++c) {
    offset_[c + 1] = offset_[c] + E * (c < 3 ? resolution.curvature : resolution.strain);
  }
  size_ = offset_[6];
  weights_.resize(E * N);
  curvature_.setZero(E * N, E * resolution.curvature);
  strain_.setZero(E * N, E * resolution.strain);
  integral_.setZero(E * N + E, E * N);
  between_.setZero(3 * E * (N + 1), E * resolution.curvature);
  for (int e = 0; e < E; ++e) {
    const double h = ends_[e] - (e == 0 ? 0.0 : ends_[e - 1]);
    lengths_.push_back(h);
    weights_.segment(e * N, N) = 0.5 * h * rule.weights;
    for (int i = 0; i <= N; ++i) {
      const double right = i < N ? rule.nodes[i] : 1.0;
      const double left = i > 0 ? rule.nodes[i - 1] : -1.0;
      const int point = i < N ? e * N + i : E * N + e;
      for (int k = 0; k < e; ++k) {
        integral_.row(point).segment(k * N, N) = weights_.segment(k * N, N).transpose();
      }
      integral_.row(point).segment(e * N, N) = 0.5 * h * integralFromLeft(rule, right);
      spacing_.push_back(0.5 * h * (right - left));
      for (int k = 0; k < 3; ++k) {
        const double x = 0.5 * (left + right) + 0.5 * (right - left) * three.nodes[k];
        between_.row(3 * (e * (N + 1) + i) + k)
            .segment(e * resolution.curvature, resolution.curvature) =
            legendreValues(resolution.curvature, x);
      }
      if (i == N) break;
      curvature_.row(point).segment(e * resolution.curvature, resolution.curvature) =
          legendreValues(resolution.curvature, right);
      strain_.row(point).segment(e * resolution.strain, resolution.strain) =
          legendreValues(resolution.strain, right);
    }
  }
}

int RodShape::endPoint(double s) const {
  for (int e = 0; e < elements(); ++e) {
    if (std::abs(ends_[e] - s) <= kSamePlace * length_) return nodes() + e;
  }
  throw std::invalid_argument("no element ends at s = " + std::to_string(s));
}

Eigen::RowVectorXd RodShape::integralTo(double s) const {
  if (s < 0.0 || s > length_ * (1.0 + kSamePlace)) {
    throw std::invalid_argument("s = " + std::to_string(s) + " is not on the rod");
  }
  const int N = nodes_per_element_;
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(nodes());
  double start = 0.0;
  for (int e = 0; e < elements(); ++e) {
    if (s <= ends_[e] || e + 1 == elements()) {
      const double x = std::min(1.0, 2.0 * (s - start) / lengths_[e] - 1.0);
      row.segment(e * N, N) = 0.5 * lengths_[e] * integralFromLeft(gaussRule(N), x);
      break;
    }
    row.segment(e * N, N) = weights_.segment(e * N, N).transpose();
    start = ends_[e];
  }
  return row;
}

Points RodShape::atNodes(const Eigen::VectorXd& q, int first) const {
  Points field(3, nodes());
  for (int c = 0; c < 3; ++c) {
    field.row(c).transpose().noalias() =
        basis(first + c) * q.segment(offset_[first + c], count(first + c));
  }
  return field;
}

Eigen::Vector3d RodShape::step(const Points& K, int first, double h) const {
  // Magnus expansion of order six on the three Gauss points (Blanes, Casas, Ros) for the transpose
  // of the frame, (R^T)' = -K x R^T.
  const Eigen::Vector3d A1 = -K.col(first), A2 = -K.col(first + 1), A3 = -K.col(first + 2);
  const Eigen::Vector3d a1 = h * A2;
  const Eigen::Vector3d a2 = std::sqrt(15.0) / 3.0 * h * (A3 - A1);
  const Eigen::Vector3d a3 = 10.0 / 3.0 * h * (A3 - 2.0 * A2 + A1);
  const Eigen::Vector3d c1 = a1.cross(a2);
  const Eigen::Vector3d c2 = -a1.cross(2.0 * a3 + c1) / 60.0;
  return a1 + a3 / 12.0 + (-20.0 * a1 - a3 + c1).cross(a2 + c2) / 240.0;
}

void RodShape::rotations(const Eigen::VectorXd& q, Eigen::Matrix3Xd* frames) const {
  Points K(3, between_.rows());
  for (int c = 0; c < 3; ++c) {
    K.row(c).transpose().noalias() = between_ * q.segment(offset_[c], count(c));
  }
  frames->resize(3, 3 * points());
  const int N = nodes_per_element_;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  for (int e = 0; e < elements(); ++e) {
    for (int i = 0; i <= N; ++i) {
      const int interval = e * (N + 1) + i;
      const int point = i < N ? e * N + i : nodes() + e;
      R = R * rotationOf(-step(K, 3 * interval, spacing_[interval]));
      frames->middleCols<3>(3 * point) = R;
    }
  }
}

}  // namespace cosserat_cable::generator
