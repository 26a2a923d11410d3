#include "cosserat_cable/rod/modes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "damped_modes.h"
#include "linearised_rod.h"
#include "rod_impl.h"
#include "undamped_modes.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Basis for a first look at damping, and how much it grows where that does not suffice.
constexpr int kBasisPerMode = 2, kBasisMore = 10, kBasisGrowth = 3;
// Far below the lowest w^2 of any shape a held rod of this bending stiffness may have.
constexpr double kSmallWSquared = 1e-4;
// Undamped frequencies nearer than this, relative in w^2, are one: their shapes may be mixed.
constexpr double kDegenerate = 1e-6;
// Below this width, relative to the length, a rod is straight.
constexpr double kStraight = 1e-6;

/// Unit normal of the plane that the rod lies in.
Vector3d PlaneNormal(const Rod& rod) {
  const int nodes = rod.elements() + 1;
  Vector3d centre = Vector3d::Zero();
  for (int i = 0; i < nodes; ++i) centre += rod.pose(i).p / nodes;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (int i = 0; i < nodes; ++i) {
    const Vector3d d = rod.pose(i).p - centre;
    spread += d * d.transpose() / nodes;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  const double straight = kStraight * rod.model().length;
  if (axes.eigenvalues()[1] > straight * straight) return axes.eigenvectors().col(0);
  const Vector3d along = axes.eigenvectors().col(2);
  const Vector3d across = along.cross(rod.model().gravity);
  if (across.norm() > kStraight * rod.model().gravity.norm()) return across.normalized();
  return (rod.pose(0).q * Vector3d::UnitY()).normalized();  // across a1
}

/// Quadratic forms that split the kinetic energy of small motion; x as in LinearisedRod.
class Directions {
 public:
  Directions(const Rod& rod, const LinearisedRod& linear)
      : mass_(linear.mass), normal_(PlaneNormal(rod)) {
    for (int i = 0; i <= rod.elements(); ++i) R_.push_back(rod.pose(i).q.toRotationMatrix());
    across_.assign(R_.size(), normal_);
    across_.front() = linear.move_a.transpose() * normal_;
    across_.back() = linear.move_b.transpose() * normal_;
  }

  /// M restricted to motion across the plane, times x: displacements along its normal and bending
  /// rotations about axes in it.
  VectorXd OutOfPlane(const VectorXd& x) const {
    VectorXd y = VectorXd::Zero(x.size());
    for (std::size_t i = 0; i < R_.size(); ++i) {
      const Vector3d u = x.segment<3>(6 * i);
      y.segment<3>(6 * i) = mass_.segment<3>(6 * i).cwiseProduct(across_[i]) * across_[i].dot(u);
      const auto [axis, across] = BendingAxis(i);
      y.segment<3>(6 * i + 3) = BendingInertia(i) * across * across.dot(x.segment<3>(6 * i + 3));
    }
    return y;
  }
  double Torsion(const VectorXd& x) const {
    double sum = 0;
    for (std::size_t i = 0; i < R_.size(); ++i)
      sum += mass_[6 * i + 5] * x[6 * i + 5] * x[6 * i + 5];
    return sum;
  }
  const Eigen::Matrix3d& R(int node) const { return R_[node]; }

 private:
  double BendingInertia(int i) const { return 0.5 * (mass_[6 * i + 3] + mass_[6 * i + 4]); }
  /// In the section's frame: the normal's part across a3, and the axis across both.
  std::pair<Vector3d, Vector3d> BendingAxis(int i) const {
    Vector3d n = R_[i].transpose() * normal_;
    n.z() = 0;
    if (n.norm() < 1e-6) return {Vector3d::UnitX(), Vector3d::Zero()};
    n.normalize();
    return {n, n.cross(Vector3d::UnitZ())};
  }

  const VectorXd& mass_;
  Vector3d normal_;
  std::vector<Vector3d> across_;  // the normal in the axes of the nodes' displacements
  std::vector<Eigen::Matrix3d> R_;
};

/// Shapes of one frequency are any mixture: makes them move as little, then as much, across the
/// plane as can be.
void Separate(const Directions& directions, UndampedModes* modes) {
  const int count = static_cast<int>(modes->w_squared.size());
  for (int first = 0, last = 0; first < count; first = last + 1) {
    for (last = first; last + 1 < count; ++last)
      if (modes->w_squared[last + 1] - modes->w_squared[first] >
          kDegenerate * std::abs(modes->w_squared[last + 1]))
        break;
    const int group = last - first + 1;
    if (group == 1) continue;
    const MatrixXd x = modes->shapes.middleCols(first, group);
    MatrixXd across(group, group);
    for (int c = 0; c < group; ++c) across.col(c) = x.transpose() * directions.OutOfPlane(x.col(c));
    const Eigen::SelfAdjointEigenSolver<MatrixXd> axes(0.5 * (across + across.transpose()));
    modes->shapes.middleCols(first, group) = x * axes.eigenvectors();
  }
}

/// Of a mode that creeps: what is lost in a swing in its shape at its undamped frequency, by what
/// is stored.
double LossRatio(const LinearisedRod& rod, const VectorXd& x, double w) {
  double loss = w * x.dot(rod.load_damping * x);
  for (int i = 0; i < LinearisedRod::kComponents; ++i)
    loss += rod.moduli[i]({0, w}).imag() / rod.moduli[i].C * x.dot(rod.material[i] * x);
  return loss / (2 * w * w);
}

void ShareElasticEnergy(const LinearisedRod& rod, const VectorXd& x, Mode* mode) {
  std::array<double, LinearisedRod::kComponents> energy;
  double sum = 0;
  for (int i = 0; i < LinearisedRod::kComponents; ++i) {
    energy[i] = x.dot(rod.material[i] * x);
    if (!rod.laws.empty()) energy[i] += x.dot(rod.laws[i] * x);
    energy[i] = std::max(0.0, energy[i]);
    sum += energy[i];
  }
  if (!(sum > 0) || mode->w == 0) return;
  mode->bending = (energy[LinearisedRod::kBend1] + energy[LinearisedRod::kBend2]) / sum;
  mode->twist = energy[LinearisedRod::kTwist] / sum;
  mode->stretch = energy[LinearisedRod::kStretch] / sum;
  mode->shear = (energy[LinearisedRod::kShear1] + energy[LinearisedRod::kShear2]) / sum;
}

ModeKind KindOf(const Mode& mode) {
  if (mode.stretch > 0.5) return ModeKind::kAxial;
  if (mode.torsion > std::max(mode.in_plane, mode.out_of_plane)) return ModeKind::kTorsion;
  return mode.out_of_plane > mode.in_plane ? ModeKind::kOutOfPlane : ModeKind::kInPlane;
}

void SetShape(const LinearisedRod& rod, const Directions& directions, const VectorXd& x,
              Mode* mode) {
  const int nodes = static_cast<int>(x.size()) / 6;
  for (int i = 0; i < nodes; ++i) {
    mode->displacement.push_back(rod.Displacement(x, i));
    mode->rotation.push_back(directions.R(i) * rod.Rotation(x, i));
  }
  const auto& measure = mode->kind == ModeKind::kTorsion ? mode->rotation : mode->displacement;
  const auto longest = std::max_element(
      measure.begin(), measure.end(),
      [](const Vector3d& a, const Vector3d& b) { return a.squaredNorm() < b.squaredNorm(); });
  int axis;
  longest->cwiseAbs().maxCoeff(&axis);
  const double scale = std::copysign(1 / longest->norm(), (*longest)[axis]);
  for (int i = 0; i < nodes; ++i) {
    mode->displacement[i] *= scale;
    mode->rotation[i] *= scale;
  }
}

}  // namespace

const char* ToString(ModeKind kind) {
  switch (kind) {
    case ModeKind::kInPlane:
      return "in plane";
    case ModeKind::kOutOfPlane:
      return "out of plane";
    case ModeKind::kTorsion:
      return "torsion";
    case ModeKind::kAxial:
      return "axial";
  }
  return "";
}

namespace {

/// The unknowns at which the clamps hold the rod (linearised_rod.h).
std::vector<bool> HeldUnknowns(const RodModel& model, int unknowns) {
  std::vector<bool> held(unknowns, false);
  const auto hold = [&](const EndModel& end, int first) {
    for (int k = 0; k < 3; ++k) {
      held[first + k] = end.translation[k];
      held[first + 3 + k] = end.rotation[k];
    }
  };
  hold(model.a, 0);
  hold(model.b, unknowns - 6);
  return held;
}

}  // namespace

std::vector<Mode> FindModes(const Rod& rod, int count, const Load* load) {
  Rod copy(rod);
  Rod::Impl& m = *copy.impl_;
  m.BeginHistory();
  for (NodeState& n : m.w.node) n.v = n.omega = V3{};
  for (EndPart* end : {&m.ends.a, &m.ends.b}) end->Start(Motion::Resting(end->clamp().X));
  m.w.trial = m.w.node;
  m.PrepareStatics();
  const int unknowns = 6 * m.w.count;
  const std::vector<bool> held = HeldUnknowns(m.model, unknowns);
  std::vector<SectionMatrix> tangents;
  if (!m.laws.empty()) {
    m.PlaceLawStress();
    for (int e = 0; e < m.model.elements; ++e)
      tangents.push_back(m.laws.SmallTangent(e, m.StaticStrain(m.StaticElement(e))));
  }
  const LinearisedRod linear(m.Moduli(), m.joints, m.ends, m.stiffening, tangents, held,
                             m.Acting(load),
                             &m.w);
  const Directions directions(rod, linear);

  const double length = m.model.length;
  const double bending = std::min(m.model.section.C_M.x(), m.model.section.C_M.y());
  const double small = kSmallWSquared * bending / (linear.mass.sum() * length * length * length);
  std::vector<ModeRoots> roots;
  UndampedModes undamped;
  int basis = kBasisPerMode * count + kBasisMore;
  for (;; basis *= kBasisGrowth) {
    undamped = FindUndampedModes(linear, basis, count, small);
    Separate(directions, &undamped);
    count = std::min(count, static_cast<int>(undamped.w_squared.size()));
    if (FindRoots(linear, undamped, count, std::sqrt(small), &roots)) break;
    if (basis > unknowns)
      throw std::runtime_error("modes: the damped roots do not belong to the modes one to one");
  }

  std::vector<Mode> modes(count);
  for (int n = 0; n < count; ++n) {
    Mode& mode = modes[n];
    const VectorXd x = undamped.shapes.col(n);
    mode.w = undamped.w_squared[n] > small ? std::sqrt(undamped.w_squared[n]) : 0.0;
    mode.lambda = roots[n].lambda;
    mode.second = roots[n].second;
    if (mode.oscillates())
      mode.zeta = -mode.lambda.real() / std::abs(mode.lambda);
    else if (mode.w > 0)
      mode.zeta = std::max(1.0, LossRatio(linear, x, mode.w));
    mode.out_of_plane = x.dot(directions.OutOfPlane(x));
    mode.torsion = directions.Torsion(x);
    mode.in_plane = std::max(0.0, 1 - mode.out_of_plane - mode.torsion);
    ShareElasticEnergy(linear, x, &mode);
    mode.kind = KindOf(mode);
    SetShape(linear, directions, x, &mode);
  }
  return modes;
}

}  // namespace cosserat_cable::rod
