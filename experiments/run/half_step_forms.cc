#include "experiments/run/half_step_forms.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/run/crossing_fit.h"
#include "experiments/run/half_step_table.h"
#include "experiments/run/level_crossings.h"
#include "experiments/run/obstacle_crossings.h"
#include "experiments/run/obstacle_footprint.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr double kClassWidth = 0.03;  // [m] differences of height that count as one

struct Fitted {
  HalfStepConfig form;
  std::map<int, CrossingFit::OfKind> kinds;
  double score() const {
    double sum = 0.0;
    for (const auto& [key, of] : kinds) sum += of.fit;
    return sum;
  }
  bool best() const {
    return std::ranges::all_of(kinds, [](const auto& fit) { return fit.second.fit >= 1.0; });
  }
};

// Whether a form crosses about all that any of them does.
bool CrossesAll(const Fitted& fitted, const std::vector<Fitted>& all) {
  return std::ranges::all_of(fitted.kinds, [&](const auto& fit) {
    return std::ranges::none_of(all, [&](const Fitted& other) {
      return other.kinds.at(fit.first).fit > 0.0 &&
             fit.second.fit < 0.5 * other.kinds.at(fit.first).fit;
    });
  });
}

// The forms of a table as far as they have to be looked at: when so many fit as well as can be,
// others do not come before them.
std::vector<Fitted> FitTable(const std::vector<HalfStepConfig>& table, int wanted,
                             CrossingFit* fitting) {
  std::vector<Fitted> all;
  for (const HalfStepConfig& form : table) {
    all.push_back({form, fitting->Fit(form)});
    if (std::ranges::count_if(all, &Fitted::best) >= wanted) break;
  }
  return all;
}

// What no crossing keeps is looked at closer. Gives the kinds that are hopeless, from the
// highest, and a sentence about each.
std::vector<int> Hopeless(std::vector<Fitted>* all, CrossingFit* fitting,
                          std::vector<std::string>* too_high) {
  constexpr double kHopeless = -0.5;  // slack of the best crossing
  std::vector<int> hopeless;
  for (const auto& [key, own] : all->front().kinds) {
    if (std::ranges::any_of(*all, [k = key](const Fitted& f) { return f.kinds.at(k).fit > 0.0; })) {
      continue;
    }
    CrossingFit::OfKind best;
    for (Fitted& fitted : *all) {
      CrossingFit::OfKind& of = fitted.kinds[key];
      of = fitting->Nearest(fitted.form, key);
      if (of.of != nullptr && (best.of == nullptr || of.fit > best.fit)) best = of;
    }
    const double rise = best.of->rise();
    if (best.fit >= kHopeless || std::abs(rise) < fitting->Highest() - kClassWidth) continue;
    hopeless.push_back(key);
    too_high->push_back(Formatted("no half-step that was tried leads %s by %.4g cm: ",
                                  rise > 0.0 ? "up" : "down", 100.0 * std::abs(rise)) +
                        fitting->Describe(best.missed));
  }
  return hopeless;
}

}  // namespace

HalfStepForms FormsFor(const ExperimentConfig& config, const Place& place, int wanted) {
  CrossingFit fitting(config, place.robot, place.scene, DrawLevelCrossings(config, place));
  HalfStepForms found;
  std::vector<Fitted> all;
  while (!fitting.crossings().empty()) {
    all = FitTable(HalfStepTable(config.half_step, fitting.Highest(), SizeOf(place.robot)), wanted,
                   &fitting);
    // What is hopeless is left out, and the rest looked at anew with a lower via point.
    const std::vector<int> hopeless = Hopeless(&all, &fitting, &found.too_high);
    if (hopeless.empty()) break;
    for (const int kind : hopeless) fitting.Drop(kind);
  }
  if (fitting.crossings().empty()) {
    found.forms = {config.half_step};
    return found;
  }
  found.on_levels = true;
  if (CrossesAll(all.front(), all)) found.forms.push_back(config.half_step);
  const bool own_first = !found.forms.empty();
  std::ranges::stable_sort(all,
                           [](const Fitted& a, const Fitted& b) { return a.score() > b.score(); });
  for (const Fitted& fitted : all) {
    if (std::ssize(found.forms) >= wanted) break;
    if (own_first && Differences(fitted.form, config.half_step).empty()) continue;
    found.forms.push_back(fitted.form);
  }
  return found;
}

FormOver FindFormOver(const ExperimentConfig& config, const RobotModel& robot,
                      const Obstacle& obstacle, const std::vector<Foothold>& places) {
  constexpr int kLooked = 4;  // crossings, for what is missed
  Scene alone;
  alone.obstacles = {obstacle};
  CrossingFit fitting(config, robot, alone, DrawObstacleCrossings(config, robot, obstacle, places));
  FormOver found;
  if (fitting.crossings().empty()) return found;
  std::vector<std::pair<double, HalfStepConfig>> fits;
  CrossingFit::OfKind nearest;
  for (const HalfStepConfig& form :
       TableOverObstacle(config.half_step, FootprintOf(obstacle).top, SizeOf(robot))) {
    // Longer ones have to pay.
    const double fit = fitting.Share(form) * config.half_step.duration / form.duration;
    if (fit > 0.0) fits.emplace_back(fit, form);
    if (!fits.empty()) continue;
    const CrossingFit::OfKind near = fitting.Nearest(form, 0, kLooked);
    if (nearest.of == nullptr || (near.of != nullptr && near.fit > nearest.fit)) nearest = near;
  }
  std::ranges::stable_sort(fits, [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [fit, form] : fits) {
    if (!fitting.Proves(form)) continue;
    found.form = form;
    found.landings = fitting.Landings(form);
    break;
  }
  if (!found.form && nearest.of != nullptr) found.missed = fitting.Describe(nearest.missed);
  found.effort = fitting.work().effort();
  return found;
}

}  // namespace halfstep
