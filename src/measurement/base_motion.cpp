#include "base_motion.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "cosserat_cable/math/motion_between.h"
#include "cosserat_cable/math/rotation.h"

namespace cosserat_cable {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;

constexpr double kPi = 3.14159265358979323846;
// How far away rotations are seen, where they are weighed against displacements [m].
constexpr double kLever = 0.1;
// Points of the periodogram.
constexpr int kMostPoints = 8192;
// The bracket's grid: points in its period and between two samples, and of all.
constexpr double kPointsInPeriod = 20, kPointsBetweenSamples = 2, kMostGridPoints = 4e5;

/// Weights of a mean over time of values at these times: the trapezoidal rule.
std::vector<double> TimeWeights(const std::vector<double>& t) {
  const std::size_t count = t.size();
  std::vector<double> weights(count, 1.0);
  if (count < 2) return weights;
  const double whole = t.back() - t.front();
  for (std::size_t i = 0; i < count; ++i)
    weights[i] = 0.5 * (t[std::min(i + 1, count - 1)] - t[i > 0 ? i - 1 : 0]) / whole;
  return weights;
}

Vector3d TurnFrom(const Pose& mean, const Pose& pose) {
  return RotationLog(mean.q.conjugate() * pose.q);
}

/// Displacements from the mean, and rotation vectors as seen a lever away, at even times.
Eigen::Matrix<double, Eigen::Dynamic, 6> EvenlySampled(const ClampMotion& motion, int count) {
  const Pose mean = MeanPose(motion);
  std::vector<Vector6d> rows;
  for (const Pose& pose : motion.poses) {
    rows.emplace_back();
    rows.back() << pose.p - mean.p, kLever * TurnFrom(mean, pose);
  }
  Eigen::Matrix<double, Eigen::Dynamic, 6> even(count, 6);
  const double step = (motion.t.back() - motion.t.front()) / (count - 1);
  std::size_t right = 1;
  for (int i = 0; i < count; ++i) {
    const double t = motion.t.front() + i * step;
    while (right + 1 < motion.t.size() && motion.t[right] < t) ++right;
    const double from = motion.t[right - 1], to = motion.t[right];
    const double x = std::clamp((t - from) / (to - from), 0.0, 1.0);
    even.row(i) = (rows[right - 1] + x * (rows[right] - rows[right - 1])).transpose();
  }
  return even;
}

/// In place: the discrete Fourier transform of a power of two of values (Cooley and Tukey 1965).
void Transform(std::vector<std::complex<double>>* values) {
  const std::size_t count = values->size();
  if (count < 2) return;
  std::vector<std::complex<double>> even, odd;
  for (std::size_t i = 0; i < count; i += 2) {
    even.push_back((*values)[i]);
    odd.push_back((*values)[i + 1]);
  }
  Transform(&even);
  Transform(&odd);
  for (std::size_t k = 0; k < count / 2; ++k) {
    const auto turned =
        std::polar(1.0, -2 * kPi * static_cast<double>(k) / static_cast<double>(count)) * odd[k];
    (*values)[k] = even[k] + turned;
    (*values)[k + count / 2] = even[k] - turned;
  }
}

using Matrix5d = Eigen::Matrix<double, 5, 5>;

/// By its series, of a small part of the matrix, squared again and again.
Matrix5d Exponential(const Matrix5d& matrix) {
  int halvings = 0;
  while (std::ldexp(matrix.cwiseAbs().rowwise().sum().maxCoeff(), -halvings) > 0.5) ++halvings;
  const Matrix5d part = std::ldexp(1.0, -halvings) * matrix;
  Matrix5d sum = Matrix5d::Identity(), term = Matrix5d::Identity();
  for (int n = 1; n <= 16; ++n) {
    term = (term * part / n).eval();
    sum += term;
  }
  for (int k = 0; k < halvings; ++k) sum = (sum * sum).eval();
  return sum;
}

}  // namespace

Pose MeanPose(const ClampMotion& motion) {
  constexpr int kRounds = 20;
  constexpr double kThere = 1e-14;  // [rad]
  const std::vector<double> weights = TimeWeights(motion.t);
  Pose mean{Vector3d::Zero(), motion.poses.front().q};
  for (std::size_t i = 0; i < weights.size(); ++i) mean.p += weights[i] * motion.poses[i].p;
  for (int round = 0; round < kRounds; ++round) {
    Vector3d turn = Vector3d::Zero();
    for (std::size_t i = 0; i < weights.size(); ++i)
      turn += weights[i] * TurnFrom(mean, motion.poses[i]);
    mean.q = (mean.q * RotationExp(turn)).normalized();
    if (turn.norm() < kThere) break;
  }
  return mean;
}

std::vector<Pose> Amplified(const ClampMotion& motion, double factor) {
  const Pose mean = MeanPose(motion);
  std::vector<Pose> poses;
  for (const Pose& pose : motion.poses)
    poses.push_back({mean.p + factor * (pose.p - mean.p),
                     (mean.q * RotationExp(factor * TurnFrom(mean, pose))).normalized()});
  return poses;
}

double DominantFrequency(const ClampMotion& motion) {
  const int count = std::min<int>(kMostPoints, static_cast<int>(motion.t.size()));
  if (count < 4) return 0;
  Eigen::Matrix<double, Eigen::Dynamic, 6> even = EvenlySampled(motion, count);
  // Hann's window, and zeros behind, so that a peak between two frequencies is met.
  for (int i = 0; i < count; ++i) even.row(i) *= std::pow(std::sin(kPi * i / (count - 1)), 2);
  int padded = 1;
  while (padded < 4 * count) padded *= 2;
  std::vector<double> power(static_cast<std::size_t>(padded / 2), 0.0);
  for (int c = 0; c < 6; ++c) {
    std::vector<std::complex<double>> signal(static_cast<std::size_t>(padded));
    for (int i = 0; i < count; ++i) signal[static_cast<std::size_t>(i)] = even(i, c);
    Transform(&signal);
    for (std::size_t k = 0; k < power.size(); ++k) power[k] += std::norm(signal[k]);
  }
  // What is slower than the record is its mean.
  const std::size_t slowest = static_cast<std::size_t>(padded / count);
  const auto peak = static_cast<std::size_t>(
      std::max_element(power.begin() + static_cast<std::ptrdiff_t>(slowest), power.end() - 1) -
      power.begin());
  if (!(power[peak] > 0)) return 0;
  double place = static_cast<double>(peak);
  const double left = std::log(power[peak - 1]), here = std::log(power[peak]),
               right = std::log(power[peak + 1]);
  if (const double bend = left - 2 * here + right; bend < 0) place += 0.5 * (left - right) / bend;
  const double step = (motion.t.back() - motion.t.front()) / (count - 1);
  return 2 * kPi * place / (padded * step);
}

BracketPath::BracketPath(PoseCurve path, double shift, const Pose& mean, double sample,
                         double begin, double end, const ClampMotionFault& fault)
    : begin_(begin) {
  const double w = 2 * kPi * fault.bracket_frequency, zeta = fault.bracket_damping;
  const double wanted = std::max(
      {std::min(1 / (kPointsInPeriod * fault.bracket_frequency), sample / kPointsBetweenSamples),
       (end - begin) / kMostGridPoints, 1e-9});
  const int steps = std::max(1, static_cast<int>(std::ceil((end - begin) / wanted)));
  h_ = (end - begin) / steps;

  // z = y - u: z'' + 2 zeta w z' + w^2 z = -u''. The parabola -u'' is that of three states which
  // drive z and z'; the exponential of all five over a step is its exact solution.
  Matrix5d system = Matrix5d::Zero();
  system(0, 1) = 1;
  system.row(1) << -w * w, -2 * zeta * w, 1, 0, 0;
  system(2, 3) = system(3, 4) = 1;
  const Matrix5d over_step = Exponential(h_ * system);

  struct Input {
    Vector6d value, rate, acceleration;
  };
  const auto input = [&](double t) {
    const Motion m = path.Follow(t + shift);
    const Vector3d phi = TurnFrom(mean, m.X);
    const ChartRates rates = ToChartRates(phi, {m.omega, m.alpha});
    Input u;
    u.value << m.X.p, phi;
    u.rate << m.v, rates.d_phi;
    u.acceleration << m.a, rates.dd_phi;
    return u;
  };
  Eigen::Matrix<double, 5, 6> state = Eigen::Matrix<double, 5, 6>::Zero();
  Input now = input(begin);
  points_.reserve(static_cast<std::size_t>(steps) + 1);
  for (int k = 0;; ++k) {
    const Vector6d z = state.row(0).transpose(), dz = state.row(1).transpose();
    const Vector6d y = now.value + z, dy = now.rate + dz, ddy = -2 * zeta * w * dz - w * w * z;
    Motion point;
    point.X = {y.head<3>(), (mean.q * RotationExp(y.tail<3>())).normalized()};
    point.v = dy.head<3>();
    point.a = ddy.head<3>();
    const BodyRates body = ToBodyRates(y.tail<3>(), {dy.tail<3>(), ddy.tail<3>()});
    point.omega = body.omega;
    point.alpha = body.alpha;
    points_.push_back(point);
    if (k == steps) break;
    const Input middle = input(begin + (k + 0.5) * h_), next = input(begin + (k + 1) * h_);
    const Vector6d from = -now.acceleration, half = -middle.acceleration, to = -next.acceleration;
    state.row(2) = from.transpose();
    state.row(3) = ((-3 * from + 4 * half - to) / h_).transpose();
    state.row(4) = (4 * (from - 2 * half + to) / (h_ * h_)).transpose();
    state = (over_step * state).eval();
    now = next;
  }
}

Motion BracketPath::At(double t) const {
  const double x = (t - begin_) / h_;
  if (x <= 0) return x < 0 ? Motion::Resting(points_.front().X) : points_.front();
  const auto last = static_cast<double>(points_.size() - 1);
  if (x >= last) return x > last ? Motion::Resting(points_.back().X) : points_.back();
  const auto i = static_cast<std::size_t>(x);
  return MotionBetween(points_[i], points_[i + 1], h_, t - (begin_ + static_cast<double>(i) * h_));
}

}  // namespace cosserat_cable
