// The source paper's evaluation of oscillation tests, eqs. (10) to (13): straight from frequencies
// and decay rates to stiffness and damping, without a simulation. Its biases are known and named,
// and not corrected: the fit through the simulation has none of them.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

struct DirectValue {
  double value = 0, sd = 0;
  double low = 0, high = 0;  ///< 95 % interval
  int count = 0;             ///< of ring-downs in it
  /// What they scatter beyond their standard errors, as a standard deviation; `sd` has it in it.
  double scatter = 0;
  bool scatters = false;  ///< whether that is more than chance gives (chi-square, 95 %)
};

/// Why a value of the direct evaluation is off, and by how much for this rig.
struct DirectBias {
  std::string name;  ///< gravity, sag, large_amplitude, masses, cable_inertia, disc_weight
  std::string of;    ///< EI or GJ
  /// By how much of the true value the direct one is too high; an order of magnitude, without its
  /// sign, where `order_only`.
  double relative = 0;
  bool order_only = false;
  std::string text;  ///< for people
};

/// One ring-down; the channels that show the same motion together.
struct DirectRingDown {
  std::string experiment;
  std::string refused;  ///< why it gives nothing; then the numbers are 0
  std::string plane;    ///< bending: "in the plane of the sag", "across the sag", "across"
  std::vector<std::string> channels;
  double length = 0;     ///< [m]
  double inertia = 0;    ///< of the disc [kg m^2]; 0 in bending
  double omega = 0;      ///< Omega [rad/s]
  double omega_sd = 0;   ///< [rad/s]
  double delta = 0;      ///< [1/s]
  double delta_sd = 0;   ///< [1/s]
  double undamped = 0;   ///< w, eq. (11) [rad/s]
  double stiffness = 0;  ///< [EI]dyn or [GJ]dyn [N m^2]
  double stiffness_sd = 0;
  double damping = 0;  ///< bending: [eta_EI]; torsion: [eta_GJ] + L D_E [N m^2 s]
  double damping_sd = 0;
  std::vector<DirectBias> biases;
  std::vector<std::string> messages;
};

struct DirectEvaluation {
  std::vector<DirectRingDown> bending, torsion;
  /// EI, eta_EI, GJ, eta_GJ and the loss at the disc as far as the set has them, by their paths in
  /// the cable file [N m^2], [N m^2 s], [N m s]. In formulas that loss is the source paper's D_E.
  std::map<std::string, DirectValue> values;
  std::map<std::string, std::string> undetermined;  ///< why, for those that it has a test for
  double eta_GJ_D_E_correlation = 0;                ///< where both are determined
  /// eta_GJ/L + D_E [N m s], where all pendulums have one length.
  std::optional<DirectValue> combination;
  double combination_length = 0;  ///< [m]
  /// Eq. (10) with the values above or else the set's: eta_EA [N s], eta_GA [N s], eta_GJ [N m^2
  /// s].
  std::map<std::string, double> critical;
  std::vector<std::string> messages;
};

/// Evaluates the ring-downs of clamped-free cables and of torsional pendulums with a disc; other
/// experiments are left out. @pre the set was read without a problem
DirectEvaluation EvaluateDirectly(const MeasurementSet& set);

nlohmann::json ToJson(const DirectEvaluation& evaluation);

/// In words, where a stiffness is another one than a fit's by far more than both intervals and the
/// biases that are known of this rig: one of the two has taken another swing for the record's.
/// Empty where the two agree as well as they can, or there is none of that name.
/// @param low, high of the fit's 95 % interval
std::string DisagreementOf(const DirectEvaluation& evaluation, const std::string& name, double low,
                           double high);

}  // namespace cosserat_cable
