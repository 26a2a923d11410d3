#pragma once

#include <set>
#include <string>
#include <vector>

#include "blind_set.h"
#include "rig_mix.h"
#include "variation.h"

namespace cosserat_cable::generator {

/// What a suite makes of a plan: kinds at work, rigs to see them in, and what is to be found.
struct Case {
  std::vector<const EffectKind*> kinds;
  std::set<Rig> rigs;
  std::string label;
  Expectation expected;
  std::string form;                   ///< of the cause; empty: any
  const EffectKind* rival = nullptr;  ///< what it looks like
  std::string rival_form;
  bool unseen_torsion = false;  ///< and the record to predict is one
  bool known_starts = false;    ///< in all cases
  bool unknown_starts = false;
  bool tip_only = false;    ///< no second marker
  bool fixed_size = false;  ///< as strong as usual, however little of it recalibration leaves
  int steps = 0;            ///< of slow bending that are left; 0: all
  std::vector<std::string> uncertain = {"EI", "GJ", "eta_EI", "eta_GJ"};
};

Case singleCase(const BlindPlan& plan, Random* random);
Case nullCase(const BlindPlan& plan, Random* random);
Case outsideCase(const BlindPlan& plan, Random* random);

/// One of two look-alikes, with the experiments that tell them apart.
Case twinsCase(const BlindPlan& plan, Random* random);
/// The same without these.
Case twinsWithoutCase(const BlindPlan& plan, Random* random);
/// Causes that recalibration takes in whole.
Case absorbedCase(const BlindPlan& plan, Random* random);
Case pairsCase(const BlindPlan& plan, Random* random);
/// Records that cannot show what is asked for.
Case unidentifiableCase(const BlindPlan& plan, Random* random);

/// Rigs that every cause is looked for in.
std::set<Rig> commonRigs();
/// Those that tell the cause from its neighbours.
std::set<Rig> tellingRigs(const std::string& cause, bool torsional);
/// Adds rigs at random until there are so many.
void fillUp(size_t count, std::set<Rig>* rigs, Random* random);

}  // namespace cosserat_cable::generator
