#include "cosserat_cable/identification/estimation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "channel_slips.h"
#include "estimation_remarks.h"
#include "estimation_work.h"
#include "record_scatter.h"
#include "stage_clock.h"

namespace cosserat_cable {
namespace {

// How often what differs between records is estimated anew, and the change that ends it.
constexpr int kScatterRounds = 6;
constexpr double kScatterSettled = 0.05;

bool Settled(const std::vector<ParameterScatter>& before,
             const std::vector<ParameterScatter>& after) {
  return std::equal(before.begin(), before.end(), after.begin(), after.end(),
                    [](const ParameterScatter& a, const ParameterScatter& b) {
                      return a.name == b.name && std::abs(a.sd / b.sd - 1) < kScatterSettled;
                    });
}

}  // namespace

Estimation Estimate(const MeasurementSet& set, const EstimationOptions& given, Problems* problems) {
  // Progress only goes forward, also where a part of the work is done again.
  EstimationOptions options = given;
  double farthest = 0;
  if (given.progress)
    options.progress = [&](const std::string& what, double part) {
      farthest = std::max(farthest, part);
      return given.progress(what, farthest);
    };
  StageClock clock;
  const auto seconds_left = [&] {
    return options.time_budget > 0 ? options.time_budget - clock.seconds()
                                   : std::numeric_limits<double>::infinity();
  };
  UnknownOptions unknown_options = options.unknowns;
  auto unknowns = std::make_unique<Unknowns>(set, unknown_options, problems);
  if (problems->empty()) {
    // The start must be a cable; what is wrong with it is the user's to know.
    for (std::size_t e = 0; e < set.experiments.size(); ++e)
      unknowns->MakeSpecimen(static_cast<int>(e), unknowns->StartValues(), problems);
  }
  if (problems->empty()) CheckClocks(set, problems);
  if (!problems->empty() || unknowns->size() == 0) {
    Estimation none;
    none.message = problems->empty() ? "the set names nothing to be identified" : "";
    return none;
  }
  auto work = std::make_unique<EstimationWork>(*unknowns, options, &clock);
  if (!work->FitFromStart()) return work->Answer();
  for (int round = 0;
       round < kScatterRounds && options.scatter && !work->hurried() && !work->misfit(); ++round) {
    const std::vector<ParameterScatter> found = work->Scatter();
    clock.Charge("scatter between records");
    if (Settled(unknown_options.scatter, found)) break;
    unknown_options.scatter = found;
    auto more = std::make_unique<Unknowns>(set, unknown_options, problems);
    auto next = std::make_unique<EstimationWork>(*more, options, &clock);
    if (!next->FitFrom(*work)) return next->Answer();
    work = std::move(next);
    unknowns = std::move(more);
  }
  work->Report(unknown_options.scatter);
  Estimation estimation = work->Answer();
  if (options.slips && !work->hurried()) {
    MeasurementSet mended = set;
    estimation.slips = FindSlips(set, estimation, options, seconds_left(), &mended);
    NameSlips(*unknowns, &estimation);
    if (!estimation.slips.empty())
      DoubtSlips(mended, *unknowns, options, seconds_left(), &estimation);
    clock.Charge("slips");
  }
  estimation.stages = clock.stages();
  estimation.seconds = clock.seconds();
  return estimation;
}

}  // namespace cosserat_cable
