#include "experiments/run/missed_demands_text.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/run/margin_words.h"
#include "planner/scene/mesh_floor.h"
#include "smoothing/margins/family_traits.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr size_t kMost = 10;  // demands that are told, unless there are more families

std::string Demand(const MarginEvaluator& evaluator, const HalfStepSequence& sequence,
                   const MissedDemand& demand, int instants) {
  return PlaceInPlan(sequence, demand) + ": " + MissedWords(evaluator, demand.worst) +
         (demand.instants > 0 ? Formatted(" (at %d of %d instants)", demand.instants, instants)
                              : Formatted(" (only between the %d sampled instants)", instants));
}

// Of obstacles that a body touches: a mesh that brings its floor along.
std::string FloorHint(const MarginEvaluator& evaluator, const MissedDemands& missed) {
  constexpr double kFootprint = 0.01;  // [m²]: less is no floor to stand on
  for (const MissedDemand& demand : missed.demands) {
    const Margin& worst = demand.worst;
    if (worst.family != MarginFamily::kClearance || worst.other < 0) continue;
    const Obstacle* obstacle = evaluator.scene().ObstacleAt(worst.other);
    if (obstacle == nullptr) continue;
    const auto* mesh = std::get_if<TriangleMesh>(&obstacle->shape);
    if (mesh == nullptr || mesh->hollow) continue;
    const double floor = evaluator.scene().ground->Floor();
    const double area = FloorArea(*mesh, obstacle->X_WO, floor, kFloorTolerance);
    if (area < kFootprint) continue;
    return Formatted(
        "%s has %.3g m² of floor at z = %.3g, which are in the way like all of it; if the robot is "
        "to stand on them, say `floor: in_mesh` in its `mesh`",
        obstacle->name.c_str(), area, floor);
  }
  return "";
}

std::string Remedy(const MarginEvaluator& evaluator, const MissedDemand& demand) {
  const MarginFamily family = demand.worst.family;
  const FamilyTraits& traits = Traits(family);
  std::string text =
      "what may help with " + std::string(traits.name) + ": " + std::string(traits.remedy);
  const MarginLimits& limits = evaluator.limits();
  const double spare = demand.worst.value - Nth(limits.raised, family);  // for the margin alone
  // Less demanded helps where the margin itself is kept.
  if (spare >= 0.0 && limits.demanded_of(family) > 0.0) {
    text += Formatted(", or less demanded (`smoothing.margins.%s` below %.3g)", traits.key.data(),
                      spare);
  }
  if (traits.in_tube != nullptr && limits.tube != Tube{}) {
    text += ", or a narrower `smoothing.tube`";
  }
  return text;
}

// The worst of each family, then the worst of all until there are kMost, in the order of `demands`.
std::vector<const MissedDemand*> Told(const std::vector<MissedDemand>& demands) {
  std::vector<MarginFamily> families;
  std::vector<bool> told(demands.size(), false);
  for (size_t k = 0; k < demands.size(); ++k) {
    const MarginFamily family = demands[k].worst.family;
    if (std::ranges::find(families, family) != families.end()) continue;
    families.push_back(family);
    told[k] = true;
  }
  size_t count = families.size();
  for (size_t k = 0; k < demands.size() && count < kMost; ++k) {
    if (!told[k]) ++count;
    told[k] = true;
  }
  std::vector<const MissedDemand*> chosen;
  for (size_t k = 0; k < demands.size(); ++k) {
    if (told[k]) chosen.push_back(&demands[k]);
  }
  return chosen;
}

}  // namespace

std::string PlaceInPlan(const HalfStepSequence& sequence, const MissedDemand& demand) {
  const double t = demand.worst.t;
  if (t == 0.0 || demand.footstep < 0) return "at the start";
  const std::string foot(Name(Nth(sequence.half_steps, 2 * demand.footstep).half_step.swing()));
  const std::string name = Formatted("footstep %d (%s), ", demand.footstep + 1, foot.c_str());
  if (demand.stands) return name + Formatted("where it stands, from %.2f s on", t);
  const char* kind = demand.worst.at.half_step % 2 == 0 ? "up" : "down";
  return name + Formatted("half-step %s, at %.2f s", kind, t);
}

std::vector<std::string> MissedDemandsText(const MarginEvaluator& evaluator,
                                           const HalfStepSequence& sequence,
                                           const MissedDemands& missed) {
  std::vector<std::string> lines;
  for (const MissedDemand* demand : Told(missed.demands)) {
    lines.push_back(Demand(evaluator, sequence, *demand, missed.instants));
  }
  if (missed.demands.size() > lines.size()) {
    lines.push_back(Formatted("and %zu more", missed.demands.size() - lines.size()));
  }
  for (std::string& line : FamilyRemedies(evaluator, missed)) lines.push_back(std::move(line));
  return lines;
}

std::vector<std::string> FamilyRemedies(const MarginEvaluator& evaluator,
                                        const MissedDemands& missed) {
  std::vector<std::string> remedies;
  if (std::string hint = FloorHint(evaluator, missed); !hint.empty()) remedies.push_back(hint);
  std::vector<MarginFamily> families;
  for (const MissedDemand& demand : missed.demands) {
    const MarginFamily family = demand.worst.family;
    if (std::ranges::find(families, family) != families.end()) continue;
    families.push_back(family);  // its worst demand
    remedies.push_back(Remedy(evaluator, demand));
  }
  return remedies;
}

nlohmann::ordered_json MissedDemandsJson(const MarginEvaluator& evaluator,
                                         const HalfStepSequence& sequence,
                                         const MissedDemands& missed) {
  using nlohmann::ordered_json;
  ordered_json list = ordered_json::array();
  for (const MissedDemand& demand : missed.demands) {
    const Margin& worst = demand.worst;
    list.push_back(
        {{"sentence", Demand(evaluator, sequence, demand, missed.instants)},
         {"footstep", demand.footstep + 1},
         {"half_step", worst.at.half_step + 1},
         {"t_s", worst.t},
         {"family", Name(worst.family)},
         {"subject", evaluator.Subject(worst)},
         {"margin", std::isfinite(worst.value) ? ordered_json(worst.value) : ordered_json(nullptr)},
         {"demanded", evaluator.limits().demanded_of(worst.family)},
         {"unit", Unit(worst.family)}});
  }
  return list;
}

}  // namespace halfstep
