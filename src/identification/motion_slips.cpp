// How a clamp may move otherwise than its motion file says, as people mistake it.
#include <algorithm>
#include <cmath>
#include <utility>

#include "cosserat_cable/measurement/w_first.h"
#include "input_slips.h"

namespace cosserat_cable {
namespace {

// Motions of one amplitude are taken for those of another no further apart.
constexpr double kLeastOfMotion = 0.7, kMostOfMotion = 1.43;
// Of the motion's size: what changes it by less changes nothing.
constexpr double kChange = 1e-6;

using Poses = std::vector<Pose>;
using Change = std::function<void(double factor, Poses*)>;

double LargestChange(const Poses& a, const Poses& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max({largest, (a[i].p - b[i].p).norm(), a[i].q.angularDistance(b[i].q)});
  return largest;
}

/// Displacements from the first pose, changed.
Change Displaced(const std::function<Eigen::Vector3d(double, const Eigen::Vector3d&)>& change) {
  return [change](double factor, Poses* poses) {
    const Eigen::Vector3d first = poses->front().p;
    for (Pose& pose : *poses) pose.p = first + change(factor, pose.p - first);
  };
}

/// Turns from the first pose, in the world's axes, changed.
Change Turned(const std::function<Eigen::Quaterniond(const Eigen::Quaterniond&)>& change) {
  return [change](double, Poses* poses) {
    const Eigen::Quaterniond first = poses->front().q;
    for (Pose& pose : *poses) pose.q = (change(pose.q * first.conjugate()) * first).normalized();
  };
}

/// The turn as seen in a mirror across the axis.
Eigen::Quaterniond MirroredTurn(const Eigen::Quaterniond& q, int axis) {
  Eigen::Vector3d v = -q.vec();
  v[axis] *= -1;
  Eigen::Quaterniond mirrored;
  mirrored.w() = q.w();
  mirrored.vec() = v;
  return mirrored;
}

/// Displacements and turns from the first pose, times a factor.
void Amplify(double factor, Poses* poses) {
  const Pose first = poses->front();
  for (Pose& pose : *poses) {
    pose.p = first.p + factor * (pose.p - first.p);
    const Eigen::AngleAxisd turn(pose.q * first.q.conjugate());
    pose.q = (Eigen::AngleAxisd(factor * turn.angle(), turn.axis()) * first.q).normalized();
  }
}

}  // namespace

void AddMotionSlips(const MeasurementSet& set, std::size_t e, std::vector<InputSlip>* slips) {
  for (EndCondition Experiment::*end : {&Experiment::a, &Experiment::b}) {
    const auto& motion = (set.experiments[e].*end).motion;
    if (!motion || motion->poses.empty()) continue;
    const std::string of =
        std::string("the motion of clamp ") + (end == &Experiment::a ? "a" : "b");
    Poses about = motion->poses;
    for (Pose& pose : about) pose = motion->poses.front();
    const double size = LargestChange(motion->poses, about);
    const auto add = [&](const std::string& text, double factor, const Change& change,
                         double least = 0, double most = 0) {
      Poses changed = motion->poses;
      change(most > 0 ? most : factor, &changed);
      if (!(LargestChange(changed, motion->poses) > kChange * size)) return;
      slips->push_back({"motion", text, factor, "", false, least, most,
                        [e, end, change](double by, MeasurementSet* mended) {
                          change(by, &(mended->experiments[e].*end).motion->poses);
                        }});
    };
    const Change displaced =
        Displaced([](double factor, const Eigen::Vector3d& d) { return factor * d; });
    for (const auto& [factor, unit] : {std::pair<double, const char*>{1e-3, "millimetres"},
                                       {1e-2, "centimetres"},
                                       {0.0254, "inches"},
                                       {1e3, "metres that were taken for millimetres"},
                                       {1e2, "metres that were taken for centimetres"}}) {
      add("with " + of + " in " + unit, factor, [](double by, Poses* poses) {
        for (Pose& pose : *poses) pose.p *= by;
      });
      add("with " + of + " in " + unit + ", from its first pose", factor, displaced);
    }
    for (int axis = 0; axis < 3; ++axis) {
      const std::string name(1, "xyz"[axis]);
      add("with " + of + " along " + name + " turned (sign)", -1,
          Displaced([axis](double factor, Eigen::Vector3d d) {
            d[axis] *= factor;
            return d;
          }));
      const int next = (axis + 1) % 3;
      add("with " + of + " along " + name + " and " + "xyz"[next] + " exchanged", 1,
          Displaced([axis, next](double, Eigen::Vector3d d) {
            std::swap(d[axis], d[next]);
            return d;
          }));
      add("with the turns in " + of + " mirrored across " + name, 1,
          Turned([axis](const Eigen::Quaterniond& q) { return MirroredTurn(q, axis); }));
    }
    add("with the turns in " + of + " the other way", 1,
        Turned([](const Eigen::Quaterniond& q) { return q.conjugate(); }));
    add("with the quaternions of " + of + " inverted", 1, [](double, Poses* poses) {
      for (Pose& pose : *poses) pose.q = pose.q.conjugate();
    });
    add("with the quaternions of " + of + " beginning with w", 1, [](double, Poses* poses) {
      for (Pose& pose : *poses) pose = MeantWithWFirst(pose);
    });
    add("times " + of, 1, Amplify, kLeastOfMotion, kMostOfMotion);
    add("times the displacements in " + of, 1, displaced, kLeastOfMotion, kMostOfMotion);
    for (int axis = 0; axis < 3; ++axis)
      add("times " + of + " along " + "xyz"[axis], 1,
          Displaced([axis](double factor, Eigen::Vector3d d) {
            d[axis] *= factor;
            return d;
          }),
          kLeastOfMotion, kMostOfMotion);
  }
}

}  // namespace cosserat_cable
