#include "smoothing/margins/margin_evaluator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "smoothing/margins/all_families.h"
#include "smoothing/margins/demandable.h"
#include "wpg/files/plain_locale.h"
#include "wpg/nth.h"

namespace halfstep {

MarginEvaluator::Shared::Shared(RobotModel robot, Scene scene)
    : place(std::move(robot), std::move(scene)), statements(AllFamilies::Make(place)) {
  for (const MarginFamily family : AllMarginFamilies()) {
    if (Nth(statements, family)->present()) families.push_back(family);
  }
}

MarginEvaluator::MarginEvaluator(RobotModel robot, Scene scene, MarginLimits limits)
    : shared_(std::make_shared<const Shared>(std::move(robot), std::move(scene))),
      limits_(Demandable(limits, this->robot())) {}

MarginEvaluator MarginEvaluator::WithLimits(const MarginLimits& limits) const {
  MarginEvaluator other = *this;
  other.limits_ = Demandable(limits, robot());
  return other;
}

MarginSet MarginEvaluator::At(const SuperposedWalk& walk, const LocalTime& at,
                              Scratch* scratch) const {
  ++scratch->instants;
  Instant instant(place(), limits_, walk, at, scratch);
  MarginSet margins;
  margins.back().family = MarginFamily::kOwn;  // where nothing is registered: without a limit
  for (const MarginFamily family : AllMarginFamilies()) {
    Margin& margin = Nth(margins, family);
    margin = statements(family).Least(&instant, std::numeric_limits<double>::infinity());
    margin.at = at;
    margin.t = instant.t();
  }
  return margins;
}

std::optional<Margin> MarginEvaluator::FirstViolation(const SuperposedWalk& walk,
                                                      const LocalTime& at, Scratch* scratch) const {
  ++scratch->instants;
  Instant instant(place(), limits_, walk, at, scratch);
  for (const MarginFamily family : FamiliesByCost()) {
    std::optional<Margin> below =
        statements(family).FirstBelow(&instant, limits_.demanded_of(family));
    if (!below) continue;
    below->at = at;
    below->t = instant.t();
    return below;
  }
  return std::nullopt;
}

std::vector<Margin> MarginEvaluator::Violations(const SuperposedWalk& walk, const LocalTime& at,
                                                Scratch* scratch) const {
  ++scratch->instants;
  Instant instant(place(), limits_, walk, at, scratch);
  std::vector<Margin> below;
  for (const MarginFamily family : FamiliesByCost()) {
    statements(family).AddBelow(&instant, limits_.demanded_of(family), &below);
  }
  bool told = std::ranges::any_of(
      below, [](const Margin& margin) { return margin.family == MarginFamily::kReach; });
  std::erase_if(below, [&told](const Margin& margin) {
    if (!std::isinf(margin.value)) return false;
    return std::exchange(told, true);
  });
  for (Margin& margin : below) {
    margin.at = at;
    margin.t = instant.t();
  }
  return below;
}

std::string MarginEvaluator::Describe(const Margin& margin) const {
  PlainStream out;
  out.precision(6);
  out << Name(margin.family) << " of " << Subject(margin);
  if (std::isnan(margin.value)) {
    out << " could not be decided";
  } else if (std::isinf(margin.value) && margin.value < 0.0) {
    out << (margin.family == MarginFamily::kFriction || margin.family == MarginFamily::kZmpRobot
                ? " cannot be told, since the soles cannot give what the motion needs or a leg "
                  "does "
                  "not reach,"
                : " cannot be told, since a leg does not reach or is stretched,");
  } else {
    out << " " << margin.value << " " << Unit(margin.family) << " (demanded "
        << limits_.demanded_of(margin.family) << ")";
  }
  out << " at half-step " << margin.at.half_step + 1 << ", tau = " << margin.at.tau << " s";
  if (margin.stop_after >= 0) {
    out << ", if the walk is stopped after half-step " << margin.stop_after + 1;
  }
  return out.str();
}

}  // namespace halfstep
