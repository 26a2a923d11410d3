// faults.base_motion: a clamp moves otherwise than its file says. In this order: a factor on the
// motion about its mean and a shift in time (phase over the dominant frequency, the highest of the
// spectrum under Hann's window), a bracket, a constant tilt in the clamp's own frame, R(t)
// exp(tilt). The bracket is a mass on a spring and a dashpot to the moving base, x'' + 2 D w (x' -
// u') + w^2 (x - u) = 0, from rest on the base, by RK4 in steps of a fortieth of its period.
// bracket.frequency 0: none. Factor and bracket act on the position and on the rotation vector from
// the mean; the latter's rate is taken for the angular velocity, which holds for a motion about one
// axis, as all excitations here are.

#include <algorithm>
#include <cmath>

#include "../rotation_vector.h"
#include "kinds.h"

namespace cosserat_cable::generator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

using Vector6d = Eigen::Matrix<double, 6, 1>;

constexpr int kSamples = 2000;

/// Position and rotation vector from a mean, as plain displacements.
struct Displacement {
  Vector6d x, v, a;
};
using DisplacementCurve = std::function<Displacement(double t)>;

DisplacementCurve displacements(const FrameCurve& told, const Matrix3d& R_mean) {
  return [told, R_mean](double t) {
    const FrameMotion m = told(t);
    Displacement d;
    d.x << m.p, rotationVectorOf(R_mean.transpose() * m.R);
    d.v << m.v, R_mean.transpose() * m.w;
    d.a << m.a, R_mean.transpose() * m.alpha;
    return d;
  };
}

Vector6d meanOf(const DisplacementCurve& curve, double end) {
  Vector6d sum = Vector6d::Zero();
  for (int i = 0; i < kSamples; ++i) sum += curve(end * (i + 0.5) / kSamples).x;
  return sum / kSamples;
}

/// The frequency [rad/s] of the highest line.
double dominantFrequency(const DisplacementCurve& curve, double end) {
  const double turn = 2.0 * std::acos(-1.0);
  const Vector6d mean = meanOf(curve, end);
  Eigen::Matrix<double, 6, Eigen::Dynamic> x(6, kSamples);
  for (int i = 0; i < kSamples; ++i) {
    const double part = (i + 0.5) / kSamples, window = std::sin(0.5 * turn * part);
    x.col(i) = window * window * (curve(end * part).x - mean);
  }
  const auto power = [&](double w) {
    Vector6d c = Vector6d::Zero(), s = Vector6d::Zero();
    for (int i = 0; i < kSamples; ++i) {
      const double phase = w * end * (i + 0.5) / kSamples;
      c += std::cos(phase) * x.col(i);
      s += std::sin(phase) * x.col(i);
    }
    return c.squaredNorm() + s.squaredNorm();
  };
  double best = 0.0, largest = 0.0;
  const auto look = [&](double w) {
    const double height = power(w);
    if (height > largest) largest = height, best = w;
  };
  for (int line = 2; line < kSamples / 8; ++line) look(0.5 * turn * line / end);
  for (double step = 0.25; step > 1e-3; step *= 0.5) {
    const double middle = best;
    look(middle - step * turn / end);
    look(middle + step * turn / end);
  }
  return best;
}

/// Displacement of a bracket on its base, tabulated.
class Bracket {
 public:
  Bracket(const DisplacementCurve& base, double w, double ratio, double end)
      : base_(base), w_(w), ratio_(ratio) {
    const double period = 2.0 * std::acos(-1.0) / w;
    const int steps = static_cast<int>(std::ceil(end / std::min(period / 40.0, 1e-3)));
    h_ = end / steps;
    const Displacement start = base(0.0);
    path_.push_back({start.x, start.v});
    for (int i = 0; i < steps + 2; ++i) path_.push_back(step(i * h_, path_.back(), h_));
  }

  Displacement operator()(double t) const {
    const int i = std::clamp(static_cast<int>(t / h_), 0, static_cast<int>(path_.size()) - 2);
    // One more step from the table: smooth in t, with the law's own acceleration.
    const Path now = step(i * h_, path_[i], t - i * h_);
    return {now.x, now.v, rate(t, now).v};
  }

 private:
  struct Path {
    Vector6d x, v;
  };
  Path rate(double t, const Path& y) const {
    const Displacement u = base_(t);
    return {y.v, -2.0 * ratio_ * w_ * (y.v - u.v) - w_ * w_ * (y.x - u.x)};
  }
  static Path moved(const Path& y, double h, const Path& rate) {
    return {y.x + h * rate.x, y.v + h * rate.v};
  }
  Path step(double t, const Path& y, double h) const {
    const Path a = rate(t, y), b = rate(t + 0.5 * h, moved(y, 0.5 * h, a)),
               c = rate(t + 0.5 * h, moved(y, 0.5 * h, b)), d = rate(t + h, moved(y, h, c));
    return {y.x + h / 6.0 * (a.x + 2.0 * b.x + 2.0 * c.x + d.x),
            y.v + h / 6.0 * (a.v + 2.0 * b.v + 2.0 * c.v + d.v)};
  }

  DisplacementCurve base_;
  double w_, ratio_, h_ = 0.0;
  std::vector<Path> path_;
};

class BaseMotion : public Effect {
 public:
  explicit BaseMotion(const EffectValues& values) : values_(values) {}

  FrameCurve clampMotion(int end_of_rod, const FrameCurve& told, double end,
                         bool moves) const override {
    const std::string prefix = end_of_rod == 0 ? "a." : "b.";
    if (values_.count(prefix + "amplitude") == 0) return told;
    FrameCurve curve = told;
    if (moves) {
      const double factor = valueOf(values_, prefix + "amplitude");
      const double phase = valueOf(values_, prefix + "phase");
      const double hertz = valueOf(values_, prefix + "bracket.frequency");
      const Matrix3d R_mean = told(0.0).R;  // near it; the mean itself is among the displacements
      const DisplacementCurve plain = displacements(told, R_mean);
      const double shift = phase == 0.0 ? 0.0 : phase / dominantFrequency(plain, end);
      const Vector6d mean = meanOf(plain, end);
      DisplacementCurve moved = [plain, factor, shift, mean](double t) {
        Displacement d = plain(t + shift);
        d.x = mean + factor * (d.x - mean);
        d.v *= factor;
        d.a *= factor;
        return d;
      };
      if (hertz > 0.0) {
        moved = Bracket(moved, 2.0 * std::acos(-1.0) * hertz,
                        valueOf(values_, prefix + "bracket.damping"), end);
      }
      curve = [moved, R_mean](double t) {
        const Displacement d = moved(t);
        FrameMotion m;
        m.p = d.x.head<3>();
        m.R = R_mean * RotationVector(d.x.tail<3>()).R;
        m.v = d.v.head<3>();
        m.w = R_mean * d.v.tail<3>();
        m.a = d.a.head<3>();
        m.alpha = R_mean * d.a.tail<3>();
        return m;
      };
    }
    const Vector3d tilt(valueOf(values_, prefix + "tilt[0]"), valueOf(values_, prefix + "tilt[1]"),
                        valueOf(values_, prefix + "tilt[2]"));
    if (tilt.norm() == 0.0) return curve;
    const Matrix3d R = Eigen::AngleAxisd(tilt.norm(), tilt.normalized()).toRotationMatrix();
    return [curve, R](double t) {
      FrameMotion m = curve(t);
      m.R = m.R * R;
      return m;
    };
  }

 private:
  EffectValues values_;
};

EffectValues defaults(const EffectScale&, double size) {
  return {{"a.amplitude", 1.0 + 0.1 * size},
          {"a.phase", 0.06 * size},
          {"a.bracket.frequency", 0.0},
          {"a.bracket.damping", 0.1},
          {"a.tilt[0]", 0.004 * size},
          {"a.tilt[1]", -0.003 * size},
          {"a.tilt[2]", 0.0}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite&) {
  return std::make_unique<BaseMotion>(values);
}

}  // namespace

const EffectKind kBaseMotion = {"base_motion", "faults.base_motion", defaults, make};

}  // namespace cosserat_cable::generator
