// What a fit looks for: parameters of the cable, and what else is not known of the measurement.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/input/problems.h"
#include "cosserat_cable/measurement/experiment_simulation.h"
#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

/// One number that is looked for.
struct Unknown {
  enum class Kind {
    kCable,   ///< a parameter of the registry, the same in all experiments: of the cable, its
              ///< extensions, the disc, or a fault of the records
    kOffset,  ///< of a channel
    kSwing,   ///< amplitude of a shape at an unknown start
    kSpeed,   ///< the same, of its velocity
    kTilt,    ///< of clamp a about its a1 or a2 [rad]
    kLength,  ///< what a specimen is longer than the set says [m]
    kScatter  ///< by what a parameter of the cable differs in one record from its mean
  };
  /// In which variable its effect is most nearly linear.
  enum class Scaling {
    kLinear,
    kReciprocal,  ///< what fades as it grows: a clamp's stiffness, a filter's frequency
    kLogarithmic  ///< a threshold, a time
  };
  Kind kind = Kind::kCable;
  Scaling scaling = Scaling::kLinear;
  std::string name;  ///< "EI"; "ringdown/tip_x.offset"
  std::string unit;
  double start = 0;
  double scale = 1;  ///< a change of this size changes the records markedly
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool damping = false;                           ///< a viscous loss
  ParameterSign sign = ParameterSign::kPositive;  ///< of a parameter of the registry
  double prior_sd = 0;      ///< known beforehand to be `start` within this; 0: nothing is known
  int experiment = -1;      ///< whose, where it is not the cable's
  int index = 0;            ///< channel, shape, axis, or which unknown it is the scatter of
  bool start_known = true;  ///< false: the set says null, and `start` is a guess of its size
};

/// The variable of a fit: 1 at the unknown's scale, and value/scale where its scaling is linear.
double VariableOf(const Unknown& unknown, double value);
/// @pre a reciprocal's variable is positive
double ValueOf(const Unknown& unknown, double variable);
/// Derivative of value/scale by the variable.
double VariableSlope(const Unknown& unknown, double variable);

/// A parameter of the cable that differs from record to record: a clamp that was fastened anew,
/// another specimen.
struct ParameterScatter {
  std::string name;
  double sd = 0;    ///< standard deviation between records [the parameter's unit]
  int records = 0;  ///< that show it
  int freedom = 0;  ///< of what the sd was estimated from
};

/// What may be asked of a fit besides the set's own `uncertain`.
struct UnknownOptions {
  double clamp_sd = 0;      ///< clamp a points elsewhere, by about this angle [rad]; 0: it does not
  double length_sd = 0;     ///< free lengths are wrong by about this [m]; 0: they are not
  bool end_damping = true;  ///< the dashpot D_E at a disc is one of the unknowns
  std::vector<ParameterScatter> scatter;  ///< what differs from record to record
};

/// The unknowns of a set, and the specimens that go with values for them.
class Unknowns {
 public:
  /// Keys of the set that are missing or make no sense are problems.
  Unknowns(const MeasurementSet& set, const UnknownOptions& options, Problems* problems);

  const std::vector<Unknown>& all() const { return all_; }
  int size() const { return static_cast<int>(all_.size()); }
  const MeasurementSet& set() const { return set_; }

  /// Unknown starts are looked for in the same shapes as another's: of two modes of one frequency,
  /// each set of unknowns may have other ones. Where `experiment` is not negative, the only
  /// experiment here is that one of the other's. What has other numbers of shapes keeps its own.
  void ShareShapes(const Unknowns& other, int experiment = -1);

  Eigen::VectorXd StartValues() const;
  /// Whether the unknown can have any effect on the experiment.
  bool Concerns(int unknown, int experiment) const;
  /// The experiment's specimen with these values. Values that make no cable: `problems` grow.
  Specimen MakeSpecimen(int experiment, const Eigen::VectorXd& values, Problems* problems) const;
  /// Parameters of the registry that are set besides the unknowns.
  struct Setting {
    std::vector<std::pair<std::string, double>> numbers;  ///< by path
    std::vector<std::string> channels;  ///< of the last sensor fault; none: all channels
  };
  /// The same with a setting, as far as the experiment can have it.
  Specimen MakeSpecimen(int experiment, const Eigen::VectorXd& values, const Setting& also,
                        Problems* problems) const;
  /// Sum of the channels' offsets at these values, to be added to what is simulated.
  double OffsetOf(int experiment, int channel, const Eigen::VectorXd& values) const;

  /// The set's keys with these values filled in: the identified cable.
  CableKeys FilledKeys(const Eigen::VectorXd& values) const;
  /// The set with these values filled in where they stand: cable, discs and faults.
  MeasurementSet FilledSet(const Eigen::VectorXd& values) const;
  /// Index of the unknown with this name, or -1.
  int Find(const std::string& name) const;

 private:
  void AddUnknownDampings(std::vector<std::string>* names) const;
  void AddScatter(const ParameterScatter& scatter);
  void AddCable(const std::string& name, Problems* problems);
  void AddSwing(int experiment);
  std::optional<double> DefaultOf(const std::string& name) const;
  bool FaultConcerns(const std::string& name, int experiment) const;

  MeasurementSet set_;
  std::vector<Unknown> all_;
  std::vector<CableKeys> keys_;                  // of each experiment's specimen
  std::vector<std::vector<SwingShape>> shapes_;  // of each experiment with an unknown start
};

}  // namespace cosserat_cable
