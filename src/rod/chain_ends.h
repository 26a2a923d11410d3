// What the partly held ends of one rod do to a chain.
#pragma once

#include "cosserat_cable/math/rotation.h"
#include "cosserat_cable/math/small_eigen.h"
#include "end_part.h"
#include "lane_access.h"

namespace cosserat_cable::rod {

template <class T>
ChainLayout::Place PlaceOfEnd(const StepChain<T>& chain, int lane, bool at_b) {
  return chain.layout.OfNode(at_b ? chain.layout.elements : 0, lane);
}

/// Moves the end nodes of the iterate to where the clamps let them go, with the velocities that the
/// time scheme makes of that.
template <class T>
void ImposeEnds(const StepCoefficients& c, const EndParts& ends, int lane, StepChain<T>* chain) {
  ends.ForEachActive([&](const EndPart& end, bool at_b) {
    if (!end.holds()) return;
    const ChainLayout::Place at = PlaceOfEnd(*chain, lane, at_b);
    ChainNode<T>& entry = chain->nodes[at.entry];
    Node<double> node = GetLane(entry.at, at.lane);
    NodeRates<double> rate = GetLane(entry.rate, at.lane);
    Node<double> held = node;
    end.ImposePose(&held);
    const Vec3<double> moved = held.r - node.r;
    node.r = held.r;
    node.v += c.velocity_by_increment * moved;
    rate.v += c.rate_by_increment * moved;
    if (end.holds_rotation()) {
      const Eigen::Quaterniond q0 = ToEigen(GetLane(entry.q0, at.lane));
      const Vec3<double> turn =
          ToSmall(RotationLog((q0.conjugate() * ToEigen(held.q)).normalized()));
      const Vec3<double> turned = turn - GetLane(entry.turn, at.lane);
      node.q = held.q;
      node.omega += c.velocity_by_increment * turned;
      rate.omega += c.rate_by_increment * turned;
      SetLane(&entry.turn, at.lane, turn);
    }
    SetLane(&entry.at, at.lane, node);
    SetLane(&entry.rate, at.lane, rate);
  });
}

/// The attitudes to which ImposeEnds has turned the ends of one rod. A correction finds attitudes
/// from the step's turns again, by rounding elsewhere, in rods that take nothing of it as well: to
/// be put back in those, which would see their neighbours otherwise.
class ImposedAttitudes {
 public:
  template <class T>
  void Keep(const EndParts& ends, int lane, const StepChain<T>& chain) {
    ends.ForEachActive([&](const EndPart&, bool at_b) {
      const ChainLayout::Place at = PlaceOfEnd(chain, lane, at_b);
      q_[at_b] = GetLane(chain.nodes[at.entry].at.q, at.lane);
    });
  }
  template <class T>
  void PutBack(const EndParts& ends, int lane, StepChain<T>* chain) const {
    ends.ForEachActive([&](const EndPart&, bool at_b) {
      const ChainLayout::Place at = PlaceOfEnd(*chain, lane, at_b);
      SetLane(&chain->nodes[at.entry].at.q, at.lane, q_[at_b]);
    });
  }

 private:
  Quat<double> q_[2];  // at a and at b
};

/// Adds the clamps' springs to what loads add. With the tangent, makes what is held go to where the
/// clamps have it, and nowhere else: put there before the first solution, which moves the nodes
/// beside it as well, it would kink the rod.
template <class T>
void AddEnds(const StepCoefficients& c, const EndParts& ends, int lane, bool tangent,
             StepChain<T>* chain) {
  // So much stiffer than anything else that what is held moves by rounding, where ImposeEnds puts
  // it back.
  constexpr double kImmovable = 1e9;
  const auto add = [](double value, int at_lane, T* to) {
    SetLane(to, at_lane, GetLane(*to, at_lane) + value);
  };
  ends.ForEachActive([&](const EndPart& end, bool at_b) {
    const ChainLayout::Place at = PlaceOfEnd(*chain, lane, at_b);
    const ChainNode<T>& entry = chain->nodes[at.entry];
    const Node<double> node = GetLane(entry.at, at.lane);
    const Eigen::Vector3d moment = end.SpringMoment(node);
    for (int k = 0; k < 3; ++k) add(moment[k], at.lane, &chain->load_rhs[at.entry][3 + k]);
    if (!tangent) return;
    const Vec3<double> C_F = GetLane(chain->law.C_F, at.lane),
                       V_F = GetLane(chain->law.V_F, at.lane);
    const Vec3<double> C_M = GetLane(chain->law.C_M, at.lane),
                       V_M = GetLane(chain->law.V_M, at.lane);
    const double h = GetLane(chain->law.h, at.lane);
    const auto largest = [&](const Vec3<double>& C, const Vec3<double>& V) {
      const Vec3<double> sum = C + c.velocity_by_increment * V;
      return std::max(sum.x, std::max(sum.y, sum.z));
    };
    const Vec3<double> inertia = GetLane(chain->masses[at.entry].inertia, at.lane);
    const double force = largest(C_F, V_F);
    const double stiff_r =
        force / h + c.rate_by_increment * GetLane(chain->masses[at.entry].mass, at.lane);
    const double stiff_phi =
        largest(C_M, V_M) / h + force * h +
        c.rate_by_increment * std::max(inertia.x, std::max(inertia.y, inertia.z));
    EndPart::Matrix6 block = EndPart::Matrix6::Identity() - end.FreeProjector(node);
    block.topLeftCorner<3, 3>() *= kImmovable * stiff_r;
    block.bottomRightCorner<3, 3>() *= kImmovable * stiff_phi;
    Node<double> held = node;
    end.ImposePose(&held);
    Eigen::Matrix<double, 6, 1> gap;
    gap << ToEigen(held.r - node.r),
        RotationLog((ToEigen(node.q).conjugate() * ToEigen(held.q)).normalized());
    const Eigen::Matrix<double, 6, 1> pull = block * gap;
    for (int k = 0; k < 6; ++k) add(pull[k], at.lane, &chain->load_rhs[at.entry][k]);
    block.bottomRightCorner<3, 3>() += end.SpringTangent(node, c.velocity_by_increment);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j <= i; ++j)
        add(block(i, j), at.lane, &chain->load_diagonal[at.entry].at(i, j));
  });
}

}  // namespace cosserat_cable::rod
