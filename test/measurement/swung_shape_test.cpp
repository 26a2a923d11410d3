// Unknown starts: what a swing of a mode's shape is at the record's first instant, and right after.
#include <gtest/gtest.h>

#include <cmath>

#include "cosserat_cable/measurement/experiment_simulation.h"
#include "rigs.h"

namespace cosserat_cable {
namespace {

using testing::CableSpecimen;
using testing::ChannelAt;

constexpr int kElements = 20, kShapes = 3;
constexpr double kAmplitude = 1e-4;  // small: [m], of a shape's largest displacement of 1 m
constexpr double kStep = 1e-3;       // [s]
constexpr int kPlaces = 4;

/// An arch that sags between two clamps; their section frames are turned against the world's.
/// Where `rolls` is set, nothing holds either end about its axis.
Experiment Arch(bool rolls) {
  Experiment experiment;
  experiment.name = "arch";
  experiment.a.pose.q = Eigen::AngleAxisd(2.6, Eigen::Vector3d(0.1, 1, 0.3).normalized());
  experiment.b.kind = EndCondition::Kind::kClamp;
  experiment.b.pose.p = {0.12, 0.03, 0.01};
  experiment.b.pose.q = Eigen::AngleAxisd(0.5, Eigen::Vector3d(0.2, 1, -0.1).normalized());
  experiment.a.roll_unknown = experiment.b.roll_unknown = rolls;
  experiment.start.kind = StartCondition::Kind::kUnknown;
  const double L = CableSpecimen().cable.length;
  for (int place = 1; place <= kPlaces; ++place)
    for (int axis = 0; axis < 3; ++axis)
      experiment.channels.push_back(
          ChannelAt(L * place / (kPlaces + 1), Quantity::kPosition, axis));
  testing::SampleEvenly(0.02, 21, &experiment);
  return experiment;
}

Eigen::MatrixXd Simulated(const Experiment& experiment, const SwingShape& shape, double amplitude) {
  Specimen specimen = CableSpecimen();
  const auto scaled = [&](const std::vector<Eigen::Vector3d>& values, double by) {
    std::vector<Eigen::Vector3d> all;
    for (const Eigen::Vector3d& value : values) all.push_back(by * value);
    return all;
  };
  specimen.swing.displacement = scaled(shape.displacement, amplitude);
  specimen.swing.rotation = scaled(shape.rotation, amplitude);
  specimen.swing.velocity = scaled(shape.displacement, 0);
  specimen.swing.angular_velocity = scaled(shape.rotation, 0);
  SimulationOptions options;
  options.elements = kElements;
  options.dt = kStep;
  const SimulatedRecord record = SimulateExperiment(experiment, {specimen}, options).front();
  EXPECT_TRUE(record.ok) << record.message;
  return record.values;
}

/// What an amplitude of one does, by sample and channel; and where the shape has its channels.
struct Moved {
  Eigen::MatrixXd by;
  Eigen::RowVectorXd shape;
};

Moved MovedBy(const Experiment& experiment, const SwingShape& shape) {
  Moved moved;
  moved.by =
      (Simulated(experiment, shape, kAmplitude) - Simulated(experiment, shape, 0)) / kAmplitude;
  moved.shape.resize(moved.by.cols());
  for (Eigen::Index c = 0; c < moved.by.cols(); ++c) {
    const int node = kElements * static_cast<int>(c / 3 + 1) / (kPlaces + 1);
    moved.shape[c] = shape.displacement[static_cast<std::size_t>(node)][c % 3];
  }
  return moved;
}

TEST(SwungShape, BeginsAsTheModeOfACurvedCableIs) {
  // A swing has the mode's turns, not its shear nor the S-shape of its elements: (k h)^2/12 of its
  // displacement and more, k = 31/m the third one's wave number and h = L/20.
  constexpr double kTolerance = 0.1;
  for (const bool rolls : {false, true}) {
    const Experiment experiment = Arch(rolls);
    int seen = 0;
    for (const SwingShape& shape :
         FindSwingShapes(experiment, CableSpecimen(), kElements, kShapes)) {
      const Moved moved = MovedBy(experiment, shape);
      if (moved.shape.norm() < 0.1) continue;  // a turn about the axis
      ++seen;
      EXPECT_LT((moved.by.row(0) - moved.shape).norm(), kTolerance * moved.shape.norm())
          << "rolls " << rolls << ", " << shape.w << " rad/s";
    }
    EXPECT_GE(seen, kShapes - 1);
  }
}

TEST(SwungShape, SwingsOnAsTheModeDoes) {
  // A start that stretches the cable, too, moves it by many times the shape within milliseconds.
  // Beside the tolerance of the start, some of it swings in other modes.
  constexpr double kTolerance = 0.2;
  for (const bool rolls : {false, true}) {
    const Experiment experiment = Arch(rolls);
    for (const SwingShape& shape :
         FindSwingShapes(experiment, CableSpecimen(), kElements, kShapes)) {
      const Moved moved = MovedBy(experiment, shape);
      if (moved.shape.norm() < 0.1) continue;
      for (int sample = 0; sample < moved.by.rows(); ++sample) {
        const double t = experiment.record.t[static_cast<std::size_t>(sample)];
        const double expected = std::cos(shape.w * t) * std::exp(-shape.zeta * shape.w * t);
        EXPECT_LT((moved.by.row(sample) - expected * moved.shape).norm(),
                  kTolerance * moved.shape.norm())
            << "rolls " << rolls << ", " << shape.w << " rad/s, " << t << " s";
      }
    }
  }
}

}  // namespace
}  // namespace cosserat_cable
