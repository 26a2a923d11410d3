// Cables of any size, stiffness, tension and clamp poses, and violent motions of their clamps: what
// the solver is put under stress with. docs/reliability.md states the ranges.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>

#include "cable/cable_cases.h"
#include "cosserat_cable/cable/cable_simulation.h"
#include "cosserat_cable/math/quintic.h"
#include "cosserat_cable/math/rotation.h"

namespace cosserat_cable::stress {

/// Random numbers of one cable: the same on each run.
class Random {
 public:
  Random(std::uint32_t seed, std::uint32_t stream, std::uint32_t index) {
    std::seed_seq sequence{seed, stream, index};
    rng_.seed(sequence);
  }
  double Between(double low, double high) {
    return low + (high - low) * static_cast<double>(rng_() >> 11) * 0x1p-53;
  }
  double LogBetween(double low, double high) {
    return std::exp(Between(std::log(low), std::log(high)));
  }
  bool Chance(double of) { return Between(0, 1) < of; }
  Eigen::Vector3d Direction() {
    const double z = Between(-1, 1), azimuth = Between(-M_PI, M_PI), r = std::sqrt(1 - z * z);
    return {r * std::cos(azimuth), r * std::sin(azimuth), z};
  }
  /// Uniform over all rotations.
  Eigen::Quaterniond Attitude() {
    const double u = Between(0, 1), a = Between(0, 2 * M_PI), b = Between(0, 2 * M_PI);
    const double low = std::sqrt(1 - u), high = std::sqrt(u);
    return {high * std::cos(b), low * std::sin(a), low * std::cos(a), high * std::sin(b)};
  }

 private:
  std::mt19937_64 rng_;
};

/// A sum of sinusoids and one smooth pulse, within a bound.
class Shaking {
 public:
  /// `most`: of its size; `acceleration`: the largest second derivative of a sinusoid or pulse,
  /// less where `most` allows less. `duration` [s] of the run.
  Shaking(double most, double acceleration, double duration, Random* random) {
    for (Part& wave : waves_) {
      const double w = 2 * M_PI * random->LogBetween(kLowest, kHighest);
      wave = {std::min(most / kParts, acceleration / (w * w)), w, random->Between(0, 2 * M_PI)};
    }
    // a (1 + cos)/2 over one period: its second derivative is a w^2/2 at most.
    const double w = 2 * M_PI * random->LogBetween(kLowest, kSharpest);
    pulse_ = {std::min(most / kParts, 2 * acceleration / (w * w)), w, random->Between(0, duration)};
  }

  /// Adds its value and two derivatives to one component of `jet`.
  void AddTo(int component, double time, Jet* jet) const {
    for (const Part& wave : waves_) {
      const double x = wave.w * time + wave.at;
      jet->value[component] += wave.amplitude * std::sin(x);
      jet->first[component] += wave.amplitude * wave.w * std::cos(x);
      jet->second[component] -= wave.amplitude * wave.w * wave.w * std::sin(x);
    }
    const double x = pulse_.w * (time - pulse_.at), half = 0.5 * pulse_.amplitude;
    if (std::abs(x) >= M_PI) return;
    jet->value[component] += half * (1 + std::cos(x));
    jet->first[component] -= half * pulse_.w * std::sin(x);
    jet->second[component] -= half * pulse_.w * pulse_.w * std::cos(x);
  }

 private:
  static constexpr int kParts = 4;
  static constexpr double kLowest = 0.5, kHighest = 50, kSharpest = 200;  // [Hz]
  struct Part {
    double amplitude, w, at;  // angular frequency [rad/s]; phase [rad], of the pulse its middle [s]
  };
  std::array<Part, kParts - 1> waves_;
  Part pulse_;
};

/// Three of them.
class Shaking3 {
 public:
  Shaking3(double most, double acceleration, double duration, Random* random)
      : axes_{Shaking(most, acceleration, duration, random),
              Shaking(most, acceleration, duration, random),
              Shaking(most, acceleration, duration, random)} {}
  Jet At(double time) const {
    Jet jet;
    for (int i = 0; i < 3; ++i) axes_[i].AddTo(i, time, &jet);
    return jet;
  }

 private:
  std::array<Shaking, 3> axes_;
};

inline Motion Turning(const Jet& phi) {
  Motion motion;
  motion.X.q = RotationExp(phi.value);
  const BodyRates rates = ToBodyRates(phi.value, {phi.first, phi.second});
  motion.omega = rates.omega;
  motion.alpha = rates.alpha;
  return motion;
}

inline Motion Shifting(const Jet& p) {
  Motion motion;
  motion.X.p = p.value;
  motion.v = p.first;
  motion.a = p.second;
  return motion;
}

/// Both clamps shake, on a vehicle that does. They are never farther apart than was drawn, slack or
/// stretched.
class ClampMotion {
 public:
  /// `farthest` [m]: between the clamps. `acceleration` [m/s^2]: of each part of the motion.
  ClampMotion(double length, double farthest, double acceleration, double duration, Random* random)
      : farthest_(farthest),
        nearer_(random->Between(0.01, 0.3) * farthest),
        vehicle_(kMostWay, acceleration, duration, random),
        vehicle_turn_(kMostTurn, acceleration / kMostWay, duration, random),
        swing_(kMostTurn, acceleration / length, duration, random),
        approach_(0.5 * nearer_, acceleration, duration, random),
        turn_a_(kMostTurn, acceleration / length, duration, random),
        turn_b_(kMostTurn, acceleration / length, duration, random) {
    chord_.q = random->Attitude();
    a_.q = Attitude(random);
    b_.q = Attitude(random);
  }

  Surroundings At(double time) const {
    Jet way;
    way.value.z() = farthest_ - 0.5 * nearer_;
    approach_.AddTo(2, time, &way);
    const Motion chord = Shifting(vehicle_.At(time)) * Turning(vehicle_turn_.At(time)) * chord_ *
                         Turning(swing_.At(time));  // its z axis goes from clamp a to clamp b
    Surroundings now;
    now.a = chord * a_ * Turning(turn_a_.At(time));
    now.b = chord * Shifting(way) * b_ * Turning(turn_b_.At(time));
    return now;
  }

 private:
  static constexpr double kMostWay = 0.5;   // of the vehicle, along each axis [m]
  static constexpr double kMostTurn = 0.5;  // about each axis [rad]

  /// Half of the clamps point along the chord, more or less, the others anywhere.
  static Eigen::Quaterniond Attitude(Random* random) {
    if (random->Chance(0.5)) return random->Attitude();
    const Eigen::Vector3d twist(0, 0, random->Between(-M_PI, M_PI));
    return RotationExp(random->Between(0, 0.5) * random->Direction()) * RotationExp(twist);
  }

  double farthest_, nearer_;  // [m]; the latter by how much they come nearer
  Shaking3 vehicle_, vehicle_turn_, swing_;
  Shaking approach_;
  Shaking3 turn_a_, turn_b_;
  Pose chord_, a_, b_;
};

/// How the clamps are apart where they are farthest.
enum class Tension { kSlack, kNearlyStraight, kStretched };

struct RandomCable {
  CableModel model;
  Tension tension;
  double acceleration;  // of each part of the motion [m/s^2]
  ClampMotion motion;
};

constexpr double kDuration = 0.25;   // [s]
constexpr std::uint32_t kAlike = 4;  // cables in a row have equal numbers of elements

/// Number `index` of those that `seed` makes.
inline RandomCable MakeRandomCable(std::uint32_t seed, std::uint32_t index) {
  Random of_group(seed, 0, index / kAlike), random(seed, 1, index);
  const double length = random.LogBetween(0.05, 3);
  const double diameter = std::min(random.LogBetween(0.002, 0.02), length / 10);
  const double density = random.LogBetween(1000, 8000);  // from rubber to copper [kg/m^3]
  const double EI = random.LogBetween(1e-4, 10);
  // Vibrations of the lowest modes are damped by what cables have, from hardly to critically.
  const double eta_EI = EI * random.LogBetween(1e-5, 1e-2);
  CableModel model = RoundCableModel(length, diameter, density * M_PI / 4 * diameter * diameter, EI,
                                     EI * random.LogBetween(0.1, 2), eta_EI);
  model.name = "cable_" + std::to_string(index);
  model.elements = static_cast<int>(std::lround(of_group.LogBetween(4, 200)));
  if (random.Chance(0.2)) model.EI2 *= random.LogBetween(0.1, 10);
  if (random.Chance(0.2)) model.EA *= random.LogBetween(0.1, 10);
  if (random.Chance(0.2))
    model.masses.push_back({random.Between(0, length), 0.1 * random.Between(0, 1)});

  const double which = random.Between(0, 3);
  const Tension tension = which < 1   ? Tension::kSlack
                          : which < 2 ? Tension::kNearlyStraight
                                      : Tension::kStretched;
  const double farthest = tension == Tension::kSlack            ? random.Between(0.1, 0.97)
                          : tension == Tension::kNearlyStraight ? random.Between(0.97, 1)
                                                                : random.Between(1, 1.01);
  const double acceleration = random.LogBetween(1, 500);
  ClampMotion motion(length, farthest * length, acceleration, kDuration, &random);
  return {std::move(model), tension, acceleration, std::move(motion)};
}

}  // namespace cosserat_cable::stress
