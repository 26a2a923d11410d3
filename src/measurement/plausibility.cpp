#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "attitude_check.h"
#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/measurement/measurement_set.h"
#include "cosserat_cable/measurement/sample_runs.h"

namespace cosserat_cable {
namespace {

// Beyond the cable's length: stretch, slack in the calibration, but no slip of units.
constexpr double kReach = 1.1;
// Fewer samples beyond are outliers of a tracker, more are another unit.
constexpr double kOutliers = 0.1;
constexpr std::size_t kFewSamples = 8;
constexpr std::size_t kFewSteps = 3;
// [median periods]
constexpr double kGap = 5;
// Of the cable's own mass: a body on it that is heavier, and more than so much [kg], may be in
// grams.
constexpr double kHeavy = 50, kHeavyMass = 0.5;
// Times that are tried where a clamp moves: in all, over the time in which it does.
constexpr int kShifts = 100;
// [rad] Eight turns; in degrees it is less than one.
constexpr double kManyTurns = 50;
constexpr std::size_t kMostShown = 5;

std::string Count(std::size_t count, std::size_t of) {
  return std::to_string(count) + " of " + std::to_string(of) + " samples (" +
         FormatRounded(100.0 * static_cast<double>(count) / static_cast<double>(of)) + " %)";
}

// Where a clamp is, well enough to tell metres from millimetres: straight lines between samples.
Eigen::Vector3d PositionAt(const EndCondition& clamp, double t) {
  if (!clamp.motion || clamp.motion->t.empty()) return clamp.pose.p;
  const std::vector<double>& times = clamp.motion->t;
  const std::vector<Pose>& poses = clamp.motion->poses;
  const auto after = std::upper_bound(times.begin(), times.end(), t);
  if (after == times.begin()) return poses.front().p;
  if (after == times.end()) return poses.back().p;
  const auto i = static_cast<std::size_t>(after - times.begin());
  const double u = (t - times[i - 1]) / (times[i] - times[i - 1]);
  return (1 - u) * poses[i - 1].p + u * poses[i].p;
}

bool HoldsPlace(const EndCondition& end) {
  const auto& free = end.translation_free;
  return end.kind == EndCondition::Kind::kClamp && !free[0] && !free[1] && !free[2];
}

class ExperimentLooks {
 public:
  ExperimentLooks(const MeasurementSet& set, const Experiment& experiment, Problems* problems,
                  Problems* warnings)
      : experiment_(experiment), problems_(problems), warnings_(warnings) {
    path_ = (std::filesystem::path(set.folder) / experiment.record.file).string();
    CableKeys cable = experiment.specimen;
    cable.FillFrom(set.cable);
    reach_ = kReach * cable.length.value.value_or(0);
    length_ = FormatNumber(cable.length.value.value_or(0)) + " m";
    own_mass_ = cable.length.value.value_or(0) * cable.mass_per_length.value.value_or(0);
    if (cable.masses.value) masses_ = *cable.masses.value;
  }

  void Check() {
    CheckSampling();
    const std::string unit = UnitOfMotion();
    if (!unit.empty())
      problems_->Add(experiment_.a.mark.file, experiment_.a.mark.line, "motion",
                     experiment_.a.motion->file + ": clamp a moves where the cable of " + length_ +
                         " does not reach from what the record shows: is it in " + unit + "?");
    for (std::size_t k = 0; k < experiment_.channels.size(); ++k) {
      const Channel& channel = experiment_.channels[k];
      const Eigen::VectorXd values = experiment_.record.values.col(static_cast<Eigen::Index>(k));
      if (values.size() < 2) continue;
      CheckMovement(channel, values);
      if (channel.quantity == Quantity::kPosition && unit.empty()) CheckReach(channel, values);
      if (channel.quantity == Quantity::kAngle) CheckAngle(channel, values);
    }
    if (unit.empty()) CheckClampDistance();
    CheckStart();
    CheckMasses();
  }

 private:
  static int LineOf(Eigen::Index row) { return static_cast<int>(row) + 2; }

  void Warn(Eigen::Index row, const std::string& column, const std::string& message) {
    warnings_->Add(path_, LineOf(row), column, message);
  }

  void CheckSampling() {
    const std::vector<double>& t = experiment_.record.t;
    const std::size_t few = experiment_.quasi_static() ? kFewSteps : kFewSamples;
    if (t.size() < few) {
      warnings_->Add(path_, "got " + std::to_string(t.size()) + " samples, expected at least " +
                                std::to_string(few) + ": too few to tell motion from noise");
      return;
    }
    if (experiment_.quasi_static()) return;
    std::vector<double> periods;
    for (std::size_t i = 1; i < t.size(); ++i) periods.push_back(t[i] - t[i - 1]);
    std::vector<double> sorted = periods;
    std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
    const double median = sorted[sorted.size() / 2];
    std::size_t gaps = 0;
    double missing = 0;
    for (std::size_t i = 0; i < periods.size(); ++i) {
      if (periods[i] <= kGap * median) continue;
      missing += periods[i];
      if (++gaps > kMostShown) continue;
      Warn(static_cast<Eigen::Index>(i) + 1, "t",
           "got no sample for " + FormatRounded(periods[i]) + " s, " +
               FormatRounded(periods[i] / median) + " times the usual period: a gap");
    }
    if (gaps > kMostShown) {
      warnings_->Add(path_, "got " + std::to_string(gaps) + " gaps, " + FormatRounded(missing) +
                                " s of " + FormatRounded(t.back() - t.front()) + " s");
    }
  }

  void CheckMovement(const Channel& channel, const Eigen::VectorXd& values) {
    if (values.maxCoeff() == values.minCoeff()) {
      warnings_->Add(path_, 1, channel.column,
                     "got the same value " + FormatNumber(values[0]) +
                         " throughout: it tells nothing of the cable, not even the noise");
      return;
    }
    const std::vector<SampleRun> clipped = ClippedRuns(values);
    std::vector<SampleRun> frozen = FrozenRuns(values);
    const auto is_clipped = [&](const SampleRun& run) {
      return std::any_of(clipped.begin(), clipped.end(),
                         [&](const SampleRun& other) { return other.first == run.first; });
    };
    frozen.erase(std::remove_if(frozen.begin(), frozen.end(), is_clipped), frozen.end());
    WarnOfRuns(channel, values, clipped, "at the largest or smallest value: clipped");
    WarnOfRuns(channel, values, frozen,
               "while it moves elsewhere: frozen, or still within the sensor's resolution");
  }

  void WarnOfRuns(const Channel& channel, const Eigen::VectorXd& values,
                  const std::vector<SampleRun>& runs, const std::string& what) {
    Eigen::Index together = 0;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const SampleRun& run = runs[i];
      together += run.count;
      if (i >= kMostShown) continue;
      Warn(run.first, channel.column,
           "got " + FormatNumber(values[run.first]) + " on lines " +
               std::to_string(LineOf(run.first)) + " to " +
               std::to_string(LineOf(run.first + run.count - 1)) + ", " +
               Count(static_cast<std::size_t>(run.count), static_cast<std::size_t>(values.size())) +
               ", " + what);
    }
    if (runs.size() > kMostShown) {
      Warn(runs[kMostShown].first, channel.column,
           "got " + std::to_string(runs.size()) + " such stretches from here and before, " +
               Count(static_cast<std::size_t>(together), static_cast<std::size_t>(values.size())) +
               " together");
    }
  }

  // Says the slip, one of units if nothing else, where most samples show it; outliers where few do.
  void Judge(const std::string& file, int line, const std::string& key, std::size_t beyond,
             std::size_t of, const std::string& message, const std::string& slip = "is it in mm?") {
    if (beyond == 0) return;
    const bool most = static_cast<double>(beyond) > kOutliers * static_cast<double>(of);
    (most ? problems_ : warnings_)
        ->Add(file, line, key, message + ": " + (most ? slip : "an outlier?"));
  }

  double Origin(const Channel& channel, Eigen::Index i, double late = 0) const {
    const double t = experiment_.record.t[static_cast<std::size_t>(i)] - late;
    return channel.in_frame_a ? 0 : PositionAt(experiment_.a, t)[channel.axis];
  }

  /// Whether nearly all samples are within `reach` [m] of where a clamp is at them.
  template <typename ClampAt>
  static bool ReachesFrom(const ClampAt& clamp_at, const Eigen::VectorXd& values, double factor,
                          double reach) {
    Eigen::Index beyond = 0;
    for (Eigen::Index i = 0; i < values.size(); ++i)
      if (std::abs(factor * values[i] - clamp_at(i)) > reach) ++beyond;
    return static_cast<double>(beyond) <= kOutliers * static_cast<double>(values.size());
  }

  /// The same, of times that are late by so much [s].
  bool Reaches(const Channel& channel, const Eigen::VectorXd& values, double factor,
               double late = 0) const {
    return ReachesFrom([&](Eigen::Index i) { return Origin(channel, i, late); }, values, factor,
                       reach_);
  }

  /// The unit of clamp a's motion, whole or from its first position, that brings all channels
  /// within the cable's reach where some are not that no slip of their own brings there; empty
  /// where none does.
  std::string UnitOfMotion() const {
    const EndCondition& a = experiment_.a;
    if (!a.motion || a.motion->poses.empty() || !HoldsPlace(a)) return "";
    std::vector<const Channel*> placed;
    bool beyond = false;
    for (const Channel& channel : experiment_.channels) {
      if (channel.quantity != Quantity::kPosition || channel.in_frame_a || channel.unknown_offset)
        continue;
      placed.push_back(&channel);
      const Eigen::VectorXd values = ValuesOf(channel);
      if (Reaches(channel, values, 1)) continue;
      if (Reaches(channel, values, -1) || !ExchangeOfReach(channel).empty()) return "";
      beyond = true;
    }
    if (!beyond) return "";
    struct Unit {
      double factor;
      const char* name;
    };
    // Of several that do, first the one with which the cable follows the clamp best.
    std::map<std::string, double> found;
    for (const Unit& unit : {Unit{1e-3, "mm"}, Unit{1e-2, "cm"}, Unit{0.0254, "inches"}})
      for (const Eigen::Vector3d& from :
           {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(a.motion->poses.front().p)}) {
        double apart = 0;
        bool reaches = true;
        for (const Channel* channel : placed) {
          const Eigen::VectorXd values = ValuesOf(*channel);
          const double first = from[channel->axis];
          Eigen::VectorXd clamp(values.size());
          for (Eigen::Index i = 0; i < values.size(); ++i)
            clamp[i] = first + unit.factor * (Origin(*channel, i) - first);
          reaches = reaches && ReachesFrom([&](Eigen::Index i) { return clamp[i]; }, values, 1,
                                           kReach * channel->s);
          const Eigen::VectorXd distance = values - clamp;
          apart += (distance.array() - distance.mean()).square().mean();
        }
        if (!reaches) continue;
        const auto known = found.emplace(unit.name, apart).first;
        known->second = std::min(known->second, apart);
      }
    std::vector<std::pair<double, std::string>> order;
    for (const auto& [name, apart] : found) order.push_back({apart, name});
    std::sort(order.begin(), order.end());
    std::string names;
    for (const auto& [apart, name] : order) names += (names.empty() ? "" : ", or ") + name;
    return names;
  }

  /// By how much the record's times would have to be late or early [s]: the least that will do.
  /// Zero where none will, or no clamp moves.
  double LatenessOfReach(const Channel& channel, const Eigen::VectorXd& values) const {
    if (experiment_.quasi_static() || channel.in_frame_a || !experiment_.a.motion) return 0;
    const std::vector<double>& times = experiment_.a.motion->t;
    const double most = times.back() - times.front();
    for (int i = 1; i <= kShifts; ++i)
      for (const double late : {most * i / kShifts, -most * i / kShifts})
        if (Reaches(channel, values, 1, late)) return late;
    return 0;
  }

  /// The column of another axis with which it would have to be exchanged; empty where none would
  /// do.
  std::string ExchangeOfReach(const Channel& channel) const {
    for (std::size_t k = 0; k < experiment_.channels.size(); ++k) {
      const Channel& other = experiment_.channels[k];
      if (other.quantity != channel.quantity || other.axis == channel.axis ||
          other.in_frame_a != channel.in_frame_a || other.s != channel.s)
        continue;
      const Eigen::VectorXd here = ValuesOf(channel),
                            there = experiment_.record.values.col(static_cast<Eigen::Index>(k));
      if (Reaches(channel, there, 1) && Reaches(other, here, 1)) return other.column;
    }
    return "";
  }

  Eigen::VectorXd ValuesOf(const Channel& channel) const {
    for (std::size_t k = 0; k < experiment_.channels.size(); ++k)
      if (&experiment_.channels[k] == &channel)
        return experiment_.record.values.col(static_cast<Eigen::Index>(k));
    return {};
  }

  /// Which slip would bring a channel within the cable's reach that is not.
  std::string SlipOfReach(const Channel& channel, const Eigen::VectorXd& values) const {
    const bool moves_little = values.maxCoeff() - values.minCoeff() <= 2 * reach_;
    const std::string other = ExchangeOfReach(channel);
    const std::string exchanged = other.empty() ? "" : "is it exchanged with '" + other + "'?";
    if (Reaches(channel, values, -1))
      return other.empty() ? "is its sign turned?"
                           : "is its sign turned, or is it exchanged with '" + other + "'?";
    if (!exchanged.empty()) return exchanged;
    if (const double late = LatenessOfReach(channel, values); late != 0)
      return "are its times " + FormatRounded(std::abs(late), 2) + " s too " +
             (late > 0 ? "late" : "early") + " beside the clamp's motion, or more?";
    if (moves_little && Reaches(channel, values, 1e-3))
      return "is it in mm, or its zero another one (`offset: unknown`)?";
    if (moves_little) return "is its zero another one (`offset: unknown`)?";
    return Reaches(channel, values, 1e-3) ? "is it in mm?"
                                          : "is it in another unit, or from another clamp?";
  }

  void CheckMasses() {
    const auto is_heavy = [&](double mass) {
      return mass > kHeavyMass && own_mass_ > 0 && mass > kHeavy * own_mass_;
    };
    const auto warn = [&](const SourceMark& mark, const char* key, double mass) {
      warnings_->Add(mark.file, mark.line, key,
                     "got " + FormatRounded(mass) + " kg on a cable of " +
                         FormatRounded(own_mass_, 2) + " kg: is it in grams?");
    };
    for (const LumpedMassKey& one : masses_)
      if (is_heavy(one.mass.mass)) warn(one.s_mark, "masses", one.mass.mass);
    const EndCondition& b = experiment_.b;
    if (b.kind == EndCondition::Kind::kDisc && is_heavy(b.disc.mass))
      warn(b.mark, "disc.mass", b.disc.mass);
  }

  void CheckReach(const Channel& channel, const Eigen::VectorXd& values) {
    if (!HoldsPlace(experiment_.a) || channel.unknown_offset) {
      const double range = values.maxCoeff() - values.minCoeff();
      if (range <= 2 * reach_) return;
      Judge(path_, 1, channel.column, 1, 1,
            "moves by " + FormatRounded(range) + " m, the cable is " + length_ + " long");
      return;
    }
    std::size_t beyond = 0;
    Eigen::Index worst = 0;
    double farthest = reach_;
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      const double distance = std::abs(values[i] - Origin(channel, i));
      if (distance > reach_) ++beyond;
      if (distance <= farthest) continue;
      farthest = distance;
      worst = i;
    }
    const auto size = static_cast<std::size_t>(values.size());
    Judge(path_, LineOf(worst), channel.column, beyond, size,
          "is " + FormatRounded(farthest) + " m from clamp a here and farther than the cable's " +
              length_ + " in " + Count(beyond, size),
          beyond > 0 ? SlipOfReach(channel, values) : "");
  }

  void CheckAngle(const Channel& channel, const Eigen::VectorXd& values) {
    Eigen::Index row = 0;
    const double largest = values.cwiseAbs().maxCoeff(&row);
    if (largest <= kManyTurns || channel.unknown_offset) return;
    Warn(row, channel.column, "got " + FormatRounded(largest) + " rad: is it in degrees?");
  }

  /// Whether the clamps are in reach of each other nearly all the time, with the one's times late.
  bool Reach(const std::vector<double>& times, double late) const {
    std::size_t beyond = 0;
    for (const double t : times)
      if ((PositionAt(experiment_.b, t - late) - PositionAt(experiment_.a, t)).norm() > reach_)
        ++beyond;
    return static_cast<double>(beyond) <= kOutliers * static_cast<double>(times.size());
  }

  std::string SlipOfDistance(const std::vector<double>& times) const {
    const auto& b = experiment_.b.motion;
    if (!b || !experiment_.a.motion || experiment_.quasi_static()) return "is it in mm?";
    const double most = b->t.back() - b->t.front();
    for (int i = 1; i <= kShifts; ++i)
      for (const double late : {most * i / kShifts, -most * i / kShifts})
        if (Reach(times, late))
          return "are the times of " + b->file + " " + FormatRounded(std::abs(late), 2) +
                 " s too " + (late > 0 ? "late" : "early") + " beside clamp a's, or more?";
    return "is it in mm?";
  }

  void CheckClampDistance() {
    const EndCondition& a = experiment_.a;
    const EndCondition& b = experiment_.b;
    if (!HoldsPlace(a) || !HoldsPlace(b)) return;
    std::vector<double> times = {experiment_.start_time()};
    for (const EndCondition* end : {&a, &b}) {
      if (end->motion) times.insert(times.end(), end->motion->t.begin(), end->motion->t.end());
    }
    std::size_t beyond = 0;
    double farthest = 0;
    for (const double t : times) {
      const double distance = (PositionAt(b, t) - PositionAt(a, t)).norm();
      if (distance > reach_) ++beyond;
      farthest = std::max(farthest, distance);
    }
    Judge(
        b.mark.file, b.mark.line, b.mark.key, beyond, times.size(),
        "the clamps are " + FormatRounded(farthest) + " m apart, the cable is " + length_ + " long",
        beyond > 0 ? SlipOfDistance(times) : "");
  }

  void CheckStart() {
    const StartCondition& start = experiment_.start;
    if (!HoldsPlace(experiment_.a)) return;
    const Eigen::Vector3d a = PositionAt(experiment_.a, experiment_.start_time());
    const auto check = [&](const PointAt& point, const std::string& key) {
      const double distance = (point.position_W - a).norm();
      if (distance <= reach_) return;
      Judge(start.mark.file, start.mark.line, start.mark.key + "." + key, 1, 1,
            "is " + FormatRounded(distance) + " m from clamp a, the cable is " + length_ + " long");
    };
    if (start.near) check(*start.near, "near");
    if (start.kind == StartCondition::Kind::kHeld) check(start.held, "held");
  }

  const Experiment& experiment_;
  Problems* problems_;
  Problems* warnings_;
  std::string path_, length_;
  std::vector<LumpedMassKey> masses_;
  double own_mass_ = 0;  // [kg]
  double reach_ = 0;     // [m] from clamp a
};

}  // namespace

void CheckPlausibility(const MeasurementSet& set, Problems* problems, Problems* warnings) {
  for (const Experiment& experiment : set.experiments)
    ExperimentLooks(set, experiment, problems, warnings).Check();
  // With another unit, nothing is where the cable is.
  if (problems->empty()) CheckAttitudes(set, problems, warnings);
}

}  // namespace cosserat_cable
