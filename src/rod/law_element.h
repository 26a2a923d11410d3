// One element as the section's laws see it, and what their tangent is to its nodes.
#pragma once

#include "cosserat_cable/math/small_eigen.h"
#include "element_joint.h"
#include "section_laws.h"

namespace cosserat_cable::rod {

/// The laws' tangent by the nodes' displacements (world) and rotations (their own frames). Where no
/// law answers to force strains, the rotations' quarters only.
struct LawTangent {
  using Block = Eigen::Matrix<double, 6, 6>;
  Block first, second;  ///< the nodes' own blocks
  Block coupling;       ///< rows: first node, columns: second
};

/// Of one rod, or of a half: strains and stresses there have the element's own sense, in which
/// `per_length` is negative where the half runs backwards.
class LawElement {
 public:
  /// `joint`: null for none.
  LawElement(const ElementJoint<double>* joint, const Node<double>& a, const Node<double>& b,
             const Bowing<double>& bowing)
      : jointed_(joint != nullptr), bowing_(bowing) {
    if (jointed_) joint_ = *joint;
    if (jointed_)
      EvaluateStrain<double>(SeenThrough(joint_.first, a), SeenThrough(joint_.second, b), bowing,
                             &state_);
    else
      EvaluateStrain<double>(a, b, bowing, &state_);
  }

  /// As the rod itself sees it, beyond the unstressed strains.
  ElementStrain Strain(double per_length, const Eigen::Vector3d& gamma0,
                       const Eigen::Vector3d& kappa0) const {
    return {per_length * ToEigen(state_.u) - gamma0, per_length * ToEigen(state_.u_rate),
            per_length * ToEigen(state_.theta) - kappa0, per_length * ToEigen(state_.theta_rate)};
  }

  /// `by_strain`: of the section; `length` [m].
  void Tangent(const SectionMatrix& by_strain, double length, bool answers_to_gamma,
               LawTangent* out) const {
    const Eigen::Matrix3d cross = Cross(ToEigen(state_.theta));
    Eigen::Matrix3d J2 = Eigen::Matrix3d::Identity() + 0.5 * cross + state_.c * cross * cross;
    Eigen::Matrix3d J1 = J2.transpose();
    if (jointed_) {
      J1 = J1 * ToEigenMatrix(ToMatrix(joint_.first)).transpose();
      J2 = J2 * ToEigenMatrix(ToMatrix(joint_.second)).transpose();
    }
    if (!answers_to_gamma) {
      const Eigen::Matrix3d K = by_strain.bottomRightCorner<3, 3>() / length;
      const Eigen::Matrix3d K_J1 = K * J1, K_J2 = K * J2;
      out->first.bottomRightCorner<3, 3>().noalias() = J1.transpose() * K_J1;
      out->second.bottomRightCorner<3, 3>().noalias() = J2.transpose() * K_J2;
      out->coupling.bottomRightCorner<3, 3>().noalias() = -J1.transpose() * K_J2;
      return;
    }
    const StrainTangent<double> strain(state_, bowing_);
    const Eigen::Matrix3d R = ToEigenMatrix(strain.R), S = ToEigenMatrix(strain.S),
                          E = ToEigenMatrix(strain.E);
    LawTangent::Block B1 = LawTangent::Block::Zero(), B2 = LawTangent::Block::Zero();
    B1.topLeftCorner<3, 3>() = -R;
    B1.topRightCorner<3, 3>() = S - E;
    B1.bottomRightCorner<3, 3>() = -J1;
    B2.topLeftCorner<3, 3>() = R;
    B2.topRightCorner<3, 3>() = S + E;
    B2.bottomRightCorner<3, 3>() = J2;
    if (jointed_) {
      B1.topRightCorner<3, 3>() *= ToEigenMatrix(ToMatrix(joint_.first)).transpose();
      B2.topRightCorner<3, 3>() *= ToEigenMatrix(ToMatrix(joint_.second)).transpose();
    }
    const LawTangent::Block K = by_strain / length, K_B1 = K * B1, K_B2 = K * B2;
    out->first.noalias() = B1.transpose() * K_B1;
    out->second.noalias() = B2.transpose() * K_B2;
    out->coupling.noalias() = B1.transpose() * K_B2;
  }

 private:
  static Eigen::Matrix3d Cross(const Eigen::Vector3d& v) {
    Eigen::Matrix3d m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
  }
  static Eigen::Matrix3d ToEigenMatrix(const Mat3<double>& a) {
    Eigen::Matrix3d m;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m(i, j) = a[i][j];
    return m;
  }

  bool jointed_;
  ElementJoint<double> joint_;
  Bowing<double> bowing_;
  ElementState<double> state_;
};

}  // namespace cosserat_cable::rod
