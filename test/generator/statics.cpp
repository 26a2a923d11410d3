#include "statics.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace cosserat_cable::generator {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kMaxIterations = 60;
constexpr double kTolerance = 1e-12;        // of the Newton step in units of scale()
constexpr double kLongestStep = 0.3;        // likewise: beyond it the linear model says little
constexpr double kSamePosition = 1e-11;     // of the length
constexpr double kClampedTolerance = 1e-9;  // likewise, with both ends clamped
constexpr double kAbruptTolerance = 1e-8;   // likewise, where the residual has kinks
constexpr int kMaxAbruptIterations = 300;
constexpr int kMaxCuts = 6;  // halvings of a step
constexpr int kStages = 12;  // of a load or a displacement that grows

MotionState atRest(const RodDynamics& rod, double t, const VectorXd& q) {
  const VectorXd zero = VectorXd::Zero(rod.size());
  return {t, q, zero, zero};
}

MatrixXd tangent(RodDynamics& rod, double t, const VectorXd& q) {
  const VectorXd zero = VectorXd::Zero(rod.size());
  MatrixXd M, D, K;
  rod.linearise(t, q, zero, zero, &M, &D, &K);
  return K;
}

VectorXd staticResidual(RodDynamics& rod, double t, const VectorXd& q) {
  const VectorXd zero = VectorXd::Zero(rod.size());
  return rod.residual(t, q, zero, zero);
}

/// While it lives the rod is in statics, where it has effects.
class Settled {
 public:
  explicit Settled(RodDynamics* rod) : rod_(rod), before_(rod->settled) {
    rod->settled = before_ || rod->hasEffects();
  }
  ~Settled() { rod_->settled = before_; }

 private:
  RodDynamics* rod_;
  bool before_;
};

}  // namespace

void remember(RodDynamics& rod, const VectorXd& q, double t) {
  if (!rod.hasEffects()) return;
  const Settled settled(&rod);
  rod.commit(atRest(rod, t, q));
}

VectorXd equilibrium(RodDynamics& rod, const VectorXd& guess, double t) {
  const Settled settled(&rod);
  const bool abrupt = rod.abrupt(), searches = abrupt && rod.holds.empty();
  // A clamp as stiff as a hold rounds to more than the tolerance of a rod that hangs.
  const bool clamped = !rod.holds.empty() && rod.holds.front().position[2];
  const double tolerance = abrupt ? kAbruptTolerance : clamped ? kClampedTolerance : kTolerance;
  VectorXd q = guess;
  const VectorXd scale = rod.scale();
  VectorXd residual = staticResidual(rod, t, q);
  for (int iteration = 0; iteration < (abrupt || clamped ? kMaxAbruptIterations : kMaxIterations);
       ++iteration) {
    const VectorXd step = -tangent(rod, t, q).partialPivLu().solve(residual);
    const double size = step.cwiseProduct(scale).norm();
    if (!std::isfinite(size)) break;
    double part = std::min(1.0, kLongestStep / size);
    VectorXd next = staticResidual(rod, t, q + part * step);
    // Across a kink the whole step may lead nowhere; a stiff hold's residual says nothing of that.
    for (int cut = 0; searches && cut < kMaxCuts && next.norm() > residual.norm(); ++cut) {
      part *= 0.5;
      next = staticResidual(rod, t, q + part * step);
    }
    q += part * step;
    residual = next;
    if (size < tolerance) return q;
  }
  throw std::runtime_error("no equilibrium found");
}

VectorXd loadedEquilibrium(RodDynamics& rod) {
  const Vector3d gravity = rod.gravity;
  const auto forces = rod.forces;
  const double torque = rod.end_torque;
  VectorXd q = VectorXd::Zero(rod.size());
  for (int stage = 1; stage <= kStages; ++stage) {
    const double part = static_cast<double>(stage) / kStages;
    rod.gravity = part * gravity;
    for (size_t i = 0; i < forces.size(); ++i) rod.forces[i].second = part * forces[i].second;
    rod.end_torque = part * torque;
    q = equilibrium(rod, q);
    remember(rod, q);
  }
  rod.gravity = gravity;
  rod.forces = forces;
  rod.end_torque = torque;
  return q;
}

namespace {

/// The rod's last force as it has to be for the station to be at `position`.
VectorXd pulled(RodDynamics& rod, const VectorXd& rest, const Eigen::RowVectorXd& station,
                const Vector3d& position, double first_gap) {
  const int n = rod.size();
  const double L = rod.rod().length;
  const double unit = rod.rod().C_M[0] / (L * L);  // [N]
  VectorXd q = rest;
  const bool abrupt = rod.abrupt();
  const int most = abrupt ? kMaxAbruptIterations : kMaxIterations;
  const double tolerance = abrupt ? kAbruptTolerance : kTolerance;
  const double same = abrupt ? kAbruptTolerance : kSamePosition;
  for (int iteration = 0; iteration < most; ++iteration) {
    // q answers the residual and three unit forces; the forces close the gap.
    MatrixXd right(n, 4);
    right.col(0) = staticResidual(rod, 0.0, q);
    const Vector3d force = rod.forces.back().second;
    for (int d = 0; d < 3; ++d) {
      rod.forces.back().second = force + unit * Vector3d::Unit(d);
      right.col(1 + d) = staticResidual(rod, 0.0, q) - right.col(0);
    }
    rod.forces.back().second = force;
    const MatrixXd answer = -tangent(rod, 0.0, q).partialPivLu().solve(right);
    // A velocity along a change of q is the change of position that goes with it.
    const auto moved = [&](const VectorXd& dq) -> Vector3d {
      MotionState state = atRest(rod, 0.0, q);
      state.v = dq;
      return rod.pointMotion(state, station).velocity;
    };
    Eigen::Matrix3d compliance;
    for (int d = 0; d < 3; ++d) compliance.col(d) = moved(answer.col(1 + d));
    const Vector3d missing = position - rod.pointMotion(atRest(rod, 0.0, q), station).position;
    const Vector3d gap = missing - moved(answer.col(0));
    // A straight rod is all but rigid along its axis: far from the target, what little a force
    // achieves there is left for later (Levenberg).
    const double doubt = 0.1 * compliance.norm() * std::min(1.0, missing.norm() / first_gap);
    const Eigen::Matrix3d normal =
        compliance.transpose() * compliance + doubt * doubt * Eigen::Matrix3d::Identity();
    const Vector3d change = normal.ldlt().solve(compliance.transpose() * gap);
    const VectorXd step = answer.col(0) + answer.rightCols<3>() * change;
    const double size = step.cwiseProduct(rod.scale()).norm();
    if (!std::isfinite(size)) break;
    const double damping = std::min(1.0, kLongestStep / size);
    q += damping * step;
    rod.forces.back().second += damping * unit * change;
    if (size < tolerance && missing.norm() < same * L) return q;
  }
  throw std::runtime_error("no held equilibrium found");
}

}  // namespace

VectorXd heldEquilibrium(RodDynamics& rod, const VectorXd& rest, double s,
                         const Vector3d& position) {
  const Settled settled(&rod);
  const Eigen::RowVectorXd station = rod.shape().integralTo(s);
  const Vector3d start = rod.pointMotion(atRest(rod, 0.0, rest), station).position;
  rod.forces.emplace_back(s, Vector3d::Zero());
  if (!rod.hasEffects()) {
    return pulled(rod, rest, station, position, (position - start).norm());
  }
  // The force that does it without history, then the path along which it grows, then what is
  // missing.
  const double gap = (position - start).norm();
  pulled(rod, rest, station, position, gap);
  const Vector3d force = rod.forces.back().second;
  VectorXd q = rest;
  for (int stage = 1; stage <= kStages; ++stage) {
    rod.forces.back().second = static_cast<double>(stage) / kStages * force;
    q = equilibrium(rod, q);
    remember(rod, q);
  }
  q = pulled(rod, q, station, position, gap);
  remember(rod, q);
  return q;
}

VectorXd twistedEquilibrium(RodDynamics& rod, const VectorXd& rest, double angle) {
  VectorXd q = rest;
  const double L = rod.rod().length;
  const Eigen::RowVectorXd end = rod.shape().integralTo(L);
  const double start = rod.twist(rest, end);
  angle += rod.unstressedTwist() * L;
  for (int stage = 1; stage <= kStages; ++stage) {
    const double target = start + static_cast<double>(stage) / kStages * (angle - start);
    double gap = target - rod.twist(q, end);
    double stiffness = rod.rod().C_M[2] / L;
    const double tolerance = rod.hasEffects() ? kAbruptTolerance : kTolerance;
    for (int iteration = 0; std::abs(gap) > tolerance; ++iteration) {
      if (iteration == kMaxIterations) throw std::runtime_error("no twisted equilibrium found");
      const double before = gap, torque = stiffness * gap;
      rod.end_torque += torque;
      q = equilibrium(rod, q);
      gap = target - rod.twist(q, end);
      // What else gives way by the torque is learnt from how far it got.
      if (rod.hasEffects() && before != gap) stiffness = torque / (before - gap);
    }
    remember(rod, q);
  }
  return q;
}

}  // namespace cosserat_cable::generator
