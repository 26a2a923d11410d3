#include "probe.h"

namespace cosserat_cable {
namespace {

constexpr double kStep = 2e-3;  // [s]
constexpr int kElements = 20;

}  // namespace

SimulatedRecord Probe(const Experiment& experiment, const Specimen& specimen,
                      const std::vector<Channel>& channels) {
  Experiment probed = experiment;
  probed.channels = channels;
  probed.record.values =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(experiment.record.t.size()),
                            static_cast<Eigen::Index>(channels.size()));
  SimulationOptions options;
  options.dt = kStep;
  options.elements = kElements;
  SimulatedRecord found = SimulateExperiment(probed, {specimen}, options).front();
  found.ok = found.ok && found.values.rows() > 0;
  return found;
}

}  // namespace cosserat_cable
