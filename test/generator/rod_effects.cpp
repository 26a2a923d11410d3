// What effects add to the rod's equations: stations of loads, the clamps' turns, and tangents,
// which are differences because they only serve Newton's iteration.

#include <algorithm>

#include "legendre.h"
#include "rod_dynamics.h"
#include "rotation_vector.h"

namespace cosserat_cable::generator {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Steps of the differences, in curvature times length, lengths, and so on.
constexpr double kStrainStep = 1e-8;
constexpr double kPositionStep = 1e-7;
constexpr double kVelocityStep = 1e-5;  // [m/s over m]
constexpr double kAngleStep = 1e-10;    // [rad]: far less than what turns a slip into a stick
constexpr double kRateStep = 1e-4;      // [rad/s]

}  // namespace

void RodDynamics::addEffect(std::shared_ptr<Effect> effect) {
  const bool twists = hinge_ % 2 == 1 || effect->twistsClamp(0);
  const bool bends = hinge_ >= 2 || effect->bendsClamp(0);
  hinge_ = (twists ? 1 : 0) + (bends ? 2 : 0);
  disc.dashpot += effect->discDashpot();
  const int count = effect->stations();
  if (count > station_s_.size()) {
    // Composite rule of Gauss' three nodes: dense and even.
    const int parts = (count + 2) / 3;
    const GaussRule rule = gaussRule(3);
    const double h = shape_.length() / parts;
    station_s_.resize(3 * parts);
    station_weights_.resize(3 * parts);
    station_integral_.resize(3 * parts, shape_.nodes());
    station_values_.resize(3 * parts, shape_.nodes());
    for (int i = 0; i < 3 * parts; ++i) {
      const double s = h * (i / 3 + 0.5 * (1.0 + rule.nodes[i % 3]));
      const double step = 1e-4 * h;
      station_s_[i] = s;
      station_weights_[i] = 0.5 * h * rule.weights[i % 3];
      station_integral_.row(i) = shape_.integralTo(s);
      station_values_.row(i) =
          (shape_.integralTo(s + step) - shape_.integralTo(s - step)) / (2.0 * step);
    }
  }
  effects_.push_back(std::move(effect));
}

bool RodDynamics::abrupt() const {
  return std::any_of(effects_.begin(), effects_.end(), [](const auto& e) { return e->abrupt(); });
}

bool RodDynamics::holdGives(int component) const {
  return std::any_of(effects_.begin(), effects_.end(), [component](const auto& e) {
    return component < 2 ? e->bendsClamp(1) : e->twistsClamp(1);
  });
}

ClampTurn RodDynamics::holdTurn(double t, const Kinematics& k) const {
  if (holds.empty()) return {};
  FrameMotion b = holds.front().pose(t);
  if (settled) b.w.setZero();
  const int end = shape_.points() - 1;
  const Matrix3d R = b.R.transpose() * k.frames.middleCols<3>(3 * end);
  const Vector3d angle = rotationVectorOf(R);
  const Vector3d spin = b.R.transpose() * (k.w.col(end) - b.w);
  return {angle, RotationVector(angle).J.inverse() * spin};
}

Vector3d RodDynamics::clampMoment(int end, const ClampTurn& turn) const {
  Vector3d moment = Vector3d::Zero();
  for (const auto& effect : effects_) effect->addClampMoment(end, turn, &moment);
  return moment;
}

Points RodDynamics::stationPositions(const Kinematics& k) const {
  return (k.rp * station_integral_.transpose()).colwise() + k.base.p;
}

Points RodDynamics::stationVelocities(const Kinematics& k) const {
  return (k.v_s * station_integral_.transpose()).colwise() + k.base.v;
}

Points RodDynamics::stationForces(double t, const Kinematics& k, const Points& position,
                                  const Points& velocity) const {
  const Points tangent = k.rp * station_values_.transpose();
  Points force = Points::Zero(3, station_s_.size());
  const StationState at{t, station_s_, position, velocity, tangent, k.base, settled};
  for (const auto& effect : effects_) effect->addForces(at, &force);
  return force;
}

void RodDynamics::commit(const MotionState& state) {
  const Kinematics k = kinematics(state.t, state.q, state.v, state.a);
  const ClampTurn turns[2] = {k.turn, holdTurn(state.t, k)};
  for (const auto& effect : effects_) effect->commit({state.t, settled, k.K, k.Kd}, turns);
  if (station_s_.size() == 0) return;
  const Points position = stationPositions(k), velocity = stationVelocities(k);
  const Points tangent = k.rp * station_values_.transpose();
  const StationState at{state.t, station_s_, position, velocity, tangent, k.base, settled};
  for (const auto& effect : effects_) effect->commitLoads(at);
}

void RodDynamics::lineariseClamp(int end, const ClampTurn& turn, Matrix3d* spring,
                                 Matrix3d* dashpot) const {
  for (int c = 0; c < 3; ++c) {
    ClampTurn low = turn, high = turn;
    low.angle[c] -= kAngleStep;
    high.angle[c] += kAngleStep;
    spring->col(c) = (clampMoment(end, high) - clampMoment(end, low)) / (2.0 * kAngleStep);
    low = high = turn;
    low.rate[c] -= kRateStep;
    high.rate[c] += kRateStep;
    dashpot->col(c) = (clampMoment(end, high) - clampMoment(end, low)) / (2.0 * kRateStep);
  }
}

void RodDynamics::lineariseEffects(double t, const Kinematics& k, const MatrixXd* slope,
                                   MatrixXd* D, MatrixXd* K) const {
  // Seen from the middle of the step: laws with a time constant answer by how long it lasts.
  const double later = t + 0.5 * ahead_;
  const int N = shape_.nodes();
  for (const auto& effect : effects_) {
    if (!effect->bends()) continue;
    for (int rates = 0; rates < 2; ++rates) {
      const double step = (rates == 0 ? kStrainStep : kVelocityStep) / shape_.length();
      MatrixXd* target = rates == 0 ? K : D;
      for (int c = 0; c < 3; ++c) {
        Points low = rates == 0 ? k.K : k.Kd, high = low;
        low.row(c).array() -= step;
        high.row(c).array() += step;
        Points below = Points::Zero(3, N), above = below;
        if (rates == 0) {
          effect->addMoments({later, settled, low, k.Kd}, &below);
          effect->addMoments({later, settled, high, k.Kd}, &above);
        } else {
          effect->addMoments({later, settled, k.K, low}, &below);
          effect->addMoments({later, settled, k.K, high}, &above);
        }
        const Points tangent = (above - below) / (2.0 * step);
        if (tangent.cwiseAbs().maxCoeff() == 0.0) continue;
        for (int r = 0; r < 3; ++r) {
          const VectorXd weight = shape_.weights().cwiseProduct(tangent.row(r).transpose());
          target->block(shape_.offset(r), shape_.offset(c), shape_.count(r), shape_.count(c)) +=
              shape_.basis(r).transpose() * weight.asDiagonal() * shape_.basis(c);
        }
      }
    }
  }

  if (hinge_ > 0) {
    Matrix3d spring, dashpot;
    lineariseClamp(0, k.turn, &spring, &dashpot);
    const int first = size() - hinge_;
    for (int i = 0; i < hinge_; ++i) {
      for (int j = 0; j < hinge_; ++j) {
        (*K)(first + i, first + j) += spring(hingeAxis(i), hingeAxis(j));
        (*D)(first + i, first + j) += dashpot(hingeAxis(i), hingeAxis(j));
      }
    }
  }

  if (station_s_.size() == 0) return;
  const Points position = stationPositions(k), velocity = stationVelocities(k);
  MatrixXd shift[3];
  for (int d = 0; d < 3; ++d) shift[d].noalias() = station_integral_ * slope[d];
  for (int rates = 0; rates < 2; ++rates) {
    const double step = (rates == 0 ? kPositionStep : kVelocityStep) * shape_.length();
    for (int e = 0; e < 3; ++e) {
      Points low = rates == 0 ? position : velocity, high = low;
      low.row(e).array() -= step;
      high.row(e).array() += step;
      const Points change =
          rates == 0
              ? Points(stationForces(t, k, high, velocity) - stationForces(t, k, low, velocity))
              : Points(stationForces(t, k, position, high) - stationForces(t, k, position, low));
      if (change.cwiseAbs().maxCoeff() == 0.0) continue;
      MatrixXd& target = rates == 0 ? *K : *D;
      for (int d = 0; d < 3; ++d) {
        const VectorXd weight =
            station_weights_.cwiseProduct(change.row(d).transpose()) / (2.0 * step);
        target.noalias() -= shift[d].transpose() * (weight.asDiagonal() * shift[e]);
      }
    }
  }
}

}  // namespace cosserat_cable::generator
