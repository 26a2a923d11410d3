#include "design_menu.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/measurement/specimen.h"

namespace cosserat_cable {
namespace {

using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
constexpr double kLengths[] = {0.6, 1.6}, kAmplitudes[] = {0.4, 2.0};
constexpr double kFarthest = 0.97;  // of its length, that an end is pulled away from the clamp
constexpr double kMass = 0.2;       // of the cable's own, at its end
constexpr int kCycleSteps = 48;     // of a slow cycle, twice around
constexpr double kCycleDeflection = 0.25;  // of the length
constexpr double kLonger = 3;              // times the record
// A chirp of clamp a: amplitude by the length, range by the slowest swing's frequency, duration in
// its periods, and samples per period of the fastest.
constexpr double kChirpAmplitude = 0.01, kChirpFrom = 0.5, kChirpTo = 6, kChirpPeriods = 25;
constexpr double kChirpSampling = 12;

Vector3d PositionOfA(const Experiment& experiment) {
  return experiment.a.motion ? experiment.a.motion->poses.front().p : experiment.a.pose.p;
}

double LengthOf(const MeasurementSet& set, const Experiment& experiment) {
  return SpecimenKeys(set, experiment).length.value.value_or(0.1);
}

void SetLength(double length, Experiment* experiment) {
  experiment->specimen.length.value = length;
  experiment->specimen.length.mark = experiment->mark;
}

bool EndIsLoose(const Experiment& experiment) {
  return experiment.b.kind != EndCondition::Kind::kClamp;
}

void Scale(double factor, std::optional<ClampMotion>* motion) {
  if (!*motion) return;
  std::vector<Pose>& poses = (*motion)->poses;
  Vector3d mean = Vector3d::Zero();
  for (const Pose& pose : poses) mean += pose.p / static_cast<double>(poses.size());
  const Eigen::Quaterniond first = poses.front().q;
  for (Pose& pose : poses) {
    pose.p = mean + factor * (pose.p - mean);
    Eigen::AngleAxisd turn(first.conjugate() * pose.q);
    turn.angle() *= factor;
    pose.q = first * Eigen::Quaterniond(turn);
  }
}

void Turn(const Eigen::Quaterniond& in_clamp, EndCondition* end) {
  end->pose.q = end->pose.q * in_clamp;
  if (end->motion)
    for (Pose& pose : end->motion->poses) pose.q = pose.q * in_clamp;
}

class Menu {
 public:
  Menu(const MeasurementSet& set, const MotionScales& scales) : set_(set), scales_(scales) {}

  std::vector<Design> Make() {
    for (std::size_t e = 0; e < set_.experiments.size(); ++e) {
      const Experiment& of = set_.experiments[e];
      if (of.start.kind == StartCondition::Kind::kUnknown) continue;
      like_ = static_cast<int>(e);
      Lengths(of);
      Amplitudes(of);
      Roll(of);
      Orientation(of);
      Mass(of);
      Longer(of);
      if (!of.b.motion && of.b.kind == EndCondition::Kind::kFree && !of.a.motion) {
        SlowCycle(of);
        Chirp(of);
      }
    }
    return std::move(designs_);
  }

 private:
  void Add(const std::string& text, Experiment experiment) {
    experiment.name = "design";
    designs_.push_back({text, like_, std::move(experiment)});
  }
  std::string Again(const Experiment& of) const { return "record '" + of.name + "' again "; }

  void Lengths(const Experiment& of) {
    if (!EndIsLoose(of)) return;
    const double length = LengthOf(set_, of);
    for (const double factor : kLengths) {
      Experiment one = of;
      SetLength(factor * length, &one);
      for (Channel& channel : one.channels) channel.s *= factor;
      const Vector3d a = PositionOfA(of);
      one.start.held.s *= factor;
      one.start.held.position_W = a + factor * (of.start.held.position_W - a);
      Add(Again(of) + "with a specimen of " + FormatRounded(factor * length, 2) + " m", one);
    }
  }

  void Amplitudes(const Experiment& of) {
    const bool held = of.start.kind == StartCondition::Kind::kHeld;
    const bool twisted = of.start.kind == StartCondition::Kind::kTwisted;
    if (!held && !twisted && !of.a.motion && !of.b.motion) return;
    for (const double factor : kAmplitudes) {
      Experiment one = of;
      one.start.twisted *= factor;
      Scale(factor, &one.a.motion);
      Scale(factor, &one.b.motion);
      if (held) {
        // From where the cable would point without being pulled.
        const Vector3d a = PositionOfA(of);
        const Vector3d straight = a + of.a.pose.q * Vector3d(0, 0, of.start.held.s);
        Vector3d there = straight + factor * (of.start.held.position_W - straight) - a;
        const double most = kFarthest * of.start.held.s;
        if (there.norm() > most) there *= most / there.norm();
        one.start.held.position_W = a + there;
      }
      Add(Again(of) + "at " + FormatRounded(factor, 2) + " times the amplitude", one);
    }
  }

  void Roll(const Experiment& of) {
    Experiment one = of;
    const Eigen::Quaterniond quarter(Eigen::AngleAxisd(kPi / 2, Vector3d::UnitZ()));
    Turn(quarter, &one.a);
    Turn(quarter, &one.b);
    Add(Again(of) + "with the cable rolled by 90 degrees in its clamps", one);
  }

  void Orientation(const Experiment& of) {
    if (of.gravity_W.isZero()) return;
    const Vector3d along = of.a.pose.q * Vector3d::UnitZ();
    Vector3d axis = along.cross(of.gravity_W);
    if (axis.norm() < 1e-3 * of.gravity_W.norm()) axis = along.unitOrthogonal();
    Experiment one = of;
    one.gravity_W = Eigen::AngleAxisd(kPi / 2, axis.normalized()) * of.gravity_W;
    Add(Again(of) + "with the whole rig turned by 90 degrees, so that gravity acts otherwise", one);
  }

  void Mass(const Experiment& of) {
    if (of.b.kind != EndCondition::Kind::kFree) return;
    const CableKeys keys = SpecimenKeys(set_, of);
    const double length = LengthOf(set_, of);
    const double mass = kMass * length * keys.mass_per_length.value.value_or(0.05);
    Experiment one = of;
    std::vector<LumpedMassKey> masses = keys.masses.value.value_or(std::vector<LumpedMassKey>());
    masses.push_back({{length, mass}, of.mark});
    one.specimen.masses.value = masses;
    one.specimen.masses.mark = of.mark;
    Add(Again(of) + "with a known mass of " + FormatRounded(1e3 * mass, 2) + " g at the end", one);
  }

  void Longer(const Experiment& of) {
    if (of.quasi_static() || of.a.motion || of.b.motion || of.record.t.size() < 2) return;
    Experiment one = of;
    const double interval = MedianInterval(of.record.t);
    const auto count = static_cast<std::size_t>(kLonger * static_cast<double>(of.record.t.size()));
    one.record.t.clear();
    for (std::size_t i = 0; i < count; ++i)
      one.record.t.push_back(of.record.t.front() + interval * static_cast<double>(i));
    one.record.values = of.record.values.replicate(static_cast<Eigen::Index>(kLonger), 1)
                            .topRows(static_cast<Eigen::Index>(count));
    Add(Again(of) + "for " + FormatRounded(kLonger, 2) + " times as long", one);
  }

  /// The end is pulled to and fro, one equilibrium after the other.
  void SlowCycle(const Experiment& of) {
    Experiment one = of;
    const double length = LengthOf(set_, of);
    const double force = 3 * scales_.EI / std::pow(length, 2) * kCycleDeflection;
    const Vector3d along = of.a.pose.q * Vector3d::UnitZ();
    const Vector3d across =
        (of.gravity_W.isZero() || along.cross(of.gravity_W).norm() < 1e-3 * of.gravity_W.norm())
            ? Vector3d(along.unitOrthogonal())
            : Vector3d(along.cross(of.gravity_W).normalized());
    one.start = StartCondition();
    one.load = ExperimentLoad();
    one.load.file = "load.csv";
    one.load.quasi_static = true;
    one.record.quasi_static = true;
    one.record.t.clear();
    one.channels.clear();
    for (const int axis : {0, 1, 2}) {
      Channel channel;
      channel.column = std::string("tip_") + "xyz"[axis];
      channel.s = length;
      channel.axis = axis;
      one.channels.push_back(channel);
    }
    for (int step = 0; step <= kCycleSteps; ++step) {
      one.record.t.push_back(step);
      ExperimentLoad::Sample sample;
      sample.t = step;
      sample.s = length;
      sample.force_W = force * std::sin(4 * kPi * step / kCycleSteps) * across;
      one.load.samples.push_back(sample);
    }
    one.record.values = Eigen::MatrixXd::Zero(kCycleSteps + 1, 3);
    Add("pull the end of the cable of '" + of.name + "' slowly to and fro, across, by forces of " +
            FormatRounded(force, 2) + " N, and note where it is at rest",
        one);
  }

  void Chirp(const Experiment& of) {
    Experiment one = of;
    const double length = LengthOf(set_, of), f0 = kChirpFrom / scales_.period,
                 f1 = kChirpTo / scales_.period, duration = kChirpPeriods * scales_.period;
    const auto count =
        std::min<std::size_t>(4000, static_cast<std::size_t>(duration * f1 * kChirpSampling));
    const Vector3d across = (of.a.pose.q * Vector3d::UnitZ()).unitOrthogonal();
    one.start = StartCondition();
    one.a.motion.emplace();
    one.a.motion->file = "clamp_a.csv";
    one.record.t.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const double t = duration * static_cast<double>(i) / static_cast<double>(count - 1);
      const double phase = 2 * kPi * (f0 * t + 0.5 * (f1 - f0) * t * t / duration);
      one.record.t.push_back(t);
      one.a.motion->t.push_back(t);
      Pose pose = of.a.pose;
      pose.p +=
          kChirpAmplitude * length * std::sin(phase) * std::min(1.0, t / scales_.period) * across;
      one.a.motion->poses.push_back(pose);
    }
    one.record.values = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(count),
                                              static_cast<Eigen::Index>(one.channels.size()));
    Add("shake the clamp of '" + of.name + "' across with " +
            FormatRounded(1e3 * kChirpAmplitude * length, 2) + " mm in a sweep from " +
            FormatRounded(f0, 2) + " to " + FormatRounded(f1, 2) + " Hz",
        one);
  }

  const MeasurementSet& set_;
  const MotionScales& scales_;
  int like_ = 0;
  std::vector<Design> designs_;
};

}  // namespace

std::vector<Design> DesignMenu(const MeasurementSet& set, const MotionScales& scales) {
  return Menu(set, scales).Make();
}

}  // namespace cosserat_cable
