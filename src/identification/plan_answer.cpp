#include "plan_answer.h"

#include <algorithm>
#include <cmath>

#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

constexpr std::size_t kShown = 5;

std::string Sentence(const PlanCandidate& candidate) {
  std::string text = std::to_string(candidate.repeats) +
                     (candidate.repeats == 1 ? " record" : " records") + " like '" +
                     candidate.like + "' at ";
  for (std::size_t k = 0; k < candidate.lengths.size(); ++k)
    text += (k > 0 ? " and " : "") + FormatRounded(candidate.lengths[k]) + " m";
  if (candidate.lengths.size() > 1) text += " each";
  if (candidate.inertia > 0) text += ", disc " + FormatRounded(candidate.inertia) + " kg m^2";
  return text;
}

std::string Percent(double x) {
  return std::isfinite(x) ? "+-" + FormatRounded(100 * x, 2) + " %" : "undetermined";
}

}  // namespace

nlohmann::json PlanJson(const Plan& plan) {
  nlohmann::json json = {{"target", {{"parameter", plan.target}, {"accuracy", plan.accuracy}}},
                         {"candidates", nlohmann::json::array()},
                         {"recommended", nullptr}};
  if (std::isfinite(plan.half_width_now)) json["half_width_now"] = plan.half_width_now;
  if (!plan.message.empty()) json["message"] = plan.message;
  for (const PlanCandidate& candidate : plan.candidates)
    json["candidates"].push_back({{"text", Sentence(candidate)},
                                  {"like", candidate.like},
                                  {"lengths", candidate.lengths},
                                  {"inertia", candidate.inertia},
                                  {"repeats", candidate.repeats},
                                  {"predicted", {{plan.target, candidate.half_width}}}});
  if (plan.reached) json["recommended"] = json["candidates"].front();
  return json;
}

std::string PlanTable(const Plan& plan) {
  if (!plan.message.empty()) return "plan: " + plan.message + "\n";
  std::string text = "plan for +-" + FormatRounded(100 * plan.accuracy, 2) + " % on " +
                     plan.target + " (this set: " + Percent(plan.half_width_now) + ")\n";
  if (!plan.reached) text += "  none of those tried reaches it; nearest:\n";
  for (std::size_t k = 0; k < std::min(kShown, plan.candidates.size()); ++k)
    text +=
        "  " + Sentence(plan.candidates[k]) + ": " + Percent(plan.candidates[k].half_width) + "\n";
  return text;
}

}  // namespace cosserat_cable
