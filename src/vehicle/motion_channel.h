// The translation or the rotation of one edge of the tree, as a stream of displacements: how much
// of it no body can have done.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>

#include "step_grid.h"

namespace cosserat_cable {

/// From which on motion is said to be impossible. Lengths in m or rad.
struct MotionLimits {
  double jump;               ///< least size of a jump
  double jump_acceleration;  ///< least acceleration that it would take [/s^2]
  double noise;              ///< rms of accelerations that alternate from sample to sample [/s^2]
  double lateness;           ///< the same, where stamps are known to be the reason
  double acceleration;       ///< of anything, between samples [/s^2]
};

class MotionChannel {
 public:
  static constexpr int kBlock = 32;  ///< accelerations that are judged together

  /// Events of one kind.
  struct Tally {
    std::uint64_t count = 0;
    std::int64_t first = 0, worst = 0;  ///< stamps [ns]
    double size = 0;                    ///< of the worst
    double acceleration = 0;            ///< of the same [/s^2]

    void Add(std::int64_t stamp, double new_size, double new_acceleration);
    void Add(const Tally& other);
  };

  MotionChannel(const MotionLimits& limits, double max_gap) : limits_(limits), max_gap_(max_gap) {}

  /// The displacement between any two samples that follow each other.
  void AddToGrid(const Eigen::Vector3d& d) { grid_.Add(d); }
  /// The displacement `d` between two samples that follow each other, `h` [s] apart, in a frame
  /// that hardly turns between two calls. `stamp`: of the later one [ns].
  void AddRaw(const Eigen::Vector3d& d, double h, std::int64_t stamp);
  /// The same between samples some milliseconds apart.
  void Add(const Eigen::Vector3d& d, double h, std::int64_t stamp);
  /// What was added before has nothing to do with what comes.
  void Restart();

  const MotionLimits& limits() const { return limits_; }
  /// There and back to rest, but for steps of the grid.
  const Tally& jumps() const { return jumps_; }
  const Tally& grid_jumps() const {
    return grid_jumps_;
  }  ///< of a step or two, where grid() has one
  const Tally& accelerations() const { return accelerations_; }  ///< beyond any limit
  /// Blocks of samples; the size is the rms of the acceleration, of noise without the part that
  /// what came before predicts.
  const Tally& noise() const { return noise_; }
  /// Blocks that consist of a vibration, and the lowest frequency of these [Hz].
  const Tally& vibration() const { return vibration_; }
  double vibration_frequency() const { return vibration_frequency_; }
  /// What all displacements are multiples of.
  const StepGrid& grid() const { return grid_; }
  const Tally& lateness() const { return lateness_; }
  /// Blocks that accelerate by more than the limit of noise, whatever they consist of.
  const Tally& rough() const { return rough_; }
  double worst_lateness() const { return worst_lateness_; }  ///< spread of the delays [s]
  std::uint64_t blocks() const { return blocks_; }
  /// The largest displacement that counts as one of a correction, and how many there were.
  const Tally& largest_step() const { return largest_step_; }
  /// Whether most of the motion happened in single steps, and steps of a size that counts.
  bool MovesByJumps() const;

 private:
  static constexpr int kRing = 7;  // displacements around one that may be a jump

  struct Step {
    Eigen::Vector3d d = Eigen::Vector3d::Zero(), v = Eigen::Vector3d::Zero();
    double h = 0;
    std::int64_t stamp = 0;
  };

  void LookForJump();
  bool IsVibration() const;
  void AddToBlock(const Step& before, const Step& step);
  void CloseBlock();
  double UnpredictedShare() const;
  double SpreadOfDelays() const;

  MotionLimits limits_;
  double max_gap_;

  Step raw_;  // the last
  double raw_sum_ = 0;
  std::uint64_t raw_count_ = 0;

  std::array<Step, kRing> ring_;  // the latest last
  int ring_size_ = 0;
  double squared_steps_ = 0, squared_changes_ = 0;
  double largest_change_ = 0, largest_acceleration_ = 0;
  Tally largest_step_;

  struct Block {
    int count = 0;
    double squares = 0, largest = 0, products = 0, by_index = 0;
    std::array<Eigen::Vector3d, kBlock> accelerations;
    std::array<double, kBlock> intervals;  // [s]
    std::int64_t first = 0;
  } block_;
  std::uint64_t blocks_ = 0;

  StepGrid grid_;
  Tally jumps_, grid_jumps_, accelerations_, noise_, vibration_, lateness_, rough_;
  double worst_lateness_ = 0;
  double vibration_frequency_ = std::numeric_limits<double>::infinity();
};

}  // namespace cosserat_cable
