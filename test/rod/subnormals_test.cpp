// A cable that comes to rest must not cost more than one in motion: within a step, numbers too small
// for a processor's normal arithmetic are zero. Outside of it, the caller's arithmetic is untouched.
#include <gtest/gtest.h>

#include <limits>

#include "cosserat_cable/rod/rod_batch.h"
#include "rod/rod_cases.h"

namespace cosserat_cable::rod {
namespace {

constexpr double kDt = 1e-3;
const Pose kA;
const Pose kB{{0.1, 0, 0}, Eigen::Quaterniond(0, 0, 1, 0)};

bool KeepsSubnormals() {
  volatile double smallest = std::numeric_limits<double>::min();
  return smallest / 2 > 0;
}

/// No load, but it sees the arithmetic in which a step evaluates loads.
class ArithmeticProbe : public Load {
 public:
  void Evaluate(const Centreline&, LoadSink*) const override {
    evaluated = true;
    keeps_subnormals |= KeepsSubnormals();
  }
  double Energy(const Centreline&) const override { return 0; }
  mutable bool evaluated = false, keeps_subnormals = false;
};

Rod Settled() {
  const RodModel model = RoundCable(0.2, 0.008, 0.15, 0.008, 0.006, 1e-4, 5e-5, 20);
  Rod rod(model);
  rod.SetConfiguration(BowedShape(kA, kB, model.length, model.elements, model.gravity));
  EXPECT_TRUE(rod.Equilibrate().converged);
  return rod;
}

void ExpectFlushed(const ArithmeticProbe& probe) {
  EXPECT_TRUE(probe.evaluated);
  EXPECT_FALSE(probe.keeps_subnormals);
  EXPECT_TRUE(KeepsSubnormals());
}

TEST(Subnormals, AreZeroWithinAStep) {
  Rod rod = Settled();
  const ArithmeticProbe probe;
  ASSERT_TRUE(rod.Step(kDt, kA, kB, &probe).converged);
  ExpectFlushed(probe);
}

TEST(Subnormals, AreZeroWithinAStepInLanes) {
  Rod first = Settled(), second = first;
  RodBatch batch({&first, &second});
  const ArithmeticProbe probe;
  batch.Step(kDt, {{&kA, &kB, &probe}, {&kA, &kB, &probe}});
  ExpectFlushed(probe);
}

}  // namespace
}  // namespace cosserat_cable::rod
