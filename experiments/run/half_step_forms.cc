#include "experiments/run/half_step_forms.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "experiments/run/half_step_table.h"
#include "experiments/run/level_crossings.h"
#include "smoothing/margins/margin_evaluator.h"
#include "smoothing/proof/sampled_feasibility.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr double kClassWidth = 0.03;  // [m] differences of height that count as one
constexpr double kWorst = 5.0;        // slacks below are as bad

class Fitting {
 public:
  Fitting(const ExperimentConfig& config, const Place& place, std::vector<LevelCrossing> crossings)
      : evaluator_(place.robot, place.scene, config.smoothing.limits),
        scratch_(evaluator_.MakeScratch()),
        crossings_(std::move(crossings)) {}

  const std::vector<LevelCrossing>& crossings() const { return crossings_; }
  double Highest() const {
    double highest = 0.0;
    for (const LevelCrossing& crossing : crossings_) {
      highest = std::max(highest, std::abs(crossing.rise()));
    }
    return highest;
  }
  void Drop(const std::function<bool(const LevelCrossing&)>& gone) {
    std::erase_if(crossings_, gone);
  }

  struct OfClass {
    double fit = 0.0;    // 1: a tenth of the crossings or more keep all; below 0: none does
    Margin missed = {};  // of the best crossing, where none does
    const LevelCrossing* of = nullptr;
  };
  // By class of difference of height. Where none keeps all, Nearest() tells how near one comes.
  std::map<int, OfClass> Fit(const HalfStepConfig& form) {
    std::map<int, int> all, kept;
    for (const LevelCrossing& crossing : crossings_) ++all[ClassOf(crossing)];
    std::map<int, OfClass> fits;
    for (const LevelCrossing& crossing : crossings_) {
      const int key = ClassOf(crossing);
      double& fit = fits[key].fit;
      if (fit < 1.0 && Keeps(form, crossing)) fit = std::min(1.0, 10.0 * ++kept[key] / all[key]);
    }
    return fits;
  }
  // How near the best of the first crossings of a class is to keeping all; `of` is null where the
  // foot does not rise to the other level.
  OfClass Nearest(const HalfStepConfig& form, int key) {
    constexpr int kLooked = 16;
    OfClass best{.fit = -kWorst};
    int looked = 0;
    for (const LevelCrossing& crossing : crossings_) {
      if (ClassOf(crossing) != key || looked == kLooked) continue;
      ++looked;
      if (!Rises(form, crossing)) continue;
      const auto [slack, margin] = SlackOf(form, crossing);
      if (best.of == nullptr || slack > best.fit) best = {slack, margin, &crossing};
    }
    return best;
  }
  static int ClassOf(const LevelCrossing& crossing) {
    return static_cast<int>(std::lround(crossing.rise() / kClassWidth));
  }
  std::string Describe(const Margin& margin) const { return evaluator_.Describe(margin); }

 private:
  // Calls visit(walk, t) at instants of the half-steps down to the landing and up from it, until it
  // says stop. A step in place moves down as it moves up, in reverse.
  void Visit(const HalfStepConfig& form, const LevelCrossing& crossing,
             const std::function<bool(const SuperposedWalk&, const LocalTime&)>& goes_on) {
    std::array<Foothold, 2> feet;
    Nth(feet, Index(crossing.support)) = crossing.X_WS;
    Nth(feet, Index(Opposite(crossing.support))) = crossing.X_WF;
    const HalfStepShape shape = ShapeOf(form);
    const auto model = MotionModelOf(evaluator_.robot(), shape);
    for (const Side swing : {crossing.support, Opposite(crossing.support)}) {
      const HalfStepSequence sequence = MakeSequence(feet,
                                                     {{.side = swing,
                                                       .X_WF = Nth(feet, Index(swing)),
                                                       .via_height = form.via_height,
                                                       .duration = form.duration}},
                                                     form.via_lateral, shape, model);
      const SuperposedWalk walk(sequence, PlannedMotion(sequence));
      constexpr int kInstants = 10;
      for (int k = 0; k <= kInstants; ++k) {
        if (!goes_on(walk, walk.Locate(form.duration * k / kInstants))) return;
      }
    }
  }

  static bool Rises(const HalfStepConfig& form, const LevelCrossing& crossing) {
    return std::abs(crossing.rise()) < form.via_height;
  }

  bool Keeps(const HalfStepConfig& form, const LevelCrossing& crossing) {
    bool keeps = Rises(form, crossing);
    if (!keeps) return false;
    Visit(form, crossing, [&](const SuperposedWalk& walk, const LocalTime& at) {
      keeps = !evaluator_.FirstViolation(walk, at, &scratch_);
      return keeps;
    });
    return keeps;
  }

  // The least slack of a crossing, and its margin.
  std::pair<double, Margin> SlackOf(const HalfStepConfig& form, const LevelCrossing& crossing) {
    std::pair<double, Margin> least = {1.0, {}};
    Visit(form, crossing, [&](const SuperposedWalk& walk, const LocalTime& at) {
      const MarginSet margins = evaluator_.At(walk, at, &scratch_);
      const Margin& worst = WorstOf(margins, evaluator_.limits());
      const double slack = std::max(-kWorst, evaluator_.limits().Slack(worst));
      if (slack < least.first) least = {slack, worst};
      return true;
    });
    return least;
  }

  MarginEvaluator evaluator_;
  MarginEvaluator::Scratch scratch_;
  std::vector<LevelCrossing> crossings_;
};

struct Fitted {
  HalfStepConfig form;
  std::map<int, Fitting::OfClass> classes;
  double score() const {
    double sum = 0.0;
    for (const auto& [key, of] : classes) sum += of.fit;
    return sum;
  }
  bool best() const {
    return std::ranges::all_of(classes, [](const auto& fit) { return fit.second.fit >= 1.0; });
  }
};

// Whether a form crosses about all that any of them does.
bool CrossesAll(const Fitted& fitted, const std::vector<Fitted>& all) {
  return std::ranges::all_of(fitted.classes, [&](const auto& fit) {
    return std::ranges::none_of(all, [&](const Fitted& other) {
      return other.classes.at(fit.first).fit > 0.0 &&
             fit.second.fit < 0.5 * other.classes.at(fit.first).fit;
    });
  });
}

// The forms of a table as far as they have to be looked at: when so many fit as well as can be,
// others do not come before them.
std::vector<Fitted> FitTable(const std::vector<HalfStepConfig>& table, int wanted,
                             Fitting* fitting) {
  std::vector<Fitted> all;
  for (const HalfStepConfig& form : table) {
    all.push_back({form, fitting->Fit(form)});
    if (std::ranges::count_if(all, &Fitted::best) >= wanted) break;
  }
  return all;
}

// What no crossing keeps is looked at closer. Gives the classes that are hopeless, from the
// highest, and a sentence about each.
std::vector<int> Hopeless(std::vector<Fitted>* all, Fitting* fitting,
                          std::vector<std::string>* too_high) {
  constexpr double kHopeless = -0.5;  // slack of the best crossing
  std::vector<int> hopeless;
  for (const auto& [key, own] : all->front().classes) {
    if (std::ranges::any_of(*all,
                            [k = key](const Fitted& f) { return f.classes.at(k).fit > 0.0; })) {
      continue;
    }
    Fitting::OfClass best{.fit = -kWorst};
    for (Fitted& fitted : *all) {
      Fitting::OfClass& of = fitted.classes[key];
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
  Fitting fitting(config, place, DrawLevelCrossings(config, place));
  HalfStepForms found;
  std::vector<Fitted> all;
  while (!fitting.crossings().empty()) {
    all = FitTable(HalfStepTable(config.half_step, fitting.Highest(), SizeOf(place.robot)), wanted,
                   &fitting);
    // What is hopeless is left out, and the rest looked at anew with a lower via point.
    const std::vector<int> hopeless = Hopeless(&all, &fitting, &found.too_high);
    if (hopeless.empty()) break;
    fitting.Drop([&](const LevelCrossing& crossing) {
      return std::ranges::find(hopeless, Fitting::ClassOf(crossing)) != hopeless.end();
    });
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

}  // namespace halfstep
