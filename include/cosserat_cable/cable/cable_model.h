// What a cable is: one YAML schema, version 1, read by every tool.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "cosserat_cable/cable/cable_extension.h"
#include "cosserat_cable/contact/contact_law.h"
#include "cosserat_cable/input/problems.h"
#include "cosserat_cable/input/yaml_value.h"
#include "cosserat_cable/math/pose.h"

namespace cosserat_cable {

/// Where an end is clamped: the section frame's pose in a link, a3 (z) along growing s at both
/// ends.
struct ClampModel {
  std::string link;  ///< empty for a specimen, whose clamps its measurement set knows
  Pose X_LC;
};

struct LumpedMass {
  double s;     ///< arc length [m]
  double mass;  ///< [kg]
};

/// A cable as its file says it: geometry, effective section parameters, clamps. Defaults are
/// already filled in (EA, GA and the critical damping of eq. 10), so every number here is finite.
/// SI units.
struct CableModel {
  std::string name;
  std::string reference;  ///< link that telemetry and markers are given in
  ClampModel a, b;

  double length = 0;                            ///< L [m], free length between the clamps
  double diameter = 0;                          ///< d [m]; of a flat section its larger side
  double width = 0, height = 0;                 ///< of a flat section, along a1, a2 [m]; else 0
  double mass_per_length = 0;                   ///< rhoA [kg/m]
  double EI1 = 0, EI2 = 0;                      ///< bending stiffness about a1, a2 [N m^2]
  double GJ = 0;                                ///< torsional stiffness [N m^2]
  double GA1 = 0, GA2 = 0;                      ///< shear stiffness [N]
  double EA = 0;                                ///< axial stiffness [N]
  double eta_EI1 = 0, eta_EI2 = 0, eta_GJ = 0;  ///< Kelvin-Voigt coefficients [N m^2 s]
  double eta_GA1 = 0, eta_GA2 = 0, eta_EA = 0;  ///< [N s]
  std::vector<LumpedMass> masses;

  double apex_s = 0;  ///< material point whose motion is reported [m], default L/2
  int elements = 40;
  std::vector<std::string> avoid;      ///< links whose collision geometry the cable may touch
  std::set<std::string> avoid_visual;  ///< those of them whose visual geometry counts instead
  ContactLaw contact;
  std::vector<CableExtension> extensions;  ///< physics beyond the Kelvin-Voigt rod; default none
  std::vector<std::string>
      uncertain;  ///< keys that identification may adjust; unused in simulation

  bool flat() const { return width > 0; }
  /// Rotary inertia about a1, a2 and a3 [kg m].
  double rhoI1() const { return flat() ? mass_per_length * height * height / 12 : rhoI(); }
  double rhoI2() const { return flat() ? mass_per_length * width * width / 12 : rhoI(); }
  double rhoJ() const { return rhoI1() + rhoI2(); }
  /// Of a round section, about a1 as about a2 [kg m].
  double rhoI() const { return mass_per_length * diameter * diameter / 16; }
};

/// Where a cable's file names what only the vehicle can confirm. Line 0 where nothing is named.
struct CableMarks {
  SourceMark cable;  ///< the cable's own entry
  SourceMark name;
  SourceMark reference;  ///< that of a's link where the file leaves the reference out
  SourceMark a_link, b_link;
  std::vector<SourceMark> avoid;  ///< one per link in CableModel::avoid
};

/// A file with one cable (`cable:`, a specimen, which needs no links) or a vehicle's (`cables:`).
struct CableFile {
  std::vector<CableModel> cables;
  std::vector<CableMarks> marks;  ///< as many as cables
  bool specimen = false;          ///< whether the file said `cable:`
};

/// Reads a cable file. Every mistake goes to `problems` with file, line and key, in the order of
/// the lines: unknown keys with the nearest known one, missing keys, wrong types, numbers that are
/// not finite or out of range (a length of 200 is named as a likely slip of units), names that
/// clash. Where `problems` grew, the result is not to be used. `sections`: as SectionFiles has
/// them, of a vehicle's cables.
CableFile LoadCableFile(const std::string& path, Problems* problems,
                        const std::vector<std::string>& sections = {});

/// The same of a cable file that is a value in another one.
CableFile ReadCableFile(const YamlValue& root, Problems* problems);

/// The effective configuration: a whole cable file with every default filled in and types spelt
/// out. It reads back to the same models, bit for bit.
std::string WriteCableFile(const CableFile& file);

}  // namespace cosserat_cable
