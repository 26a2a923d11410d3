// A low-pass without phase for the recorded motion of one edge, on samples as uneven as they come.
//
// Each sample is replaced by the value there of a quadratic (cubic polynomials pass unchanged) that
// is fitted to its neighbours with the weights exp(-t^2 / (2 s^2)). On dense samples its gain is
//   H(f) = (1 + u) exp(-u),  u = (2 pi f s)^2 / 2,
// 0.71 at the cutoff, 0.07 at twice it. It needs some 1.05 / cutoff seconds of what comes after.
//
// Stamps of publishing instead of measurement make steady motion uneven. Where samples that are
// counted out evenly are far smoother than by their stamps, the stamps are replaced by the steady
// clock that fits them, over one second on either side; their mean delay stays.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

#include "cosserat_cable/math/pose.h"

namespace cosserat_cable {

class EdgeSmoother {
 public:
  using Sink = std::function<void(std::int64_t stamp, const Pose& X)>;

  /// `cutoff` [Hz]; `max_gap` [s]: samples farther apart do not smooth each other.
  EdgeSmoother(double cutoff, double max_gap);

  /// The next sample; calls `sink` with those that no later one can change. @pre stamps [ns]
  /// increase
  void Add(std::int64_t stamp, const Pose& X, const Sink& sink);
  /// No more will come: the rest.
  void Finish(const Sink& sink);
  void Clear();

  /// How much later than its sample a smoothed one comes, at most, besides the sample's interval
  /// [s].
  static double Latency(double cutoff);
  /// Whether stamps are replaced.
  bool restamps() const { return restamps_; }

 private:
  struct Sample {
    std::int64_t stamp = 0;
    double time = 0;  // since the first one [s]
    Pose X;
    bool after_gap = false;
  };
  struct Fit {
    double time;
    Pose X;
  };
  struct Clock {
    std::size_t first = 0;       // sample
    std::vector<double> counts;  // periods from there, of each sample
    double start = 0, period = 0;
  };

  void Compare();
  void Deliver(const Sink& sink);
  bool IsReady(std::size_t i) const;
  std::pair<std::size_t, std::size_t> Around(std::size_t i, double reach) const;
  Clock ClockAt(std::size_t i) const;
  Fit FitAt(std::size_t i) const;

  double width_;  // s [s]
  double max_gap_;
  std::int64_t epoch_ = 0;
  bool has_epoch_ = false, finished_ = false;
  std::deque<Sample> samples_;
  std::size_t next_ = 0;  // to be delivered
  bool delivered_any_ = false;
  double delivered_ = 0;  // the last one's time [s]
  double period_sum_ = 0;
  std::uint64_t periods_ = 0;
  double by_stamp_ = 0, by_count_ = 0;  // sums of squared second differences
  std::uint64_t compared_ = 0;
  bool restamps_ = false;
};

}  // namespace cosserat_cable
