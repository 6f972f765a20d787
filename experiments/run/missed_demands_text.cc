#include "experiments/run/missed_demands_text.h"

#include <algorithm>
#include <cmath>

#include "planner/scene/mesh_floor.h"
#include "smoothing/margins/family_traits.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

constexpr size_t kMost = 10;  // demands that are told

std::string Demand(const MarginEvaluator& evaluator, const MissedDemand& demand, int instants) {
  return evaluator.Describe(demand.worst) +
         (demand.instants > 0
              ? Formatted("; missed at %d of %d instants", demand.instants, instants)
              : Formatted("; missed for a moment between the %d instants looked at", instants));
}

// Of obstacles that a body touches: a mesh that brings its floor along.
std::string FloorHint(const MarginEvaluator& evaluator, const MissedDemands& missed) {
  constexpr double kFootprint = 0.01;  // [m²]: less is no floor to stand on
  for (const MissedDemand& demand : missed.demands) {
    const Margin& worst = demand.worst;
    if (worst.family != MarginFamily::kClearance || worst.other < 0) continue;
    const Obstacle& obstacle = evaluator.scene().obstacles[static_cast<size_t>(worst.other)];
    const auto* mesh = std::get_if<TriangleMesh>(&obstacle.shape);
    if (mesh == nullptr || mesh->hollow) continue;
    const double area = FloorArea(*mesh, obstacle.X_WO, kFloorTolerance);
    if (area < kFootprint) continue;
    return Formatted(
        "%s has %.3g m² of floor at z = 0, which are in the way like all of it; if the robot is to "
        "stand on them, say `floor: in_mesh` in its `mesh`",
        obstacle.name.c_str(), area);
  }
  return "";
}

std::string Remedy(const MarginEvaluator& evaluator, const MissedDemand& demand) {
  const MarginFamily family = demand.worst.family;
  const FamilyTraits& traits = Traits(family);
  std::string text =
      "what may help with " + std::string(traits.name) + ": " + std::string(traits.remedy);
  // Less demanded helps where the margin itself is kept.
  if (demand.worst.value >= 0.0 && evaluator.limits().demanded_of(family) > 0.0) {
    text += Formatted(", or less demanded (`smoothing.margins.%s` below %.3g)", traits.key.data(),
                      demand.worst.value);
  }
  return text;
}

}  // namespace

std::vector<std::string> MissedDemandsText(const MarginEvaluator& evaluator,
                                           const MissedDemands& missed) {
  std::vector<std::string> lines;
  std::vector<MarginFamily> told;
  std::vector<std::string> remedies;
  for (const MissedDemand& demand : missed.demands) {
    if (lines.size() < kMost) {
      lines.push_back((lines.empty() ? "" : "missed too: ") +
                      Demand(evaluator, demand, missed.instants));
    }
    const MarginFamily family = demand.worst.family;
    if (std::ranges::find(told, family) != told.end()) continue;
    told.push_back(family);  // its worst demand
    remedies.push_back(Remedy(evaluator, demand));
  }
  if (missed.demands.size() > kMost) {
    lines.push_back(Formatted("and %zu demands more", missed.demands.size() - kMost));
  }
  if (std::string hint = FloorHint(evaluator, missed); !hint.empty()) lines.push_back(hint);
  lines.insert(lines.end(), remedies.begin(), remedies.end());
  return lines;
}

}  // namespace halfstep
