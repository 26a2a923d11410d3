// What a run came to: printed at its end by every tool, and written by --json.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "cosserat_cable/vehicle/clamp_judge.h"
#include "cosserat_cable/vehicle/finding.h"

namespace cosserat_cable {

struct CableSummary {
  std::string name;
  std::uint64_t steps = 0;
  std::uint64_t retried_steps = 0;  ///< had to be done in smaller ones
  std::uint64_t iterations = 0;     ///< Newton iterations in all
  double curvature_max = 0;         ///< [1/m]
  double clearance_min = std::numeric_limits<double>::infinity();  ///< [m]
  double contact_force_max = 0;                                    ///< [N]
  double tension_max = 0;                                          ///< [N]
  double amplitude_max = 0;           ///< peak to peak over the window [m]
  double dissipated = 0;              ///< since the cable last settled [J]
  double energy_residual = 0;         ///< what the energy balance lacks [J]
  double kinetic_max = 0;             ///< kinetic energy, of the cable's travel with its clamps [J]
  std::size_t bodies = 0;             ///< that it is kept clear of; 0: no clearance is measured
  double radius = 0;                  ///< [m]
  double contact_stiffness = 0;       ///< [N/m]
  double penetration_max = 0;         ///< of the radius into a body, over all steps [m]
  std::int64_t penetration_time = 0;  ///< when [ns]
  double penetration_s = 0;           ///< where along the cable [m]
  std::string penetration_body;       ///< the link; empty where nothing was touched
  double stiffness_needed =
      0;                      ///< where that was too deep: a contact stiffness that would do [N/m]
  std::string long_elements;  ///< see TooLongElements; empty where they are short enough
  std::string rest_remark;  ///< on its first equilibrium, see StepOutcome; empty where it is stable
  std::string failure;        ///< empty while all is well
  ClampJudge::Range clamps;   ///< how they moved to one another

  /// How deep the cable sank and what to do; "" where it was not too deep.
  std::string DepthWarning() const;
};

struct Summary {
  std::string world_frame;
  Eigen::Vector3d gravity_W = Eigen::Vector3d::Zero();  ///< [m/s^2]
  bool use_record_times = false;                        ///< instead of the messages' stamps
  std::vector<std::string> notes;                       ///< on the input
  double simulated_time = 0;                            ///< [s]
  double wall_time = 0;                                 ///< [s]
  double peak_memory = 0;                               ///< resident [bytes]
  std::uint64_t resets = 0;                             ///< the cables settled anew
  std::uint64_t gaps = 0;                               ///< of the input
  double smooth = 0;  ///< cutoff of the links' motion [Hz]; 0: none
  std::map<std::string, std::uint64_t> warnings;
  std::vector<std::string> warning_sentences;  ///< the same, with time, size and remedy
  Findings findings;  ///< what the input says that cannot be
  std::vector<CableSummary> cables;

  double real_time_factor() const { return wall_time > 0 ? simulated_time / wall_time : 0; }
  std::string ToText() const;
  /// Infinite values become null.
  std::string ToJson() const;
};

/// The process's largest resident memory so far [bytes].
double PeakMemory();

/// Writes `text` to `path`; false where that did not succeed in whole.
bool WriteTextFile(const std::string& path, const std::string& text);

}  // namespace cosserat_cable
