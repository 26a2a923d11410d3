#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/identification/direct_evaluation.h"

namespace cosserat_cable {
namespace {

using nlohmann::json;

json ValueJson(const DirectValue& v) {
  return {{"value", v.value}, {"sd", v.sd},           {"interval", {v.low, v.high}},
          {"count", v.count}, {"scatter", v.scatter}, {"scatters", v.scatters}};
}

json RingJson(const DirectRingDown& ring) {
  json out = {{"experiment", ring.experiment},
              {"channels", ring.channels},
              {"length", ring.length},
              {"messages", ring.messages},
              {"biases", json::array()}};
  if (!ring.plane.empty()) out["plane"] = ring.plane;
  if (ring.inertia > 0) out["inertia"] = ring.inertia;
  if (!ring.refused.empty()) {
    out["refused"] = ring.refused;
    return out;
  }
  out["omega"] = {ring.omega, ring.omega_sd};
  out["delta"] = {ring.delta, ring.delta_sd};
  out["undamped"] = ring.undamped;
  out["stiffness"] = {ring.stiffness, ring.stiffness_sd};
  out["damping"] = {ring.damping, ring.damping_sd};
  for (const DirectBias& bias : ring.biases) {
    out["biases"].push_back({{"name", bias.name},
                             {"of", bias.of},
                             {"relative", bias.relative},
                             {"order_only", bias.order_only},
                             {"text", bias.text}});
  }
  return out;
}

json RingsJson(const std::vector<DirectRingDown>& rings) {
  json out = json::array();
  for (const DirectRingDown& ring : rings) out.push_back(RingJson(ring));
  return out;
}

}  // namespace

json ToJson(const DirectEvaluation& evaluation) {
  json out = {{"bending", RingsJson(evaluation.bending)},
              {"torsion", RingsJson(evaluation.torsion)},
              {"values", json::object()},
              {"undetermined", evaluation.undetermined},
              {"critical", evaluation.critical},
              {"messages", evaluation.messages}};
  for (const auto& [name, value] : evaluation.values) out["values"][name] = ValueJson(value);
  if (evaluation.values.count(kEndDamping) > 0) {
    out["eta_GJ_D_E_correlation"] = evaluation.eta_GJ_D_E_correlation;
  }
  if (evaluation.combination) {
    json combination = ValueJson(*evaluation.combination);
    combination["text"] = "eta_GJ/L + D_E";
    combination["unit"] = "N m s";
    combination["length"] = evaluation.combination_length;
    out["combination"] = combination;
  }
  return out;
}

}  // namespace cosserat_cable
