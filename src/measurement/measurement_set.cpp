#include "cosserat_cable/measurement/measurement_set.h"

#include <algorithm>
#include <filesystem>
#include <limits>

namespace cosserat_cable {

const char* ToString(Quantity quantity) {
  switch (quantity) {
    case Quantity::kPosition:
      return "position";
    case Quantity::kVelocity:
      return "velocity";
    case Quantity::kAcceleration:
      return "acceleration";
    case Quantity::kAngle:
      return "angle";
    case Quantity::kRate:
      return "rate";
    case Quantity::kForce:
      return "force";
    case Quantity::kMoment:
      return "moment";
  }
  return "";
}

double MedianInterval(const std::vector<double>& t) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < t.size(); ++i) intervals.push_back(t[i] - t[i - 1]);
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

std::vector<std::string> FilesOf(const MeasurementSet& set) {
  std::vector<std::string> files = {set.file};
  const auto add = [&](const std::string& name) {
    if (!name.empty()) files.push_back((std::filesystem::path(set.folder) / name).string());
  };
  for (const Experiment& experiment : set.experiments) {
    add(experiment.record.file);
    add(experiment.load.file);
    for (const EndCondition* end : {&experiment.a, &experiment.b})
      if (end->motion) add(end->motion->file);
  }
  return files;
}

double Experiment::start_time() const {
  double first = std::numeric_limits<double>::infinity();
  for (const EndCondition* end : {&a, &b}) {
    if (end->motion && !end->motion->t.empty()) first = std::min(first, end->motion->t.front());
  }
  return first < std::numeric_limits<double>::infinity() || record.t.empty() ? first
                                                                             : record.t.front();
}

}  // namespace cosserat_cable
