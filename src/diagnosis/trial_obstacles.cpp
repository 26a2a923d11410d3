#include "trial_obstacles.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "probe.h"

namespace cosserat_cable {
namespace {

using Eigen::Vector3d;
using Role = HypothesisNumber::Role;

constexpr double kPi = 3.14159265358979323846;
constexpr int kStations = 10;    // along the cable
constexpr int kDirections = 12;  // of planes, around it
// How far into the motion an obstacle reaches first, from its end to its middle: then as far as
// shows faintly.
constexpr double kDepth = 0.05;
// How far they reach where they are tried as a whole, likewise.
constexpr double kWholeDepths[] = {0.15, 0.3, 0.45, 0.6, 0.8};
constexpr int kPegStations[] = {4, 7, 10};
constexpr double kPegRadius = 0.003;  // [m]
// Steps of one, from one tried as a whole to those around it: [rad], and by the cable's length.
constexpr double kTurned = 0.12, kMoved = 0.02;
// How small they become, by the first; and how many.
constexpr double kSmallestStep = 0.1;
constexpr int kRounds = 10;

/// Where the cable comes in one experiment: in clamp a's frame, a row per sample, x y z of each
/// station after the other.
struct Sweep {
  Eigen::MatrixXd rows;
  double diameter = 0;

  Eigen::MatrixX3d Station(int k) const { return rows.middleCols<3>(3 * (k - 1)); }
};

std::optional<Sweep> SweepOf(const Experiment& experiment, const Specimen& specimen) {
  std::vector<Channel> channels;
  for (int k = 1; k <= kStations; ++k)
    for (const int axis : {0, 1, 2}) {
      Channel channel;
      channel.column = "position";
      channel.s = specimen.cable.length * k / kStations;
      channel.axis = axis;
      channel.in_frame_a = true;
      channels.push_back(channel);
    }
  const SimulatedRecord found = Probe(experiment, specimen, channels);
  if (!found.ok || found.values.rows() < 2) return std::nullopt;
  return Sweep{found.values, specimen.cable.diameter};
}

double Azimuth(const Vector3d& v) { return std::atan2(v.y(), v.x()); }
double Elevation(const Vector3d& v) { return std::asin(std::clamp(v.z(), -1.0, 1.0)); }

Trial TrialOf(std::vector<HypothesisNumber> numbers) {
  Trial trial;
  trial.cause = "contact";
  trial.components.emplace_back();
  trial.components.back().numbers = std::move(numbers);
  trial.components.back().one_sided = true;
  trial.components.back().size = kDepth;
  return trial;
}

/// One that is there as a whole, at `depth` of what a faint one grows to.
Trial AsAWhole(Trial faint, double depth) {
  for (TrialComponent& component : faint.components)
    for (HypothesisNumber& number : component.numbers) {
      if (number.role != Role::kSize) continue;
      number.times = number.origin + depth * number.times;
      number.origin = 0;
      number.role = Role::kFree;
    }
  return faint;
}

/// Grows from where it just touches to `reach` beyond.
Trial Plane(const Vector3d& normal, double touches, double reach) {
  const std::string path = "extensions.contact.plane.";
  return TrialOf({{path + "azimuth", Role::kFree, Azimuth(normal), NumberScale::kOne},
                  {path + "elevation", Role::kFree, Elevation(normal), NumberScale::kOne},
                  {path + "offset", Role::kSize, reach, NumberScale::kOne, touches}});
}

Trial Peg(const Vector3d& touches, const Vector3d& reach, const Vector3d& axis) {
  const std::string path = "extensions.contact.peg.";
  return TrialOf({{path + "x", Role::kSize, reach.x(), NumberScale::kOne, touches.x()},
                  {path + "y", Role::kSize, reach.y(), NumberScale::kOne, touches.y()},
                  {path + "z", Role::kSize, reach.z(), NumberScale::kOne, touches.z()},
                  {path + "azimuth", Role::kHeld, Azimuth(axis), NumberScale::kOne},
                  {path + "elevation", Role::kHeld, Elevation(axis), NumberScale::kOne},
                  {path + "radius", Role::kHeld, kPegRadius, NumberScale::kOne}});
}

void AddPlanes(const std::vector<Sweep>& sweeps, std::vector<Trial>* trials) {
  for (int k = 0; k < kDirections; ++k) {
    const double azimuth = 2 * kPi * k / kDirections;
    const Vector3d normal(std::cos(azimuth), std::sin(azimuth), 0);
    std::vector<double> along;
    for (const Sweep& sweep : sweeps)
      for (int s = 1; s <= kStations; ++s) {
        const Eigen::VectorXd one = sweep.Station(s) * normal;
        for (const double x : one) along.push_back(x - 0.5 * sweep.diameter);
      }
    const auto middle = along.begin() + static_cast<std::ptrdiff_t>(along.size() / 2);
    std::nth_element(along.begin(), middle, along.end());
    const double half = *middle, least = *std::min_element(along.begin(), along.end());
    trials->push_back(Plane(normal, least, half - least));
  }
}

/// Across the direction in which the station moves most, on both sides of it.
void AddPegs(const Sweep& sweep, std::vector<Trial>* trials) {
  for (const int s : kPegStations) {
    const Eigen::MatrixX3d points = sweep.Station(s);
    const Vector3d mean = points.colwise().mean();
    const Eigen::MatrixX3d about = points.rowwise() - mean.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(about.transpose() * about);
    const Vector3d direction = spread.eigenvectors().col(2);
    const Vector3d before =
        s > 1 ? Vector3d(sweep.Station(s - 1).colwise().mean()) : Vector3d(Vector3d::Zero());
    const Vector3d axis = direction.cross(mean - before).normalized();
    if (!axis.allFinite()) continue;
    for (const double side : {1.0, -1.0}) {
      const double farthest = (side * (about * direction)).maxCoeff();
      trials->push_back(
          Peg(mean + side * (farthest + 0.5 * sweep.diameter + kPegRadius) * direction,
              -side * farthest * direction, axis));
    }
  }
}

}  // namespace

std::vector<Trial> TrialObstacles(const FitProblem& problem, const FitPoint& at, bool whole) {
  const auto& experiments = problem.unknowns().set().experiments;
  std::vector<Sweep> sweeps;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    Problems problems;
    const Specimen specimen =
        problem.unknowns().MakeSpecimen(static_cast<int>(e), at.values, &problems);
    if (!problems.empty()) continue;
    if (std::optional<Sweep> sweep = SweepOf(experiments[e], specimen))
      sweeps.push_back(std::move(*sweep));
  }
  std::vector<Trial> trials;
  if (sweeps.empty()) return trials;
  AddPlanes(sweeps, &trials);
  const auto widest =
      std::max_element(sweeps.begin(), sweeps.end(), [](const Sweep& a, const Sweep& b) {
        const auto motion = [](const Sweep& sweep) {
          const Eigen::MatrixX3d end = sweep.Station(kStations / 2);
          return (end.rowwise() - end.colwise().mean()).rowwise().norm().maxCoeff();
        };
        return motion(a) < motion(b);
      });
  AddPegs(*widest, &trials);
  if (!whole) return trials;
  const std::vector<Trial> faint = trials;
  for (const Trial& one : faint)
    for (const double depth : kWholeDepths) trials.push_back(AsAWhole(one, depth));
  return trials;
}

std::vector<Trial> ObstaclesAround(const Trial& whole, double step, double length) {
  std::vector<Trial> around = {whole};
  for (const HypothesisNumber& moved : whole.components.front().numbers) {
    if (moved.role != Role::kFree) continue;
    const bool is_angle = moved.path.find("azimuth") != std::string::npos ||
                          moved.path.find("elevation") != std::string::npos;
    const double by = step * (is_angle ? kTurned : kMoved * length);
    const std::vector<Trial> before = around;
    for (const Trial& one : before)
      for (const double side : {-1.0, 1.0}) {
        Trial other = one;
        for (HypothesisNumber& number : other.components.front().numbers)
          if (number.path == moved.path) number.times += side * by;
        around.push_back(other);
      }
  }
  return around;
}

Screened BestObstacleNear(const FitProblem& problem, const FitPoint& at, const Screened& whole,
                          double step, double length) {
  Screened best = whole;
  const double smallest = kSmallestStep * step;
  for (int round = 0; round < kRounds && step > smallest; ++round) {
    std::vector<Screened> around = Screen(problem, at, ObstaclesAround(best.trial, step, length));
    if (!around.empty() && around.front().drop > best.drop)
      best = std::move(around.front());
    else
      step /= 2;
  }
  return best;
}

}  // namespace cosserat_cable
