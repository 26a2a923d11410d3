#include "excitation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace cosserat_cable::generator {
namespace {

/// A value with two derivatives by time.
struct Jet {
  double x = 0.0, v = 0.0, a = 0.0;
};

Jet operator*(const Jet& f, const Jet& g) {
  return {f.x * g.x, f.v * g.x + f.x * g.v, f.a * g.x + 2.0 * f.v * g.v + f.x * g.a};
}

/// Rises from 0 to 1 with two derivatives zero at both ends.
Jet onset(double t, double duration) {
  const double x = std::clamp(t / duration, 0.0, 1.0), h = 1.0 / duration;
  if (x >= 1.0) return {1.0, 0.0, 0.0};
  return {x * x * x * (10.0 - 15.0 * x + 6.0 * x * x), 30.0 * x * x * (1.0 - x) * (1.0 - x) * h,
          60.0 * x * (1.0 - x) * (1.0 - 2.0 * x) * h * h};
}

}  // namespace

FrameCurve excite(const Excitation& e) {
  return [e](double t) {
    const double turn = 2.0 * std::acos(-1.0);
    Jet sum;
    for (const ExcitationLine& line : e.lines) {
      const double rate = turn * (line.last_frequency - line.frequency) / e.duration;
      const double phase = line.phase + turn * line.frequency * t + 0.5 * rate * t * t;
      const double w = turn * line.frequency + rate * t;
      const double s = std::sin(phase), c = std::cos(phase);
      sum.x += line.amplitude * s;
      sum.v += line.amplitude * w * c;
      sum.a += line.amplitude * (rate * c - w * w * s);
    }
    const Jet d = onset(t, e.onset) * sum;
    FrameMotion m = e.start;
    m.p += d.x * e.direction;
    m.v = d.v * e.direction;
    m.a = d.a * e.direction;
    m.R = Eigen::AngleAxisd(e.turn * d.x, e.axis).toRotationMatrix() * e.start.R;
    m.w = e.turn * d.v * e.axis;
    m.alpha = e.turn * d.a * e.axis;
    return m;
  };
}

double largestDisplacement(const Excitation& e) {
  double sum = 0.0;
  for (const ExcitationLine& line : e.lines) sum += line.amplitude;
  return sum;
}

}  // namespace cosserat_cable::generator
