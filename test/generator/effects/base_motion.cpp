// faults.base_motion: clamp a moves otherwise than its file says. In this order: a factor on the
// motion about its mean and a shift in time (phase over the dominant frequency, the highest line of
// the position's spectrum), a bracket, a constant tilt in the clamp's own frame, R(t) exp(tilt).
// The bracket is a mass on a spring and a dashpot to the moving base:
// x'' + 2 D w (x' - u') + w^2 (x - u) = 0, from rest on the base, in translation only here, by RK4
// in steps of a fortieth of its period. bracket.frequency 0: none. Rotation is neither scaled nor
// filtered.

#include <cmath>

#include "kinds.h"

namespace cosserat_cable::generator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kSamples = 2000;

Vector3d meanPosition(const FrameCurve& told, double end) {
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < kSamples; ++i) sum += told(end * (i + 0.5) / kSamples).p;
  return sum / kSamples;
}

/// The frequency [rad/s] of the highest line.
double dominantFrequency(const FrameCurve& told, double end) {
  const double turn = 2.0 * std::acos(-1.0);
  const Vector3d mean = meanPosition(told, end);
  Eigen::Matrix3Xd x(3, kSamples);
  for (int i = 0; i < kSamples; ++i) x.col(i) = told(end * (i + 0.5) / kSamples).p - mean;
  double best = 0.0, largest = 0.0;
  for (int line = 2; line < kSamples / 8; ++line) {  // half a line apart
    const double w = 0.5 * turn * line / end;
    Vector3d c = Vector3d::Zero(), s = Vector3d::Zero();
    for (int i = 0; i < kSamples; ++i) {
      const double phase = w * end * (i + 0.5) / kSamples;
      c += std::cos(phase) * x.col(i);
      s += std::sin(phase) * x.col(i);
    }
    const double power = c.squaredNorm() + s.squaredNorm();
    if (power > largest) {
      largest = power;
      best = w;
    }
  }
  return best;
}

struct Jet {
  Vector3d x = Vector3d::Zero(), v = Vector3d::Zero();
};

/// Displacement of a bracket on its base, tabulated.
class Bracket {
 public:
  Bracket(const FrameCurve& base, double w, double ratio, double end)
      : base_(base), w_(w), ratio_(ratio) {
    const double kPeriod = 2.0 * std::acos(-1.0) / w;
    const int steps = static_cast<int>(std::ceil(end / std::min(kPeriod / 40.0, 1e-3))) + 2;
    h_ = end / (steps - 2);
    const FrameMotion start = base(0.0);
    path_.push_back({start.p, start.v});
    for (int i = 0; i < steps; ++i) {
      const double t = i * h_;
      const Jet y = path_.back();
      const Jet a = rate(t, y), b = rate(t + 0.5 * h_, moved(y, 0.5 * h_, a)),
                c = rate(t + 0.5 * h_, moved(y, 0.5 * h_, b)), d = rate(t + h_, moved(y, h_, c));
      path_.push_back({y.x + h_ / 6.0 * (a.x + 2.0 * b.x + 2.0 * c.x + d.x),
                       y.v + h_ / 6.0 * (a.v + 2.0 * b.v + 2.0 * c.v + d.v)});
    }
  }

  FrameMotion operator()(double t) const {
    FrameMotion m = base_(t);
    const int i = std::clamp(static_cast<int>(t / h_), 0, static_cast<int>(path_.size()) - 2);
    // One more step of RK4 from the table: smooth in t, with the law's own acceleration.
    const double h = t - i * h_, at = i * h_;
    const Jet y = path_[i];
    const Jet a = rate(at, y), b = rate(at + 0.5 * h, moved(y, 0.5 * h, a)),
              c = rate(at + 0.5 * h, moved(y, 0.5 * h, b)), d = rate(t, moved(y, h, c));
    const Jet now{y.x + h / 6.0 * (a.x + 2.0 * b.x + 2.0 * c.x + d.x),
                  y.v + h / 6.0 * (a.v + 2.0 * b.v + 2.0 * c.v + d.v)};
    m.p = now.x;
    m.v = now.v;
    m.a = rate(t, now).v;
    return m;
  }

 private:
  Jet rate(double t, const Jet& y) const {
    const FrameMotion u = base_(t);
    return {y.v, -2.0 * ratio_ * w_ * (y.v - u.v) - w_ * w_ * (y.x - u.p)};
  }
  static Jet moved(const Jet& y, double h, const Jet& rate) {
    return {y.x + h * rate.x, y.v + h * rate.v};
  }

  FrameCurve base_;
  double w_, ratio_, h_ = 0.0;
  std::vector<Jet> path_;
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
      const double shift = phase == 0.0 ? 0.0 : phase / dominantFrequency(told, end);
      const Vector3d mean = meanPosition(told, end);
      curve = [told, factor, shift, mean](double t) {
        FrameMotion m = told(t + shift);
        m.p = mean + factor * (m.p - mean);
        m.v *= factor;
        m.a *= factor;
        return m;
      };
      const double hertz = valueOf(values_, prefix + "bracket.frequency");
      if (hertz > 0.0) {
        curve = Bracket(curve, 2.0 * std::acos(-1.0) * hertz,
                        valueOf(values_, prefix + "bracket.damping"), end);
      }
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
