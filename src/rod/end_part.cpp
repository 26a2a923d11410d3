#include "end_part.h"

#include "cosserat_cable/math/rotation.h"
#include "cosserat_cable/math/small_eigen.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

bool Any(const std::array<bool, 3>& held) { return held[0] || held[1] || held[2]; }

/// A section that is held in every rotation has the clamp's very frame.
bool All(const std::array<bool, 3>& held) { return held[0] && held[1] && held[2]; }

}  // namespace

EndPart::EndPart(const EndModel& model)
    : model_(model),
      laws_(model.laws),
      rigid_(model.clamped()),
      holds_(Any(model.translation) || Any(model.rotation)),
      holds_rotation_(Any(model.rotation)),
      sprung_(model.stiffness.any() || model.damping.any() || !model.laws.empty()),
      active_(model.partly_held()) {
  // What is held needs no spring.
  for (int k = 0; k < 3; ++k)
    if (model.rotation[k]) model_.stiffness[k] = model_.damping[k] = 0;
}

EndPart::Relative EndPart::Compare(const Node<double>& node) const {
  const Motion& C = clamp();
  Relative of;
  of.R_WC = C.X.q.toRotationMatrix();
  const Eigen::Quaterniond q_CS = C.X.q.conjugate() * ToEigen(node.q);
  of.psi = RotationLog(q_CS);
  of.psi_dot = RightJacobianInverse(of.psi) * (ToEigen(node.omega) - q_CS.conjugate() * C.omega);
  return of;
}

void EndPart::ImposePose(Node<double>* node) const {
  const Pose& X_WC = clamp().X;
  if (All(model_.translation)) {
    node->r = ToSmall(X_WC.p);
  } else {
    const Matrix3d R_WC = X_WC.q.toRotationMatrix();
    Vector3d d = ToEigen(node->r) - X_WC.p;
    for (int k = 0; k < 3; ++k)
      if (model_.translation[k]) d -= R_WC.col(k) * R_WC.col(k).dot(d);
    node->r = ToSmall(X_WC.p + d);
  }
  if (!holds_rotation_) return;
  Eigen::Quaterniond q_WS = X_WC.q;
  if (!All(model_.rotation)) {
    Vector3d psi = RotationLog(X_WC.q.conjugate() * ToEigen(node->q));
    for (int k = 0; k < 3; ++k)
      if (model_.rotation[k]) psi[k] = 0;
    q_WS = X_WC.q * RotationExp(psi);
  }
  Quat<double> q = ToSmall(q_WS.normalized());
  // q and -q are the same rotation: stay on the side from which the neighbours were reached.
  if (Dot(q, node->q) < 0) q = {-q.w, -q.x, -q.y, -q.z};
  node->q = q;
}

EndLaw::Resistance EndPart::Resist(const Relative& of, Memory memory) const {
  return laws_.Sum(EndLaw::Resistance(), [&](const EndLaw& law) {
    return memory == Memory::kRested ? law.ResistAtRest(of.psi) : law.Resist(of.psi, of.psi_dot);
  });
}

Vector3d EndPart::SpringMoment(const Node<double>& node, Memory memory) const {
  if (!sprung_) return Vector3d::Zero();
  const Relative of = Compare(node);
  Vector3d moment = model_.stiffness.cwiseProduct(of.psi) + model_.damping.cwiseProduct(of.psi_dot);
  if (!laws_.empty()) moment += Resist(of, memory).moment;
  return -RightJacobianInverse(of.psi).transpose() * moment;
}

Matrix3d EndPart::SpringTangent(const Node<double>& node, double rate_factor, Memory memory) const {
  if (!sprung_) return Matrix3d::Zero();
  const Relative of = Compare(node);
  const Matrix3d J = RightJacobianInverse(of.psi);
  const Vector3d k = model_.stiffness + rate_factor * model_.damping;
  if (laws_.empty()) return J.transpose() * k.asDiagonal() * J;
  const EndLaw::Resistance laws = Resist(of, memory);
  const Matrix3d all = Matrix3d(k.asDiagonal()) + laws.by_psi + rate_factor * laws.by_rate;
  return J.transpose() * all * J;
}

Matrix3d EndPart::StaticTangent(const Node<double>& node, const Vector3d& missing) const {
  // The moment -J^T m with m, that of springs and holding axes alike, against psi: how it turns at
  // constant m, by a difference of fourth order, and how m grows.
  constexpr double kStep = 1e-3;  // [rad]
  const Relative of = Compare(node);
  const Vector3d& psi = of.psi;
  const Matrix3d J = RightJacobianInverse(psi);
  const Vector3d m = J.transpose().inverse() * missing;
  Matrix3d turning;
  for (int k = 0; k < 3; ++k) {
    const auto at = [&](double by) -> Vector3d {
      const Eigen::Quaterniond q = RotationExp(psi) * RotationExp(by * Vector3d::Unit(k));
      return RightJacobianInverse(RotationLog(q)).transpose() * m;
    };
    turning.col(k) =
        (8 * (at(kStep) - at(-kStep)) - (at(2 * kStep) - at(-2 * kStep))) / (12 * kStep);
  }
  Matrix3d tangent =
      0.5 * (turning + turning.transpose()) + J.transpose() * model_.stiffness.asDiagonal() * J;
  if (!laws_.empty()) tangent += J.transpose() * Resist(of, Memory::kKept).by_psi * J;
  return tangent;
}

Matrix3d EndPart::RotationByPsi(const Node<double>& node) const {
  return RightJacobianInverse(Compare(node).psi).inverse();
}

double EndPart::SpringPotential(const Node<double>& node, Memory memory) const {
  if (!sprung_) return 0;
  const Vector3d psi = Compare(node).psi;
  return laws_.Sum(0.5 * psi.dot(model_.stiffness.cwiseProduct(psi)), [&](const EndLaw& law) {
    return memory == Memory::kRested ? law.PotentialAtRest(psi) : law.Potential(psi);
  });
}

double EndPart::SpringEnergy(const Node<double>& node) const {
  if (!sprung_) return 0;
  const Vector3d psi = Compare(node).psi;
  return laws_.Sum(0.5 * psi.dot(model_.stiffness.cwiseProduct(psi)),
                   [&](const EndLaw& law) { return law.Energy(psi); });
}

double EndPart::SpringDissipationRate(const Node<double>& node) const {
  if (!sprung_) return 0;
  const Relative of = Compare(node);
  return laws_.Sum(of.psi_dot.dot(model_.damping.cwiseProduct(of.psi_dot)),
                   [&](const EndLaw& law) { return law.DissipationRate(of.psi, of.psi_dot); });
}

double EndPart::CommitLaws(const Node<double>& node, Memory memory) {
  if (laws_.empty()) return 0;
  const Vector3d psi = Compare(node).psi;
  double lost = 0;
  laws_.ForEach([&](EndLaw* law) {
    if (memory == Memory::kRested)
      law->Rest(psi);
    else
      lost += law->Commit(psi);
  });
  return lost;
}

EndPart::Matrix6 EndPart::FreeProjector(const Node<double>& node) const {
  Matrix6 projector = Matrix6::Identity();
  const Relative of = Compare(node);
  for (int k = 0; k < 3; ++k)
    if (model_.translation[k])
      projector.topLeftCorner<3, 3>() -= of.R_WC.col(k) * of.R_WC.col(k).transpose();
  if (All(model_.translation)) projector.topLeftCorner<3, 3>().setZero();
  if (All(model_.rotation)) {
    projector.bottomRightCorner<3, 3>().setZero();
    return projector;
  }
  // psi_k stays: phi is orthogonal to that row of d(psi)/d(phi).
  const Matrix3d rows = RightJacobianInverse(of.psi);
  auto rotation = projector.bottomRightCorner<3, 3>();
  for (int k = 0; k < 3; ++k) {
    if (!model_.rotation[k]) continue;
    const Vector3d direction = (rotation * rows.row(k).transpose()).normalized();
    rotation -= direction * direction.transpose();
  }
  return projector;
}

double EndPart::Power(const Node<double>& node, const Vec3<double>& force,
                      const Vec3<double>& moment) const {
  const Motion& C = clamp();
  if (rigid_) return ToEigen(force).dot(C.v) + ToEigen(moment).dot(C.omega);
  const Vector3d d = ToEigen(node.r) - C.X.p, omega = C.X.q * C.omega;
  return ToEigen(force).dot(C.v + omega.cross(d)) + (ToEigen(node.q) * ToEigen(moment)).dot(omega);
}

}  // namespace cosserat_cable::rod
