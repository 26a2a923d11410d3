#include "attitude_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/measurement/experiment_simulation.h"
#include "cosserat_cable/measurement/specimen.h"
#include "cosserat_cable/measurement/w_first.h"

namespace cosserat_cable {
namespace {

// Of the cable's length, root mean square over the coordinates: farther from its rest than a
// swing's mean or the stiffness explains, and as near as it must be with w first; and that in parts
// of the first.
constexpr double kFar = 0.12, kNear = 0.15, kMuchNearer = 0.15;
// One coordinate may be near by chance.
constexpr std::size_t kSeveral = 2;
// What a set says of a stiffness may be so far off, either way.
constexpr double kStiffnesses[] = {1, 0.25, 4};
constexpr int kElements = 20;

bool IsPlaced(const Channel& channel) {
  return channel.quantity == Quantity::kPosition && !channel.unknown_offset;
}

bool IsHeld(const EndCondition& end) { return end.kind == EndCondition::Kind::kClamp; }

/// The experiment at its start, with nothing but gravity and the load of that time. Where `held`, a
/// point that is held is shown as if by channels, beside the record: it is known in space, but may
/// be pulled far away.
Experiment AtRest(const Experiment& experiment, bool held) {
  Experiment rest = experiment;
  for (EndCondition* end : {&rest.a, &rest.b}) {
    if (!end->motion || end->motion->poses.empty()) continue;
    end->pose = end->motion->poses.front();
    end->motion.reset();
  }
  auto& forces = rest.load.samples;
  if (!rest.load.file.empty() && !forces.empty()) {
    const double first = forces.front().t;
    forces.erase(std::remove_if(forces.begin(), forces.end(),
                                [&](const auto& force) { return force.t > first; }),
                 forces.end());
    rest.load.file.clear();
  }
  rest.record.quasi_static = true;
  rest.record.t = {0};
  rest.channels.clear();
  std::vector<double> shown;
  for (std::size_t c = 0; c < experiment.channels.size(); ++c) {
    if (!IsPlaced(experiment.channels[c])) continue;
    rest.channels.push_back(experiment.channels[c]);
    const auto column = experiment.record.values.col(static_cast<Eigen::Index>(c));
    // A swing is about the rest, a cable that rests at first is there.
    const bool rests = experiment.start.kind == StartCondition::Kind::kRest;
    shown.push_back(rests ? column[0] : column.mean());
  }
  if (held)
    for (int axis = 0; axis < 3; ++axis) {
      Channel point;
      point.s = experiment.start.held.s;
      point.axis = axis;
      rest.channels.push_back(point);
      shown.push_back(experiment.start.held.position_W[axis]);
    }
  if (experiment.start.kind != StartCondition::Kind::kRest) rest.start = StartCondition();
  rest.record.values =
      Eigen::Map<Eigen::RowVectorXd>(shown.data(), static_cast<Eigen::Index>(shown.size()));
  return rest;
}

/// Root mean square over the channels [m], at the stiffness that fits best; infinite where the
/// cable finds no rest.
struct Distance {
  double signed_as_given = std::numeric_limits<double>::infinity();
  double with_any_signs = std::numeric_limits<double>::infinity();
};

Distance DistanceOf(const Experiment& rest, const std::vector<Specimen>& specimens) {
  SimulationOptions options;
  options.elements = kElements;
  Distance distance;
  for (const SimulatedRecord& one : SimulateExperiment(rest, specimens, options)) {
    if (!one.ok || !one.values.allFinite()) continue;
    const Eigen::ArrayXXd simulated = one.values.array(), shown = rest.record.values.array();
    const Eigen::ArrayXXd apart = (shown - simulated).abs();
    const Eigen::ArrayXXd turned = (shown + simulated).abs();
    distance.signed_as_given = std::min(distance.signed_as_given, std::sqrt(apart.square().mean()));
    distance.with_any_signs =
        std::min(distance.with_any_signs, std::sqrt(apart.min(turned).square().mean()));
  }
  return distance;
}

std::vector<Specimen> Specimens(const MeasurementSet& set, const Experiment& experiment,
                                Problems* problems) {
  const Specimen given =
      MakeSpecimen(WithoutUnknownDamping(SpecimenKeys(set, experiment)), experiment, problems);
  std::vector<Specimen> specimens;
  for (const double factor : kStiffnesses) {
    specimens.push_back(given);
    CableModel& cable = specimens.back().cable;
    for (double* stiffness : {&cable.EI1, &cable.EI2, &cable.GJ}) *stiffness *= factor;
  }
  return specimens;
}

/// Which quaternions look as if they were written w first, and how near the cable is with that.
struct WFirst {
  bool a = false, b = false;
  double given = 0, meant = 0;  // [m]; the first is infinite where no rest was found
};

std::optional<WFirst> FindWFirst(const Experiment& rest, const std::vector<Specimen>& specimens) {
  const double length = specimens.front().cable.length;
  const Distance given = DistanceOf(rest, specimens);
  if (!(given.signed_as_given > kFar * length)) return std::nullopt;
  std::vector<std::pair<bool, bool>> which = {{true, false}};
  if (IsHeld(rest.b)) which.insert(which.end(), {{false, true}, {true, true}});
  WFirst found;
  found.given = given.signed_as_given;
  found.meant = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : which) {
    Experiment meant = rest;
    if (a) meant.a.pose = MeantWithWFirst(rest.a.pose);
    if (b) meant.b.pose = MeantWithWFirst(rest.b.pose);
    const double distance = DistanceOf(meant, specimens).signed_as_given;
    if (distance < found.meant) found = {a, b, found.given, distance};
  }
  if (!(found.meant < kNear * length) || !(found.meant < kMuchNearer * found.given))
    return std::nullopt;
  // A turned sign of a channel explains it as well: that is for the search for slips.
  if (given.with_any_signs < std::max(found.meant, kMuchNearer * found.given)) return std::nullopt;
  return found;
}

void CheckExperiment(const MeasurementSet& set, const Experiment& experiment, Problems* problems,
                     Problems* warnings) {
  if (!IsHeld(experiment.a) || experiment.record.values.rows() == 0) return;
  Problems unused;
  std::vector<Specimen> specimens;
  for (const bool held : {false, true}) {
    if (held && experiment.start.kind != StartCondition::Kind::kHeld) continue;
    const Experiment rest = AtRest(experiment, held);
    if (rest.channels.empty()) continue;
    if (specimens.empty()) specimens = Specimens(set, rest, &unused);
    if (!unused.empty()) return;
    const std::optional<WFirst> found = FindWFirst(rest, specimens);
    if (!found) continue;
    const std::string apart = std::isfinite(found->given)
                                  ? "the cable at rest is " + FormatRounded(found->given, 2) +
                                        " m from where the record shows it"
                                  : std::string("the cable finds no rest");
    const auto name = [&](const EndCondition& end) {
      (rest.channels.size() < kSeveral ? warnings : problems)
          ->Add(end.mark.file, end.mark.line, end.motion ? "motion" : "pose",
                (end.motion ? end.motion->file + ": got quaternions"
                            : std::string("got a quaternion")) +
                    " with which " + apart + ", " + FormatRounded(found->meant, 2) +
                    " m with w first: looks like w first (qw, qx, qy, qz), expected qx, qy, qz, "
                    "qw");
    };
    if (found->a) name(experiment.a);
    if (found->b) name(experiment.b);
    return;
  }
}

}  // namespace

void CheckAttitudes(const MeasurementSet& set, Problems* problems, Problems* warnings) {
  for (const Experiment& experiment : set.experiments)
    CheckExperiment(set, experiment, problems, warnings);
}

}  // namespace cosserat_cable
