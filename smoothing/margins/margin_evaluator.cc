#include "smoothing/margins/margin_evaluator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "smoothing/margins/demandable.h"
#include "smoothing/margins/family_class.h"
#include "wpg/check.h"
#include "wpg/files/plain_locale.h"
#include "wpg/nth.h"

namespace halfstep {

MarginEvaluator::Shared::Shared(RobotModel robot, Scene scene, OwnMargins own)
    : place(std::move(robot), std::move(scene), std::move(own)) {
  for (const MarginFamily family : AllMarginFamilies()) {
    Nth(statements, family) = ClassOf(family).make(place);
  }
}

MarginEvaluator::MarginEvaluator(RobotModel robot, Scene scene, MarginLimits limits)
    : shared_(std::make_shared<const Shared>(std::move(robot), std::move(scene), limits.own)) {
  SetLimits(limits);
}

void MarginEvaluator::SetLimits(const MarginLimits& limits) {
  HALFSTEP_CHECK(limits.tube == Tube{} || scene().ground->OnlyLevel(),
                 "a tube on ground of " << scene().ground->Levels().size() << " levels");
  limits_ = Demandable(limits, robot());
  limits_.own = place().own;
  families_.clear();
  for (const MarginFamily family : AllMarginFamilies()) {
    if (statements(family).present(limits_)) families_.push_back(family);
  }
  by_cost_ = families_;
  std::ranges::stable_sort(by_cost_, {}, [](MarginFamily f) { return Traits(f).cost; });
}

MarginEvaluator MarginEvaluator::WithLimits(const MarginLimits& limits) const {
  MarginEvaluator other = *this;
  other.SetLimits(limits);
  return other;
}

MarginSet MarginEvaluator::At(const SuperposedWalk& walk, const LocalTime& at,
                              Scratch* scratch) const {
  ++scratch->work.instants;
  Instant instant(place(), limits_, walk, at, scratch);
  MarginSet margins;
  for (const MarginFamily family : AllMarginFamilies()) {
    Margin& margin = Nth(margins, family);
    margin.family = family;
    if (statements(family).present(limits_)) {
      margin = statements(family).Least(&instant, kUnlimited);
    }
    margin.at = at;
    margin.t = instant.t();
  }
  return margins;
}

std::optional<Margin> MarginEvaluator::FirstViolation(const SuperposedWalk& walk,
                                                      const LocalTime& at, Scratch* scratch) const {
  ++scratch->work.instants;
  Instant instant(place(), limits_, walk, at, scratch);
  for (const MarginFamily family : families_by_cost()) {
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
  ++scratch->work.instants;
  Instant instant(place(), limits_, walk, at, scratch);
  std::vector<Margin> below;
  for (const MarginFamily family : families_by_cost()) {
    statements(family).AddBelow(&instant, limits_.demanded_of(family), &below);
  }
  // Of all families, `reach` is the one that says why the others cannot be told.
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
    out << Traits(margin.family).untold.at_instant;
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
