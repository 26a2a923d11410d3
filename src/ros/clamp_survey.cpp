#include "clamp_survey.h"

#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

// So much is read before it is followed, as in a replay [ns].
constexpr std::int64_t kReadAhead = 200'000'000;

std::int64_t Period(double rate) { return static_cast<std::int64_t>(std::llround(1e9 / rate)); }

class ClampSurvey {
 public:
  ClampSurvey(const std::vector<CableModel>& cables, const EngineOptions& options,
              const ClampObserver& observer, LinkMotion* links)
      : links_(*links),
        observer_(observer),
        dt_(Period(1 / options.dt)),
        period_(Period(options.telemetry_rate)) {
    const std::vector<std::string>& all = links_.links();
    const auto index = [&](const std::string& link) {
      return static_cast<std::size_t>(std::find(all.begin(), all.end(), link) - all.begin());
    };
    for (const CableModel& cable : cables) {
      ends_.push_back({index(cable.a.link), index(cable.b.link), cable.a.X_LC, cable.b.X_LC});
      judges_.emplace_back(cable.name, cable.length, cable.diameter);
    }
  }

  /// As far as the motion is known. `all_read`: a recording of one instant has no other.
  void Follow(bool all_read) {
    if (links_.clear_count() != clears_) {
      clears_ = links_.clear_count();
      started_ = false;
    }
    std::int64_t begin = 0, ready = 0;
    if (!links_.Missing().empty() || !links_.Range(&begin, &ready)) return;
    if (!started_) {
      next_ = all_read && begin == ready ? begin : (begin + dt_ - 1) / dt_ * dt_;
      if (next_ > ready) return;
      started_ = true;
      for (ClampJudge& judge : judges_) judge.Restart();
      Judge(next_);
      next_ += dt_;
    }
    for (; next_ <= ready; next_ += dt_)
      if (next_ / period_ != (next_ - dt_) / period_) Judge(next_);
    links_.DropBefore(next_ - dt_);
  }

  const std::vector<ClampJudge>& judges() const { return judges_; }

 private:
  struct Ends {
    std::size_t a, b;
    Pose X_LA, X_LB;
  };

  void Judge(std::int64_t time) {
    for (std::size_t c = 0; c < ends_.size(); ++c) {
      const Ends& ends = ends_[c];
      const Pose X_WA = links_.Follow(ends.a, time).X * ends.X_LA;
      const Pose X_WB = links_.Follow(ends.b, time).X * ends.X_LB;
      judges_[c].Add(time, X_WA, X_WB);
      if (observer_) observer_(c, time, X_WA, X_WB);
    }
  }

  LinkMotion& links_;
  const ClampObserver& observer_;
  std::int64_t dt_, period_;  // [ns]
  std::vector<Ends> ends_;
  std::vector<ClampJudge> judges_;
  std::int64_t next_ = 0;
  std::uint64_t clears_ = 0;
  bool started_ = false;
};

}  // namespace

void Feed(const BagMessage& message, LinkMotion* links) {
  if (message.tf) links->Ingest(*message.tf, message.is_static, message.publisher(), message.time);
  if (message.joints) links->Ingest(*message.joints, message.publisher(), message.time);
}

std::vector<ClampJudge> FollowClamps(const BagReader& bags, std::int64_t from, std::int64_t to,
                                     const VehicleModel& vehicle,
                                     const std::vector<CableModel>& cables,
                                     const EngineOptions& options, const ClampObserver& observer) {
  LinkMotionOptions link_options = options.links;
  link_options.judge = false;
  LinkMotion links(vehicle, NeededLinks(cables), link_options);
  ClampSurvey survey(cables, options, observer, &links);
  std::int64_t follow_at = from + kReadAhead;
  bags.ForEach(from, to, [&](const BagMessage& message) {
    if (message.time >= follow_at) {
      survey.Follow(false);
      follow_at = message.time + kReadAhead;
    }
    Feed(message, &links);
    return true;
  });
  links.Finish();
  survey.Follow(true);
  return survey.judges();
}

}  // namespace cosserat_cable
