#include "rod_dynamics.h"

#include <algorithm>
#include <cmath>

#include "rotation_vector.h"

namespace cosserat_cable::generator {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Of the rod's own end stiffnesses EI/L^3 and EI/L: lowers frequencies by some 1e-6, while rounding
// of positions (1e-16 L) still makes forces of no more than 1e-9 EI/L^2.
constexpr double kHoldStiffness = 1e7;

std::vector<double> withMasses(const Rod& rod, std::vector<double> breaks) {
  for (const PointMass& mass : rod.masses) breaks.push_back(mass.s);
  return breaks;
}

/// Columns of `vectors` turned by the frames of the first points.
Points turned(const Eigen::Matrix3Xd& frames, const Points& vectors) {
  Points result(3, vectors.cols());
  for (int i = 0; i < vectors.cols(); ++i) {
    result.col(i) = frames.middleCols<3>(3 * i) * vectors.col(i);
  }
  return result;
}

Vector3d cross(const Points& a, int i, const Vector3d& b) { return Vector3d(a.col(i)).cross(b); }

/// Components of a section's tilt and roll against the frame that holds it, exact to first order.
Vector3d smallRotation(const Matrix3d& relative) {
  return {-relative(1, 2), relative(0, 2), 0.5 * (relative(1, 0) - relative(0, 1))};
}

}  // namespace

RodDynamics::RodDynamics(const Rod& rod, const Resolution& resolution,
                         const std::vector<double>& breaks)
    : rod_(rod), shape_(rod.length, withMasses(rod, breaks), resolution) {
  point_mass_.assign(shape_.elements(), 0.0);
  for (const PointMass& mass : rod.masses) {
    point_mass_[shape_.endPoint(mass.s) - shape_.nodes()] += mass.mass;
  }
}

VectorXd RodDynamics::scale() const {
  VectorXd scale = VectorXd::Ones(size());
  scale.head(shape_.offset(3)).setConstant(rod_.length);
  return scale;
}

Vector3d RodDynamics::hingePart(const VectorXd& x) const {
  Vector3d part = Vector3d::Zero();
  for (int j = 0; j < hinge_; ++j) part[hingeAxis(j)] = x[x.size() - hinge_ + j];
  return part;
}

double RodDynamics::holdForceStiffness() const {
  return kHoldStiffness * rod_.C_M[0] / std::pow(rod_.length, 3);
}

double RodDynamics::holdMomentStiffness() const {
  return kHoldStiffness * rod_.C_M[0] / rod_.length;
}

double RodDynamics::holdTime() const {
  return 1e-3 * rod_.length * rod_.length * std::sqrt(rod_.rhoA / rod_.C_M[0]);
}

RodDynamics::Kinematics RodDynamics::kinematics(double t, const VectorXd& q, const VectorXd& v,
                                                const VectorXd& a) const {
  const int N = shape_.nodes();
  const MatrixXd& S = shape_.integral();
  Kinematics k;
  FrameMotion& base = k.base;
  base = clamp(t);
  if (settled) base.v = base.w = base.a = base.alpha = Vector3d::Zero();
  const Matrix3d R_clamp = base.R;
  Matrix3d R_start = base.R;
  Vector3d w_start = base.w, alpha_start = base.alpha;
  k.swivel = R_clamp;
  if (hinge_ > 0) {
    k.turn.angle = hingePart(q);
    k.turn.rate = hingePart(v);
    const RotationVector turn(k.turn.angle);
    const Vector3d spin = R_clamp * turn.velocity(k.turn.rate);
    R_start = R_clamp * turn.R;
    k.swivel = R_clamp * turn.J;
    w_start += spin;
    alpha_start += base.w.cross(spin) + R_clamp * turn.acceleration(k.turn.rate, hingePart(a));
  }
  shape_.rotations(q, &k.frames);
  k.frames = (R_start * k.frames).eval();
  k.K = shape_.atNodes(q, 0);
  k.Kd = shape_.atNodes(v, 0);
  k.G = shape_.atNodes(q, 3);
  k.G.row(2).array() += 1.0;
  k.Gd = shape_.atNodes(v, 3);
  k.rp = turned(k.frames, k.G);

  // All in world axes, where velocities and accelerations are plain integrals along s.
  const Points Kd_world = turned(k.frames, k.Kd);
  k.w.noalias() = Kd_world * S.transpose();
  k.w.colwise() += w_start;
  Points integrand = turned(k.frames, shape_.atNodes(a, 0));
  for (int i = 0; i < N; ++i) integrand.col(i) += cross(k.w, i, Kd_world.col(i));
  k.alpha.noalias() = integrand * S.transpose();
  k.alpha.colwise() += alpha_start;

  const Points Gd_world = turned(k.frames, k.Gd);
  const Points Gdd_world = turned(k.frames, shape_.atNodes(a, 3));
  k.v_s.resize(3, N);
  k.a_s.resize(3, N);
  for (int i = 0; i < N; ++i) {
    const Vector3d rp = k.rp.col(i), w = k.w.col(i), Gd = Gd_world.col(i);
    const Vector3d spin = w.cross(rp);
    k.v_s.col(i) = spin + Gd;
    k.a_s.col(i) = cross(k.alpha, i, rp) + w.cross(spin) + 2.0 * w.cross(Gd) + Gdd_world.col(i);
  }
  k.a.noalias() = k.a_s * S.transpose();
  k.a.colwise() += base.a;
  return k;
}

void RodDynamics::holdLoad(double t, const Kinematics& k, const EndHold& hold, Vector3d* force,
                           Vector3d* moment) const {
  FrameMotion b = hold.pose(t);
  if (settled) b.v = b.w = Vector3d::Zero();
  const int end = shape_.points() - 1;
  const Eigen::RowVectorXd row = shape_.integral().row(end);
  const Vector3d position = k.base.p + k.rp * row.transpose();
  const Vector3d velocity = k.base.v + k.v_s * row.transpose();
  const Matrix3d relative = b.R.transpose() * k.frames.middleCols<3>(3 * end);
  const Vector3d gap = b.R.transpose() * (position - b.p);
  const Vector3d gap_rate = b.R.transpose() * (velocity - b.v - b.w.cross(position - b.p));
  const Vector3d turn = smallRotation(relative);
  const Vector3d turn_rate = b.R.transpose() * (k.w.col(end) - b.w);
  Vector3d f = -holdForceStiffness() * (gap + holdTime() * gap_rate);
  Vector3d m = -holdMomentStiffness() * (turn + holdTime() * turn_rate);
  if (!effects_.empty()) {
    const Vector3d given = clampMoment(1, holdTurn(t, k));
    for (int c = 0; c < 3; ++c) {
      if (holdGives(c)) m[c] = -given[c];
    }
  }
  for (int c = 0; c < 3; ++c) {
    if (!hold.position[c]) f[c] = 0.0;
    if (!hold.rotation[c]) m[c] = 0.0;
  }
  *force += b.R * f;
  *moment += b.R * m;
}

RodDynamics::Internal RodDynamics::internal(double t, const Kinematics& k) const {
  const int N = shape_.nodes(), P = shape_.points(), end = P - 1;
  const VectorXd& weights = shape_.weights();
  const MatrixXd& S = shape_.integral();
  Points load(3, P), moment = Points::Zero(3, P);
  for (int i = 0; i < P; ++i) {
    const double mass = i < N ? weights[i] * rod_.rhoA : point_mass_[i - N];
    load.col(i) = mass * (gravity - k.a.col(i));
  }
  for (const auto& [s, force] : forces) load.col(shape_.endPoint(s)) += force;

  const auto rate_of_spin = [&k](int i, const Vector3d& J) -> Vector3d {
    const auto R = k.frames.middleCols<3>(3 * i);
    const Vector3d w = R.transpose() * k.w.col(i);
    const Vector3d alpha = R.transpose() * k.alpha.col(i);
    return R * (J.cwiseProduct(alpha) + w.cross(J.cwiseProduct(w)));
  };
  const Vector3d a3 = k.frames.col(3 * end + 2);
  load.col(end) += disc.mass * (gravity - k.a.col(end));
  moment.col(end) += (end_torque - disc.dashpot * a3.dot(k.w.col(end))) * a3 -
                     rate_of_spin(end, disc.inertia * Vector3d(0.5, 0.5, 1.0));
  if (!holds.empty()) {
    Vector3d f = Vector3d::Zero(), m = Vector3d::Zero();
    holdLoad(t, k, holds.front(), &f, &m);
    load.col(end) += f;
    moment.col(end) += m;
  }

  // What lies beyond s acts at s: the transpose of the integral from 0, exact for Gauss nodes.
  Internal result;
  result.n = load * S;
  result.force = load.rowwise().sum();
  if (station_s_.size() > 0) {
    const Points force = stationForces(t, k, stationPositions(k), stationVelocities(k)) *
                         station_weights_.asDiagonal();
    result.n += force * station_integral_;
    result.force += force.rowwise().sum();
  }
  for (int i = 0; i < N; ++i) {
    result.n.col(i) /= weights[i];
    moment.col(i) = weights[i] * (cross(k.rp, i, result.n.col(i)) - rate_of_spin(i, rod_.rhoJ));
  }
  result.m = moment * S;
  for (int i = 0; i < N; ++i) result.m.col(i) /= weights[i];
  result.moment = moment.rowwise().sum();
  return result;
}

VectorXd RodDynamics::residual(double t, const VectorXd& q, const VectorXd& v, const VectorXd& a) {
  const Kinematics k = kinematics(t, q, v, a);
  const Internal load = internal(t, k);
  const int N = shape_.nodes();
  Points M = rod_.C_M.asDiagonal() * k.K + rod_.V_M.asDiagonal() * k.Kd;
  Points F = rod_.V_F.asDiagonal() * k.Gd;
  for (const auto& effect : effects_) effect->addMoments({t, settled, k.K, k.Kd}, &M);
  for (int i = 0; i < N; ++i) {
    const auto R = k.frames.middleCols<3>(3 * i);
    F.col(i) += rod_.C_F.cwiseProduct(k.G.col(i) - Vector3d::UnitZ());
    M.col(i) = shape_.weights()[i] * (M.col(i) - R.transpose() * load.m.col(i));
    F.col(i) = shape_.weights()[i] * (F.col(i) - R.transpose() * load.n.col(i));
  }
  VectorXd result(size());
  for (int c = 0; c < 6; ++c) {
    const Points& field = c < 3 ? M : F;
    result.segment(shape_.offset(c), shape_.count(c)).noalias() =
        shape_.basis(c).transpose() * field.row(c % 3).transpose();
  }
  if (hinge_ > 0) {
    const Vector3d rows = clampMoment(0, k.turn) - k.swivel.transpose() * load.moment;
    for (int j = 0; j < hinge_; ++j) result[size() - hinge_ + j] = rows[hingeAxis(j)];
  }
  return result;
}

void RodDynamics::linearise(double t, const VectorXd& q, const VectorXd& v, const VectorXd& a,
                            MatrixXd* M, MatrixXd* D, MatrixXd* K) {
  const Kinematics k = kinematics(t, q, v, a);
  const Internal load = internal(t, k);
  const int N = shape_.nodes(), P = shape_.points(), n = size(), nk = shape_.offset(3);
  const MatrixXd& S = shape_.integral();
  const VectorXd& w = shape_.weights();
  const auto component = [&k](int count, int d, int c) {  // R_dc of the first points
    VectorXd values(count);
    for (int i = 0; i < count; ++i) values[i] = k.frames(d, 3 * i + c);
    return values;
  };

  // Rotations and displacements of all points, world axes.
  MatrixXd turn[3], slope[3], shift[3];
  for (int d = 0; d < 3; ++d) {
    MatrixXd integrand(N, nk);
    for (int c = 0; c < 3; ++c) {
      integrand.middleCols(shape_.offset(c), shape_.count(c)) =
          component(N, d, c).asDiagonal() * shape_.basis(c);
    }
    turn[d].setZero(P, n);
    turn[d].leftCols(nk).noalias() = S * integrand;
    for (int j = 0; j < hinge_; ++j)
      turn[d].col(n - hinge_ + j).setConstant(k.swivel(d, hingeAxis(j)));
  }
  for (int d = 0; d < 3; ++d) {
    const int e = (d + 1) % 3, f = (d + 2) % 3;
    slope[d] = VectorXd(k.rp.row(f).transpose()).asDiagonal() * turn[e].topRows(N) -
               VectorXd(k.rp.row(e).transpose()).asDiagonal() * turn[f].topRows(N);
    for (int c = 3; c < 6; ++c) {
      slope[d].middleCols(shape_.offset(c), shape_.count(c)) =
          component(N, d, c - 3).asDiagonal() * shape_.basis(c);
    }
    shift[d].noalias() = S * slope[d];
  }

  VectorXd mass(P);
  mass.head(N) = rod_.rhoA * w;
  for (int e = 0; e < shape_.elements(); ++e) mass[N + e] = point_mass_[e];
  mass[P - 1] += disc.mass;
  M->setZero(n, n);
  for (int d = 0; d < 3; ++d) M->noalias() += shift[d].transpose() * mass.asDiagonal() * shift[d];
  MatrixXd end_turn(3, n);  // section axes
  for (int c = 0; c < 3; ++c) {
    MatrixXd body = MatrixXd::Zero(P, n);
    for (int d = 0; d < 3; ++d) body += component(P, d, c).asDiagonal() * turn[d];
    VectorXd inertia = VectorXd::Zero(P);
    inertia.head(N) = rod_.rhoJ[c] * w;
    inertia[P - 1] = disc.inertia * (c == 2 ? 1.0 : 0.5);
    M->noalias() += body.transpose() * inertia.asDiagonal() * body;
    end_turn.row(c) = body.row(P - 1);
  }

  K->setZero(n, n);
  D->setZero(n, n);
  for (int c = 0; c < 6; ++c) {
    const int at = shape_.offset(c), count = shape_.count(c);
    const MatrixXd gram = shape_.basis(c).transpose() * w.asDiagonal() * shape_.basis(c);
    K->block(at, at, count, count) = (c < 3 ? rod_.C_M[c] : rod_.C_F[c - 3]) * gram;
    D->block(at, at, count, count) = (c < 3 ? rod_.V_M[c] : rod_.V_F[c - 3]) * gram;
  }
  *D += disc.dashpot * end_turn.row(2).transpose() * end_turn.row(2);

  // Internal forces turn with neither section nor tangent: their work changes with both.
  MatrixXd moment_change[3];
  for (int d = 0; d < 3; ++d) {
    const int e = (d + 1) % 3, f = (d + 2) % 3;
    const MatrixXd lever =
        VectorXd(w.array() * load.n.row(f).transpose().array()).asDiagonal() * slope[e] -
        VectorXd(w.array() * load.n.row(e).transpose().array()).asDiagonal() * slope[f];
    moment_change[d].noalias() = S.topRows(N).transpose() * lever;  // times the weights
    for (int j = 0; j < hinge_; ++j) {
      K->row(n - hinge_ + j) -= k.swivel(d, hingeAxis(j)) * lever.colwise().sum();
    }
  }
  for (int c = 0; c < 6; ++c) {
    const Points& field = c < 3 ? load.m : load.n;
    MatrixXd change = MatrixXd::Zero(N, n);
    for (int d = 0; d < 3; ++d) {
      VectorXd arm(N);
      for (int i = 0; i < N; ++i) {
        const Vector3d axis = k.frames.col(3 * i + c % 3);
        arm[i] = w[i] * axis.cross(Vector3d(field.col(i)))[d];
      }
      change += arm.asDiagonal() * turn[d].topRows(N);
      if (c < 3) change += component(N, d, c).asDiagonal() * moment_change[d];
    }
    K->middleRows(shape_.offset(c), shape_.count(c)) -= shape_.basis(c).transpose() * change;
  }

  for (const EndHold& hold : holds) {
    const Matrix3d R = hold.pose(t).R;
    MatrixXd gap = MatrixXd::Zero(3, n), angle = MatrixXd::Zero(3, n);
    for (int c = 0; c < 3; ++c) {
      for (int d = 0; d < 3; ++d) {
        gap.row(c) += R(d, c) * shift[d].row(P - 1);
        angle.row(c) += R(d, c) * turn[d].row(P - 1);
      }
    }
    Vector3d force, moment;
    for (int c = 0; c < 3; ++c) {
      force[c] = hold.position[c] ? holdForceStiffness() : 0.0;
      moment[c] = hold.rotation[c] && !holdGives(c) ? holdMomentStiffness() : 0.0;
    }
    const MatrixXd stiffness = gap.transpose() * force.asDiagonal() * gap +
                               angle.transpose() * moment.asDiagonal() * angle;
    *K += stiffness;
    *D += holdTime() * stiffness;
    if (holdGives(0) || holdGives(2)) {
      Matrix3d spring, dashpot;
      lineariseClamp(1, holdTurn(t, k), &spring, &dashpot);
      *K += angle.transpose() * spring * angle;
      *D += angle.transpose() * dashpot * angle;
    }
  }
  if (!effects_.empty()) lineariseEffects(t, k, slope, D, K);
}

PointMotion RodDynamics::pointMotion(const MotionState& state,
                                     const Eigen::RowVectorXd& station) const {
  const Kinematics k = kinematics(state.t, state.q, state.v, state.a);
  const FrameMotion& base = k.base;
  const VectorXd row = station.transpose();
  return {base.p + k.rp * row, base.v + k.v_s * row, base.a + k.a_s * row};
}

double RodDynamics::twist(const VectorXd& q, const Eigen::RowVectorXd& station) const {
  return hingePart(q).z() +
         station.dot(shape_.basis(2) * q.segment(shape_.offset(2), shape_.count(2)));
}

std::pair<Vector3d, Vector3d> RodDynamics::clampLoad(const MotionState& state) {
  const Kinematics k = kinematics(state.t, state.q, state.v, state.a);
  const Internal load = internal(state.t, k);
  return {-load.force, -load.moment};
}

RodDynamics::Energy RodDynamics::energy(const MotionState& state) const {
  const int N = shape_.nodes(), P = shape_.points();
  const Kinematics k = kinematics(state.t, state.q, state.v, state.a);
  const FrameMotion& base = k.base;
  const Points position = (k.rp * shape_.integral().transpose()).colwise() + base.p;
  const Points velocity = (k.v_s * shape_.integral().transpose()).colwise() + base.v;
  Energy energy;
  for (int i = 0; i < P; ++i) {
    const Vector3d w = k.frames.middleCols<3>(3 * i).transpose() * k.w.col(i);
    double mass = i < N ? shape_.weights()[i] * rod_.rhoA : point_mass_[i - N];
    Vector3d inertia = Vector3d::Zero();
    if (i < N) inertia = shape_.weights()[i] * rod_.rhoJ;
    if (i == P - 1) {
      mass += disc.mass;
      inertia += disc.inertia * Vector3d(0.5, 0.5, 1.0);
      energy.loss += disc.dashpot * w.z() * w.z();
    }
    energy.kinetic +=
        0.5 * mass * velocity.col(i).squaredNorm() + 0.5 * w.dot(inertia.cwiseProduct(w));
    energy.potential -= mass * gravity.dot(position.col(i));
  }
  for (int i = 0; i < N; ++i) {
    const double weight = shape_.weights()[i];
    const Vector3d K = k.K.col(i), G = k.G.col(i) - Vector3d::UnitZ();
    const Vector3d Kd = k.Kd.col(i), Gd = k.Gd.col(i);
    energy.elastic +=
        0.5 * weight * (K.dot(rod_.C_M.cwiseProduct(K)) + G.dot(rod_.C_F.cwiseProduct(G)));
    energy.loss += weight * (Kd.dot(rod_.V_M.cwiseProduct(Kd)) + Gd.dot(rod_.V_F.cwiseProduct(Gd)));
  }
  for (const auto& [s, force] : forces)
    energy.potential -= force.dot(position.col(shape_.endPoint(s)));
  return energy;
}

}  // namespace cosserat_cable::generator
