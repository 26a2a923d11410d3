// The keys of a cable as a user gave them, before defaults: shared by cable files and by whatever
// else describes a cable in the same keys (the `cable` and `specimen` maps of measurement sets).
//
//     MapReader map(value);
//     CableKeys keys = ReadCableKeys(&map);
//     keys.FillFrom(keys_of_its_type);
//     CableModel model = CompleteCable(keys, map.mark(), problems);
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cosserat_cable/cable/cable_model.h"
#include "cosserat_cable/cable/faults.h"
#include "cosserat_cable/cable/section_shape.h"
#include "cosserat_cable/input/map_reader.h"
#include "cosserat_cable/input/problems.h"

namespace cosserat_cable {

/// What a file says for one quantity.
template <typename T>
struct CableKey {
  std::optional<T> value;  ///< nothing where the key is absent, or wrong (then it was reported)
  SourceMark mark;         ///< line 0 where the key is absent
  SourceMark second = {};  ///< of a pair: where its second key is, if it has two
  bool given() const { return mark.line > 0; }
};

/// A Kelvin-Voigt coefficient as a file may say it.
struct DampingKey {
  enum class Kind {
    kNumber,
    kCritical,  ///< `critical`: eq. (10) of the source paper
    kUnknown    ///< `null`: to be identified; no simulation runs with it
  };
  Kind kind = Kind::kNumber;
  double value = 0;  ///< where it is a number; [N m^2 s] for bending and torsion, [N s] otherwise
};

struct LumpedMassKey {
  LumpedMass mass;
  SourceMark s_mark;
};

/// A link to avoid.
struct LinkKey {
  std::string name;
  SourceMark mark;
  std::optional<bool> use_visual;  ///< nothing: as the cable says
};

/// The law of contact; what is not given follows from the cable, or is ContactLaw's.
struct ContactKey {
  std::optional<double> stiffness;
  double smoothing = ContactLaw().smoothing, damping = ContactLaw().damping;
};

struct UncertainKey {
  std::string name;
  SourceMark mark;
};

struct ExtensionKey {
  CableExtension extension;
  SourceMark mark;
  /// Where the file gives its numbers, by part and path; those left out are not here.
  std::vector<std::map<std::string, SourceMark>> marks;
};

/// Pairs are about, or along, a1 and a2; a file gives them by one key (EI) or by two (EI1, EI2).
struct CableKeys {
  /// Either the diameter is given, or width and height.
  CableKey<double> length, diameter, width, height, mass_per_length, GJ, EA, apex_s;
  CableKey<std::array<double, 2>> EI, GA;
  CableKey<DampingKey> eta_GJ, eta_EA;
  CableKey<std::array<DampingKey, 2>> eta_EI, eta_GA;
  CableKey<std::vector<LumpedMassKey>> masses;
  CableKey<std::vector<UncertainKey>> uncertain;
  CableKey<int> elements;
  CableKey<std::vector<LinkKey>> avoid;
  CableKey<bool> use_visual;
  CableKey<ContactKey> contact;
  CableKey<std::vector<ExtensionKey>> extensions;
  /// Of the record that a specimen's cable is in, where a measurement set has some; ReadCableKeys
  /// refuses them, and WriteCableKeys leaves them out: the set's own reader and writer do it.
  CableKey<Faults> faults;

  /// Takes from `other` what is not given here. A pair is taken or left as a whole,
  /// and so are the section's sides, the extensions and the faults.
  void FillFrom(const CableKeys& other);
};

/// Reads the keys above. Nothing is required.
CableKeys ReadCableKeys(MapReader* map);

/// The keys as YAML, each line behind `indent`: what was given, and no defaults. Keys that only a
/// vehicle's cable has (apex, avoid, contact) are left out. ReadCableKeys reads it back to the
/// same.
std::string WriteCableKeys(const CableKeys& keys, const std::string& indent);

/// Fills in the defaults and checks what holds between keys. Missing keys, and damping that is
/// unknown, are problems, the former at `cable`. Name, reference and clamps stay as they are.
///
/// Defaults (eqs. 9 and 10 of the source paper): EA = 16 min(EI1, EI2)/d^2, GA = EA/3,
/// eta_EA = (4 L/pi) sqrt(rhoA EA), eta_GJ = (4 L/pi) sqrt(rhoJ GJ), eta_GA = 2 sqrt(rhoI GA).
/// Of a flat section EA = 12 min(EI1/height^2, EI2/width^2), and eta_GA1 goes with rhoI about a2,
/// eta_GA2 with that about a1, as shear does with bending.
/// The stiffness of contact as DefaultContactStiffness has it, of a cable without clamps.
CableModel CompleteCable(const CableKeys& keys, const SourceMark& cable, Problems* problems);

/// The section's outline, where the keys say it whole.
std::optional<SectionShape> ShapeOf(const CableKeys& keys);

}  // namespace cosserat_cable
