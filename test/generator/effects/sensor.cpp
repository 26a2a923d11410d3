// faults.sensor: measured = low pass of R(tilt) scale true, about the world's origin, of all
// channels. The low pass is of first order, starts at rest in the first sample, and is integrated
// exactly for a signal that is straight between dense samples. low_pass: its time constant.

#include <cmath>

#include "kinds.h"

namespace cosserat_cable::generator {
namespace {

class Sensor : public Effect {
 public:
  explicit Sensor(const EffectValues& v)
      : scale_(valueOf(v, "scale")),
        tilt_(valueOf(v, "tilt[0]"), valueOf(v, "tilt[1]"), valueOf(v, "tilt[2]")),
        lag_(valueOf(v, "low_pass")) {}
  bool senses() const override { return true; }

  void sense(double dt, Eigen::Ref<Eigen::MatrixXd> samples) const override {
    samples *= scale_;
    if (samples.cols() == 3 && tilt_.norm() > 0.0) {
      const Eigen::AngleAxisd R(tilt_.norm(), tilt_.normalized());
      samples = (samples * R.toRotationMatrix().transpose()).eval();
    }
    if (lag_ <= 0.0) return;
    // y' = a (x - y) over a step in which x is straight.
    const double x = dt / lag_, decay = std::exp(-x);
    const double now = 1.0 - (1.0 - decay) / x, before = (1.0 - decay) / x - decay;
    Eigen::RowVectorXd y = samples.row(0), last = samples.row(0);
    for (int i = 1; i < samples.rows(); ++i) {
      const Eigen::RowVectorXd next = samples.row(i);
      y = decay * y + before * last + now * next;
      last = next;
      samples.row(i) = y;
    }
  }

 private:
  double scale_;
  Eigen::Vector3d tilt_;
  double lag_;  // [s]
};

EffectValues defaults(const EffectScale& scale, double size) {
  return {{"scale", 1.0 + 0.002 * size},
          {"tilt[0]", 0.0008 * size},
          {"tilt[1]", -0.0012 * size},
          {"tilt[2]", 0.0008 * size},
          {"low_pass", size / (8.0 * scale.frequency)}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite&) {
  return std::make_unique<Sensor>(values);
}

}  // namespace

const EffectKind kSensor = {"sensor", "faults.sensor[0]", defaults, make};

}  // namespace cosserat_cable::generator
