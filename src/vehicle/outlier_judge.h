// Single samples of one edge that its neighbours do not explain, whatever their size: poses that
// are left and taken back at once, steps from one sample to the next, and stamps that are off.
//
// A sample is compared with the parabolas through the three samples before and the three behind it.
// Where both agree with each other in place and in velocity, and the sample is far off them, it is
// an outlier. What is far off is learnt from the same difference of all other samples: rough roads,
// noise and encoder steps have it all the time.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <deque>

#include "cosserat_cable/math/pose.h"

namespace cosserat_cable {

/// From which on a single sample counts. Lengths in m or rad.
struct OutlierLimits {
  double size;          ///< of the excursion or of the step
  double acceleration;  ///< that it would take [/s^2]
};

class OutlierJudge {
 public:
  struct Tally {
    std::uint64_t count = 0;
    std::int64_t first = 0, worst = 0;  ///< stamps [ns]
    double size = 0;                    ///< of the worst [m] or [rad]
    double acceleration = 0;            ///< of the same [/s^2]
    double lateness = 0;                ///< of the same's stamp [s]
    double usual = 0;                   ///< what samples around it are off
    double sum = 0;                     ///< of all sizes
    int length = 0;                     ///< of the worst, in samples
  };
  /// Of translations, or of rotations.
  struct Found {
    Tally outliers;  ///< excursions of one to four samples
    Tally steps;
    Tally stamps;  ///< samples that lie on the path of the others, at another time
    /// The first samples, one to three, or the last ones, that do not belong to the others.
    Tally begins, ends;

    /// Whether the steps are many and of one size, as a coarse encoder's are.
    bool HasQuantum() const;
  };

  OutlierJudge(const OutlierLimits& translation, const OutlierLimits& rotation, double max_gap);

  /// The next sample. @pre stamps [ns] increase
  void Add(std::int64_t stamp, const Pose& X_PC);
  /// What was added before has nothing to do with what comes; what was found stays.
  void Restart();
  /// No more samples come for now: judges the last ones by what there is.
  void JudgeRest();
  /// No more samples come: the last ones are judged by those before.
  void Finish();

  const Found& translation() const { return found_[0]; }
  const Found& rotation() const { return found_[1]; }

 private:
  static constexpr int kSide = 3;     // samples of a parabola
  static constexpr int kLongest = 4;  // samples of an excursion
  static constexpr int kAround = 8;   // samples on either side that say what is usual

  struct Sample {
    std::int64_t stamp = 0;
    Pose X;
    std::array<double, 2> off = {0, 0};  // what its neighbours do not explain
  };
  struct Event {
    enum class Kind { kNone, kOutlier, kStep, kStamp, kBegin, kEnd } kind = Kind::kNone;
    int length = 0;  // samples
    double size = 0, acceleration = 0, lateness = 0, usual = 0;
  };

  using Places = std::array<Eigen::Vector3d, 2 * kSide + kLongest>;
  /// Of the samples from `from` on: places relative to the first, times in s; false across gaps.
  bool Look(int from, int count, int channel, Places* places, double* times) const;
  double Off(int centre, int channel) const;
  double Roughness(int begin, int end, int channel) const;
  Event JudgeExcursion(int first, int length, int channel) const;
  Event JudgeStep(int first, int channel) const;
  Event JudgeStamp(int at, int channel) const;
  Event JudgeFirst(int length, int channel, bool from_behind) const;
  void JudgeBegin();
  bool IsFarBeyond(double size, double usual, int channel) const;
  void Judge(int at);
  void Forget();
  void Note(const Event& event, int at, int channel);

  std::array<OutlierLimits, 2> limits_;
  double max_gap_;
  std::deque<Sample> samples_;
  int next_ = kSide;    // sample to be judged
  bool begins_ = true;  // the first samples are still to be judged
  std::array<double, 2> sum_ = {0, 0};
  std::array<std::uint64_t, 2> count_ = {0, 0};  // of those that are off at all
  std::array<Found, 2> found_;
};

}  // namespace cosserat_cable
