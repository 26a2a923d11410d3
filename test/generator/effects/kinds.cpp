#include "kinds.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace cosserat_cable::generator {

const std::vector<const EffectKind*>& effectKinds() {
  static const std::vector<const EffectKind*> kinds = {&kMaxwell,
                                                       &kStructuralDamping,
                                                       &kSectionFriction,
                                                       &kNonlinearStiffness,
                                                       &kAnisotropy,
                                                       &kRestCurvature,
                                                       &kBendTwistCoupling,
                                                       &kClampCompliance,
                                                       &kClampDamping,
                                                       &kClampFriction,
                                                       &kClampPlay,
                                                       &kAirDrag,
                                                       &kExternalDamping,
                                                       &kAddedMass,
                                                       &kContact,
                                                       &kDrift,
                                                       &kClock,
                                                       &kSensor,
                                                       &kBaseMotion};
  return kinds;
}

const EffectKind& effectKind(const std::string& name) {
  std::string known;
  for (const EffectKind* kind : effectKinds()) {
    if (name == kind->name) return *kind;
    known += std::string(known.empty() ? "" : ", ") + kind->name;
  }
  throw std::invalid_argument("unknown effect " + name + "; there are none, " + known);
}

std::vector<EffectChoice> chooseEffects(const std::vector<std::string>& names, double size,
                                        const EffectScale& scale) {
  std::vector<EffectChoice> choices;
  const auto choose = [&](const EffectKind& kind) {
    const auto same = [&kind](const EffectChoice& c) { return c.kind == &kind; };
    if (std::any_of(choices.begin(), choices.end(), same)) return;
    choices.push_back({&kind, size, kind.defaults(scale, size)});
  };
  for (const std::string& name : names) {
    if (name == "none") continue;
    const EffectKind& kind = effectKind(name);
    if (&kind == &kClampDamping) choose(kClampCompliance);
    choose(kind);
  }
  return choices;
}

void setEffectValue(const std::string& assignment, std::vector<EffectChoice>* choices) {
  const size_t equals = assignment.find('=');
  const std::string path = assignment.substr(0, equals);
  std::string known;
  for (EffectChoice& choice : *choices) {
    const std::string prefix = std::string(choice.kind->name) + ".";
    for (auto& [key, value] : choice.values) {
      known += " " + prefix + key;
      if (path != prefix + key && (choices->size() > 1 || path != key)) continue;
      if (equals == std::string::npos) break;
      const std::string text = assignment.substr(equals + 1);
      char* end = nullptr;
      value = std::strtod(text.c_str(), &end);
      if (text.empty() || *end != '\0') break;
      return;
    }
  }
  throw std::invalid_argument("expected KEY=NUMBER, KEY one of:" + known + "; got " + assignment);
}

std::string effectPath(const EffectKind& kind, const std::string& path) {
  return std::string(kind.path) + "." + path;
}

std::vector<std::shared_ptr<Effect>> makeEffects(const std::vector<EffectChoice>& choices,
                                                 const EffectSite& site) {
  std::vector<std::shared_ptr<Effect>> effects;
  for (const EffectChoice& choice : choices)
    effects.push_back(choice.kind->make(choice.values, site));
  return effects;
}

}  // namespace cosserat_cable::generator
