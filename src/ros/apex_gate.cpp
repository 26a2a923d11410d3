#include "cosserat_cable/ros/apex_gate.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>

#include "cosserat_cable/ros/conversions.h"

namespace cosserat_cable {
namespace {

Eigen::Vector3d Position(const ApexTelemetry& m) {
  return {m.position_x, m.position_y, m.position_z};
}

Eigen::Vector3d Velocity(const ApexTelemetry& m) {
  return {m.velocity_x, m.velocity_y, m.velocity_z};
}

Eigen::Vector3d AxisOf(const std::vector<Eigen::Vector3d>& positions, char axis) {
  if (axis == 'x') return Eigen::Vector3d::UnitX();
  if (axis == 'y') return Eigen::Vector3d::UnitY();
  if (axis == 'z') return Eigen::Vector3d::UnitZ();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : positions) mean += p / static_cast<double>(positions.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : positions) scatter += (p - mean) * (p - mean).transpose();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(2);
}

// The highest value of the cubic between two samples `h` seconds apart with their derivatives.
double HighestBetween(double y0, double v0, double y1, double v1, double h) {
  double highest = std::max(y0, y1);
  // y = y0 + h v0 t + c t^2 + d t^3; its derivative's roots.
  const double c = 3 * (y1 - y0) - h * (2 * v0 + v1);
  const double d = 2 * (y0 - y1) + h * (v0 + v1);
  const double discriminant = c * c - 3 * d * h * v0;
  if (discriminant <= 0) return highest;
  for (const double sign : {-1.0, 1.0}) {
    // The root of the quadratic in the form that survives d = 0.
    const double denominator = c + sign * std::sqrt(discriminant);
    if (denominator == 0) continue;
    const double t = -h * v0 / denominator;
    if (t > 0 && t < 1) highest = std::max(highest, y0 + t * (h * v0 + t * (c + t * d)));
  }
  return highest;
}

class Judgement {
 public:
  explicit Judgement(const ApexBounds& bounds) : bounds_(bounds) {}

  void AtLeast(const char* what, double value, double bound, double scale, const char* unit) {
    Compare(what, value, bound, value >= bound, "at least", scale, unit);
  }
  void AtMost(const char* what, double value, double bound, double scale, const char* unit) {
    Compare(what, value, bound, value <= bound, "at most", scale, unit);
  }
  /// A bound on what is only there where the cable can touch something.
  void RequireBodies(const char* what, double bound) {
    if (!std::isnan(bound))
      Violate(std::string(what) +
              " cannot be judged: the cable has nothing to be clear of. Its `avoid` names no link "
              "whose geometry has an extent (or the telemetry is older than its field `bodies`)");
  }
  void Violate(const std::string& what) { verdict_.violations.push_back(Prefix() + what); }
  const ApexVerdict& verdict() const { return verdict_; }

 private:
  std::string Prefix() const { return bounds_.name.empty() ? "" : bounds_.name + ": "; }
  void Compare(const char* what, double value, double bound, bool good, const char* relation,
               double scale, const char* unit) {
    if (std::isnan(bound)) return;
    char text[200];
    std::snprintf(text, sizeof text, "%s is %.4f %s, expected %s %.4f", what, scale * value, unit,
                  relation, scale * bound);
    verdict_.measured.push_back(Prefix() + text);
    if (!good) Violate(text);
  }

  const ApexBounds& bounds_;
  ApexVerdict verdict_;
};

/// Of all that is judged; a clearance of +inf says that nothing is within reach.
bool IsFinite(const ApexTelemetry& m) {
  return Position(m).allFinite() && Velocity(m).allFinite() && std::isfinite(m.curvature_max) &&
         std::isfinite(m.contact_force) && m.clearance > -std::numeric_limits<double>::infinity();
}

// What a window may lack at its end: a live run stops some samples before its recording does.
constexpr double kLateEnd = 1, kLateShare = 0.1;  // [s], of the window

bool AnyBound(const ApexBounds& b) {
  for (const double bound :
       {b.peak_to_peak_min, b.peak_to_peak_max, b.min_clearance, b.max_penetration, b.max_curvature,
        b.max_contact_force, b.max_interval, b.max_rms_difference})
    if (!std::isnan(bound)) return true;
  return false;
}

struct Difference {
  double rms = 0;             // distance of positions with equal stamps [m]
  std::size_t unmatched = 0;  // messages whose stamp the comparison lacks
};

Difference Compare(const std::vector<ApexTelemetry>& messages,
                   const std::vector<ApexTelemetry>& comparison) {
  std::map<std::int64_t, Eigen::Vector3d> other;
  for (const ApexTelemetry& m : comparison) other[ToNanoseconds(m.header.stamp)] = Position(m);
  Difference difference;
  double sum = 0;
  for (const ApexTelemetry& m : messages) {
    const auto found = other.find(ToNanoseconds(m.header.stamp));
    if (found == other.end()) {
      ++difference.unmatched;
    } else {
      sum += (Position(m) - found->second).squaredNorm();
    }
  }
  const auto matched = static_cast<double>(messages.size() - difference.unmatched);
  difference.rms = std::sqrt(sum / std::max(1.0, matched));
  return difference;
}

/// A message of an earlier version: fields are only ever added at the end, and are zero here.
ApexTelemetry ReadOlder(const rosbag::MessageInstance& instance) {
  constexpr std::size_t kRoomForFields = 1024;
  std::vector<std::uint8_t> bytes(instance.size() + kRoomForFields, 0);
  ros::serialization::OStream out(bytes.data(), instance.size());
  instance.write(out);
  ros::serialization::IStream in(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ApexTelemetry message;
  ros::serialization::deserialize(in, message);
  return message;
}

}  // namespace

double PeakToPeak(const std::vector<ApexTelemetry>& messages, char axis) {
  if (messages.size() < 2) return 0;
  std::vector<Eigen::Vector3d> positions;
  for (const ApexTelemetry& m : messages) positions.push_back(Position(m));
  const Eigen::Vector3d direction = AxisOf(positions, axis);
  double high = -std::numeric_limits<double>::infinity();
  double low = high;  // of the mirrored motion
  for (std::size_t i = 1; i < messages.size(); ++i) {
    const double h = (messages[i].header.stamp - messages[i - 1].header.stamp).toSec();
    const double y0 = direction.dot(positions[i - 1]), y1 = direction.dot(positions[i]);
    const double v0 = direction.dot(Velocity(messages[i - 1]));
    const double v1 = direction.dot(Velocity(messages[i]));
    high = std::max(high, HighestBetween(y0, v0, y1, v1, h));
    low = std::max(low, HighestBetween(-y0, -v0, -y1, -v1, h));
  }
  return high + low;
}

ApexVerdict Judge(const std::vector<ApexTelemetry>& messages,
                  const std::vector<ApexTelemetry>& comparison, const ApexBounds& bounds) {
  Judgement judgement(bounds);
  std::vector<ApexTelemetry> window;
  for (const ApexTelemetry& m : messages) {
    const double t = (m.header.stamp - messages.front().header.stamp).toSec();
    if (t >= bounds.start && t <= bounds.end) window.push_back(m);
  }
  if (window.size() < 2) {
    judgement.Violate("fewer than two messages in the window");
    return judgement.verdict();
  }
  const auto bad = std::count_if(window.begin(), window.end(),
                                 [](const ApexTelemetry& m) { return !IsFinite(m); });
  if (bad > 0) {
    judgement.Violate(std::to_string(bad) + " of " + std::to_string(window.size()) +
                      " messages have values that are not finite: nothing is judged");
    return judgement.verdict();
  }
  if (!AnyBound(bounds)) judgement.Violate("no bound is given: nothing is judged");
  const double last = (window.back().header.stamp - messages.front().header.stamp).toSec();
  const double allowed = std::max(kLateEnd, kLateShare * (bounds.end - bounds.start));
  if (std::isfinite(bounds.end) && bounds.end - last > allowed) {
    char text[200];
    std::snprintf(text, sizeof text,
                  "the telemetry ends at %.3f s, long before the window does at %.3f s: did the "
                  "cable fail?",
                  last, bounds.end);
    judgement.Violate(text);
  }
  double clearance = std::numeric_limits<double>::infinity();
  double curvature = 0, force = 0;
  // A run that ends within the window leaves an interval, too.
  const ros::Time zero = messages.front().header.stamp;
  double interval = (window.front().header.stamp - zero).toSec() - bounds.start;
  if (std::isfinite(bounds.end)) {
    interval = std::max(interval, bounds.end - (window.back().header.stamp - zero).toSec());
  }
  for (const ApexTelemetry& m : window) {
    clearance = std::min(clearance, m.clearance);
    curvature = std::max(curvature, m.curvature_max);
    force = std::max(force, m.contact_force);
  }
  for (std::size_t i = 1; i < window.size(); ++i) {
    interval = std::max(interval, (window[i].header.stamp - window[i - 1].header.stamp).toSec());
  }
  const double swing = PeakToPeak(window, bounds.axis);
  judgement.AtLeast("peak to peak", swing, bounds.peak_to_peak_min, 1e3, "mm");
  judgement.AtMost("peak to peak", swing, bounds.peak_to_peak_max, 1e3, "mm");
  // A cable that avoids nothing is as far from it all the time as one that nothing comes near.
  const bool nothing_to_touch =
      std::isinf(clearance) && std::any_of(window.begin(), window.end(),
                                           [](const ApexTelemetry& m) { return m.bodies == 0; });
  if (nothing_to_touch) {
    judgement.RequireBodies("clearance", bounds.min_clearance);
    judgement.RequireBodies("penetration", bounds.max_penetration);
    judgement.RequireBodies("contact force", bounds.max_contact_force);
  }
  judgement.AtLeast("clearance", clearance, bounds.min_clearance, 1e3, "mm");
  judgement.AtMost("penetration", std::max(0.0, -clearance), bounds.max_penetration, 1e3, "mm");
  judgement.AtMost("curvature", curvature, bounds.max_curvature, 1, "1/m");
  judgement.AtMost("contact force", force, bounds.max_contact_force, 1, "N");
  judgement.AtMost("interval between messages", interval, bounds.max_interval, 1e3, "ms");
  if (!std::isnan(bounds.max_rms_difference)) {
    const Difference difference = Compare(window, comparison);
    judgement.AtMost("rms difference from the comparison", difference.rms,
                     bounds.max_rms_difference, 1e3, "mm");
    if (difference.unmatched > 0) {
      judgement.Violate(std::to_string(difference.unmatched) + " of " +
                        std::to_string(window.size()) + " stamps are not in the comparison");
    }
  }
  return judgement.verdict();
}

std::vector<ApexTelemetry> ReadApexTelemetry(const std::string& path, const std::string& cable,
                                             Problems* problems) {
  std::vector<ApexTelemetry> messages;
  try {
    rosbag::Bag bag(path);
    rosbag::View view(bag, rosbag::TopicQuery("/cables/" + cable + "/apex"));
    for (const rosbag::MessageInstance& instance : view) {
      const auto message = instance.instantiate<ApexTelemetry>();
      if (message) {
        messages.push_back(*message);
      } else if (instance.getDataType() == ros::message_traits::datatype<ApexTelemetry>()) {
        messages.push_back(ReadOlder(instance));
      }
    }
    if (messages.empty()) problems->Add(path, "no telemetry of cable '" + cable + "'");
  } catch (const std::exception& error) {  // a damaged bag throws more than rosbag::BagException
    problems->Add(path, error.what());
  }
  return messages;
}

}  // namespace cosserat_cable
