#include "rod.h"

#include <cmath>

namespace cosserat_cable::generator {

Rod makeRod(const CableData& data) {
  const double kPi = std::acos(-1.0);
  const double EA = 16.0 * data.EI / (data.diameter * data.diameter);
  const double GA = EA / 3.0;
  const double rhoI = data.rhoA * data.diameter * data.diameter / 16.0;
  const double eta_EA = 4.0 * data.length / kPi * std::sqrt(data.rhoA * EA);
  const double eta_GA = 2.0 * std::sqrt(rhoI * GA);
  Rod rod;
  rod.length = data.length;
  rod.diameter = data.diameter;
  rod.rhoA = data.rhoA;
  rod.C_M = {data.EI, data.EI, data.GJ};
  rod.C_F = {GA, GA, EA};
  rod.V_M = {data.eta_EI, data.eta_EI, data.eta_GJ};
  rod.V_F = {eta_GA, eta_GA, eta_EA};
  rod.rhoJ = {rhoI, rhoI, 2.0 * rhoI};
  rod.masses = data.masses;
  return rod;
}

}  // namespace cosserat_cable::generator
