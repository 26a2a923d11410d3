#include "variation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace cosserat_cable::generator {
namespace {

const double kPi = std::acos(-1.0);

/// Turns the vector of the values at these paths to an angle, its length kept.
void turn(double angle, const std::string& x, const std::string& y, EffectValues* v) {
  const double size = std::hypot((*v)[x], (*v)[y]);
  (*v)[x] = size * std::cos(angle);
  (*v)[y] = size * std::sin(angle);
}

using Change = std::function<void(EffectValues*)>;

Change factor(const std::string& path, double value) {
  return [path, value](EffectValues* v) { (*v)[path] *= value; };
}

Change drift(Random* random) {
  // Warmer: softer, and either way in damping.
  const bool stiffness = random->chance(0.7), damping = !stiffness || random->chance(0.5);
  const double sign = random->chance(0.7) ? 1.0 : -1.0, loss = random->chance(0.5) ? 1.0 : -0.5;
  return [=](EffectValues* v) {
    for (const char* path : {"EI", "GJ"}) (*v)[path] *= stiffness ? sign : 0.0;
    for (const char* path : {"eta_EI", "eta_GJ"}) {
      (*v)[path] = damping ? std::max(-0.8, (*v)[path] * loss) : 0.0;
    }
  };
}

Change clock(const std::string& form, Random* random) {
  const double drawn = random->uniform(0.0, 3.0);
  const double what = form == "delay"   ? 0.5
                      : form == "scale" ? 2.5
                                        : drawn,
               sign = random->chance(0.5) ? 1.0 : -1.0;
  return [=](EffectValues* v) {
    (*v)["scale"] *= what < 1.0 ? 0.0 : sign;
    (*v)["delay"] *= what > 2.0 ? 0.0 : 1.0;
  };
}

Change sensor(const std::string& form, Random* random) {
  const double drawn = random->uniform(0.0, 3.0);
  const double what = form == "scale"      ? 0.5
                      : form == "tilt"     ? 1.5
                      : form == "low_pass" ? 2.5
                                           : drawn,
               sign = random->chance(0.5) ? 1.0 : -1.0;
  return [=](EffectValues* v) {
    const bool scale = what < 1.0, tilt = what >= 1.0 && what < 2.0;
    (*v)["scale"] = scale ? 1.0 + sign * 3.0 * ((*v)["scale"] - 1.0) : 1.0;
    for (const char* path : {"tilt[0]", "tilt[1]", "tilt[2]"})
      (*v)[path] *= tilt ? 2.0 * sign : 0.0;
    if (scale || tilt) (*v)["low_pass"] = 0.0;
  };
}

Change baseMotion(const EffectScale& scale, const std::string& form, Random* random) {
  const double drawn = random->uniform(0.0, 3.0);
  const double what = form == "amplitude" ? 0.5
                      : form == "tilt"    ? 2.5
                                          : drawn,
               sign = random->chance(0.5) ? 1.0 : -1.0;
  const double angle = random->uniform(-kPi, kPi);
  const double hertz = scale.frequency / (2.0 * kPi);
  return [=](EffectValues* v) {
    const double size = ((*v)["a.amplitude"] - 1.0) / 0.1;
    (*v)["a.amplitude"] = what < 1.0 ? 1.0 + sign * 0.1 * size : 1.0;
    (*v)["a.phase"] = what < 2.0 ? 0.0 : sign * 0.1 * size;
    if (what >= 1.0 && what < 2.0) {
      // The stiffer, the less it shows.
      (*v)["a.bracket.frequency"] = size == 0.0 ? 0.0 : 6.0 * hertz / std::sqrt(size);
    }
    turn(angle, "a.tilt[0]", "a.tilt[1]", v);
    if (what < 2.0) (*v)["a.tilt[0]"] = (*v)["a.tilt[1]"] = 0.0;
  };
}

Change changeOf(const EffectKind& kind, const EffectScale& scale, const std::string& form,
                Random* random) {
  const std::string name = kind.name;
  const double angle = random->uniform(-kPi, kPi);
  const double wide = random->logUniform(0.4, 2.5), narrow = random->logUniform(0.7, 1.4);
  if (name == "maxwell") return factor("tau", wide);
  if (name == "nonlinear_stiffness") {
    const double sign = random->chance(0.5) ? 1.0 : -1.0;
    return [=](EffectValues* v) {
      (*v)["change"] *= sign;
      (*v)["curvature"] *= narrow;
    };
  }
  if (name == "section_friction") {
    const double spread = random->uniform(0.2, 0.8);
    return [=](EffectValues* v) {
      (*v)["slip_curvature"] *= narrow;
      (*v)["spread"] = spread;
    };
  }
  if (name == "anisotropy") return [=](EffectValues* v) { (*v)["roll"] = angle; };
  if (name == "rest_curvature") {
    const bool twisted = random->chance(0.4);
    return [=](EffectValues* v) {
      turn(angle, "k1", "k2", v);
      if (!twisted) (*v)["twist"] = 0.0;
    };
  }
  if (name == "bend_twist_coupling") {
    return [=](EffectValues* v) { turn(angle, "c1", "c2", v); };
  }
  if (name == "clamp_friction") return factor("a.slip_moment", narrow);
  if (name == "clamp_play") return factor("a.gap", narrow);
  if (name == "added_mass") return factor("s", random->uniform(0.65, 1.15));
  if (name == "drift") return drift(random);
  if (name == "clock") return clock(form, random);
  if (name == "sensor") return sensor(form, random);
  if (name == "base_motion") return baseMotion(scale, form, random);
  return [](EffectValues*) {};
}

double largestSize(const std::string& name) {
  const std::map<std::string, double> bounds = {{"bend_twist_coupling", 3.5},
                                                {"air_drag", 3.0},
                                                {"drift", 4.0},
                                                {"contact", 1.25},
                                                {"clamp_damping", 15.0},
                                                {"rest_curvature", 15.0},
                                                {"sensor", 10.0},
                                                {"clamp_play", 8.0},
                                                {"anisotropy", 7.0},
                                                {"nonlinear_stiffness", 5.0},
                                                {"clock", 8.0},
                                                {"added_mass", 8.0}};
  const auto found = bounds.find(name);
  return found == bounds.end() ? 6.0 : found->second;
}

/// An obstacle has no size but its place: behind the swing at 0, near the rest at 1.25.
EffectValues obstacle(const EffectKind& kind, const EffectScale& scale, double size) {
  EffectValues values = kind.defaults(scale, 1.0);
  const double swing = scale.amplitude * scale.cable.length;
  values["plane.offset"] += (0.25 - std::max(0.06, 1.0 - 0.75 * size)) * swing;
  return values;
}

}  // namespace

Variation varied(const EffectKind& kind, const EffectScale& scale, const std::string& form,
                 Random* random) {
  Variation result;
  result.kind = &kind;
  result.largest = largestSize(kind.name);
  const std::string name = kind.name;
  if (name == "contact") {
    result.first = 0.6;
    result.values = [&kind, scale](double size) { return obstacle(kind, scale, size); };
    return result;
  }
  if (name == "clamp_damping" && form == "torsion") {
    // D_E alone: the disc's own loss against the world.
    result.torsional = true;
    const double D = 0.02 * scale.cable.GJ / (scale.cable.length * scale.torsion);
    result.values = [D](double size) {
      return EffectValues{
          {"a.bending", 0.0}, {"a.torsion", 0.0}, {"b.bending", 0.0}, {"b.torsion", D * size}};
    };
    return result;
  }
  const Change change = changeOf(kind, scale, form, random);
  const double seed = std::floor(random->uniform(1.0, 1e6));
  result.values = [&kind, scale, change, seed](double size) {
    EffectValues values = kind.defaults(scale, size);
    change(&values);
    if (values.count("seed") > 0) values["seed"] = seed;
    return values;
  };
  return result;
}

std::vector<EffectChoice> choicesOf(const std::vector<Variation>& variations,
                                    const std::vector<double>& sizes, const EffectScale& scale) {
  std::vector<EffectChoice> choices;
  for (size_t i = 0; i < variations.size(); ++i) {
    const Variation& v = variations[i];
    if (v.kind == &kClampDamping && !v.torsional) {
      choices.push_back({&kClampCompliance, sizes[i], kClampCompliance.defaults(scale, sizes[i])});
    }
    choices.push_back({v.kind, sizes[i], v.values(sizes[i])});
  }
  return choices;
}

}  // namespace cosserat_cable::generator
