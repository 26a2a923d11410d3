#pragma once

#include <string>
#include <vector>

#include "effect.h"

namespace cosserat_cable::generator {

// One per file of this folder.
extern const EffectKind kMaxwell, kStructuralDamping, kSectionFriction, kNonlinearStiffness,
    kAnisotropy, kRestCurvature, kBendTwistCoupling, kClampCompliance, kClampDamping,
    kClampFriction, kClampPlay, kAirDrag, kExternalDamping, kAddedMass, kContact, kDrift, kClock,
    kSensor, kBaseMotion;

/// All of them.
const std::vector<const EffectKind*>& effectKinds();

/// The kind of that name; throws std::invalid_argument naming those that exist.
const EffectKind& effectKind(const std::string& name);

/// The kind at its default size times `size`. clamp_damping brings clamp_compliance: a dashpot
/// beside a spring.
std::vector<EffectChoice> chooseEffects(const std::vector<std::string>& names, double size,
                                        const EffectScale& scale);

/// Sets `PATH=VALUE`, PATH as NAME.path; NAME may be left out where one effect is chosen. Throws
/// std::invalid_argument naming what can be set.
void setEffectValue(const std::string& assignment, std::vector<EffectChoice>* choices);

/// A value's path in a measurement set: extensions.air_drag.Cd.
std::string effectPath(const EffectKind& kind, const std::string& path);

/// Fresh effects for one experiment.
std::vector<std::shared_ptr<Effect>> makeEffects(const std::vector<EffectChoice>& choices,
                                                 const EffectSite& site);

}  // namespace cosserat_cable::generator
