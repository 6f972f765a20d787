#include "experiments/run/half_step_forms.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <random>

#include "experiments/run/ground_steps.h"
#include "experiments/run/sole_heights.h"
#include "planner/search/plan_shortcut.h"
#include "smoothing/margins/margin_evaluator.h"
#include "smoothing/proof/sampled_feasibility.h"
#include "wpg/elementary.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep {
namespace {

constexpr double kHrp2Leg = 0.705;    // [m] lengths of the table are HRP-2's
constexpr double kMostRise = 0.4;     // of the leg: no humanoid's step is higher
constexpr double kClassWidth = 0.03;  // [m] differences of height that count as one

// A foot that stands, and where the other one lands, on another level.
struct Crossing {
  Side support;
  Foothold X_WS, X_WF;
  double rise() const { return X_WF.height - X_WS.height; }
};

Eigen::AlignedBox2d AreaOf(const ExperimentConfig& config, const Place& place) {
  if (const auto& w = config.planner.workspace; !w.empty()) {
    return {Eigen::Vector2d(w[0], w[1]), Eigen::Vector2d(w[2], w[3])};
  }
  Eigen::AlignedBox2d box(config.goal.X_WG.position());
  for (const Foothold& sole : StartOf(config, place.robot, *place.scene.ground)) {
    box.extend(sole.Planar().position());
  }
  const Eigen::Vector2d room = Eigen::Vector2d::Constant(0.5);
  return {box.min() - room, box.max() + room};
}

std::vector<Crossing> Draw(const ExperimentConfig& config, const Place& place, double leg) {
  constexpr int kWanted = 96, kTries = 4000, kLandings = 24;
  const SoleHeights heights(place.robot, place.scene,
                            config.smoothing.limits.demanded_of(MarginFamily::kFoothold));
  const std::vector<Foothold> landings = PlacesOf(config.step_set);
  const Eigen::AlignedBox2d area = AreaOf(config, place);
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> edges;
  for (const GroundSolid& solid : place.scene.ground->Solids()) {
    for (Eigen::Index i = 0; solid.bears && i < solid.polygon.cols(); ++i) {
      const Eigen::Vector2d a = solid.polygon.col(i),
                            b = solid.polygon.col((i + 1) % solid.polygon.cols());
      if (area.intersects(Eigen::AlignedBox2d(a.cwiseMin(b), a.cwiseMax(b)))) {
        edges.emplace_back(a, b);
      }
    }
  }
  std::vector<Crossing> crossings;
  if (edges.empty() || landings.empty()) return crossings;
  std::mt19937_64 random(static_cast<std::uint64_t>(config.seed));
  const double farthest = 0.5 * leg;
  for (int k = 0; k < kTries && std::ssize(crossings) < kWanted; ++k) {
    const auto& [a, b] = Nth(edges, Pick(static_cast<int>(edges.size()), random));
    const Eigen::Vector2d normal = Eigen::Vector2d(b.y() - a.y(), a.x() - b.x()).normalized();
    const Eigen::Vector2d at =
        a + Uniform(0.0, 1.0, random) * (b - a) + Uniform(-farthest, farthest, random) * normal;
    const double yaw =
        Atan2(normal.y(), normal.x()) + (Pick(2, random) == 0 ? 0.0 : std::numbers::pi);
    const Side support = Pick(2, random) == 0 ? Side::kLeft : Side::kRight;
    const Pose2 X_WS{at.x(), at.y(), yaw};
    constexpr double kAny = std::numeric_limits<double>::infinity();
    const double height = heights.At(X_WS, 0.0, kAny);
    if (std::isnan(height) || !area.contains(at)) continue;
    for (int n = 0; n < kLandings; ++n) {
      const Foothold& X_SF = Nth(landings, Pick(static_cast<int>(landings.size()), random));
      const Pose2 X_WF = X_WS * (support == Side::kLeft ? X_SF : X_SF.Mirrored()).Planar();
      const double landing = heights.At(X_WF, height, kMostRise * leg);
      if (std::isnan(landing) || landing == height) continue;
      crossings.push_back({support, {X_WS, height}, {X_WF, landing}});
      break;
    }
  }
  return crossings;
}

// The table, for crossings of at most this height.
std::vector<HalfStepConfig> Table(const HalfStepConfig& own, double highest, double scale) {
  std::vector<HalfStepConfig> table = {own};
  const auto add = [&](double longer, double above, double crouch, double delay, double lift,
                       double begin, double end) {
    HalfStepConfig form = own;
    form.duration = std::min(6.0, own.duration * longer);
    form.zmp_shift = own.zmp_shift * form.duration / own.duration;
    // In millimetres and steps of 0.1 s, as one writes them.
    form.duration = std::round(10.0 * form.duration) / 10.0;
    form.via_height = std::ceil(1e3 * (highest + above * scale) - 1e-6) / 1e3;
    form.crouch = std::max(own.crouch, std::round(1e3 * crouch * scale) / 1e3);
    form.foot_delay = delay;
    form.lift_share = lift;
    form.rise_begin = begin;
    form.rise_end = end;
    table.push_back(form);
  };
  for (const double longer : {1.0, 1.3}) {
    for (const double crouch : {0.01, 0.02}) {
      for (const double above : {0.02, 0.05}) add(longer, above, crouch, 0.15, 0.6, 0.525, 0.85);
      add(longer * (longer > 1.0 ? 1.0 : 1.2), 0.02, crouch, 0.19, 1.0, 0.525, 1.0);
    }
  }
  for (const double crouch : {0.0, 0.01}) {
    for (const double begin : {0.46, 0.5}) add(1.3, 0.02, crouch, 0.15, 0.6, begin, 0.85);
  }
  return table;
}

constexpr double kWorst = 5.0;  // slacks below are as bad

class Fitting {
 public:
  Fitting(const ExperimentConfig& config, const Place& place, std::vector<Crossing> crossings)
      : config_(config),
        evaluator_(place.robot, place.scene, config.smoothing.limits),
        scratch_(evaluator_.MakeScratch()),
        crossings_(std::move(crossings)) {}

  const std::vector<Crossing>& crossings() const { return crossings_; }
  double Highest() const {
    double highest = 0.0;
    for (const Crossing& crossing : crossings_) {
      highest = std::max(highest, std::abs(crossing.rise()));
    }
    return highest;
  }
  void Drop(const std::function<bool(const Crossing&)>& gone) { std::erase_if(crossings_, gone); }

  struct OfClass {
    double fit = 0.0;    // 1: a tenth of the crossings or more keep all; below 0: none does
    Margin missed = {};  // of the best crossing, where none does
    const Crossing* of = nullptr;
  };
  // By class of difference of height. Where none keeps all, Nearest() tells how near one comes.
  std::map<int, OfClass> Fit(const HalfStepConfig& form) {
    std::map<int, std::pair<int, int>> kept;  // and all
    for (const Crossing& crossing : crossings_) {
      auto& [good, all] = kept[ClassOf(crossing)];
      ++all;
      good += Keeps(form, crossing);
    }
    std::map<int, OfClass> fits;
    for (const auto& [key, counts] : kept) {
      fits[key].fit = std::min(1.0, 10.0 * counts.first / counts.second);
    }
    return fits;
  }
  // How near the best of the first crossings of a class is to keeping all.
  OfClass Nearest(const HalfStepConfig& form, int key) {
    constexpr int kLooked = 16;
    OfClass best{.fit = -kWorst};
    int looked = 0;
    for (const Crossing& crossing : crossings_) {
      if (ClassOf(crossing) != key || looked == kLooked) continue;
      ++looked;
      const auto [slack, margin] = SlackOf(form, crossing);
      if (best.of == nullptr || slack > best.fit) best = {slack, margin, &crossing};
    }
    return best;
  }
  static int ClassOf(const Crossing& crossing) {
    return static_cast<int>(std::lround(crossing.rise() / kClassWidth));
  }
  std::string Describe(const Margin& margin) const { return evaluator_.Describe(margin); }

 private:
  // Calls visit(walk, t) at instants of the half-steps down to the landing and up from it, until it
  // says stop. A step in place moves down as it moves up, in reverse.
  void Visit(const HalfStepConfig& form, const Crossing& crossing,
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

  bool Keeps(const HalfStepConfig& form, const Crossing& crossing) {
    bool keeps = std::abs(crossing.rise()) < form.via_height;
    if (!keeps) return false;
    Visit(form, crossing, [&](const SuperposedWalk& walk, const LocalTime& at) {
      keeps = !evaluator_.FirstViolation(walk, at, &scratch_);
      return keeps;
    });
    return keeps;
  }

  // The least slack of a crossing, and its margin.
  std::pair<double, Margin> SlackOf(const HalfStepConfig& form, const Crossing& crossing) {
    std::pair<double, Margin> least = {1.0, {}};
    if (std::abs(crossing.rise()) >= form.via_height) return {-kWorst, {}};
    Visit(form, crossing, [&](const SuperposedWalk& walk, const LocalTime& at) {
      const MarginSet margins = evaluator_.At(walk, at, &scratch_);
      const Margin& worst = WorstOf(margins, evaluator_.limits());
      const double slack = std::max(-kWorst, evaluator_.limits().Slack(worst));
      if (slack < least.first) least = {slack, worst};
      return true;
    });
    return least;
  }

  const ExperimentConfig& config_;
  MarginEvaluator evaluator_;
  MarginEvaluator::Scratch scratch_;
  std::vector<Crossing> crossings_;
};

struct Fitted {
  HalfStepConfig form;
  std::map<int, Fitting::OfClass> classes;
  double score() const {
    double sum = 0.0;
    for (const auto& [key, of] : classes) sum += of.fit;
    return sum;
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

}  // namespace

HalfStepForms FormsFor(const ExperimentConfig& config, const Place& place) {
  constexpr size_t kForms = 3;
  constexpr double kHopeless = -0.5;  // slack of the best crossing
  const double leg = LegLengthOf(place.robot);
  Fitting fitting(config, place, Draw(config, place, leg));
  HalfStepForms found;
  std::vector<Fitted> all;
  while (!fitting.crossings().empty()) {
    all.clear();
    const double highest = fitting.Highest();
    for (const HalfStepConfig& form : Table(config.half_step, highest, leg / kHrp2Leg)) {
      all.push_back({form, fitting.Fit(form)});
    }
    // What no crossing keeps is looked at closer. What is hopeless is left out, from the highest,
    // and the rest looked at anew with a lower via point.
    std::vector<int> hopeless;
    for (const auto& [key, own] : all.front().classes) {
      if (std::ranges::any_of(all,
                              [k = key](const Fitted& f) { return f.classes.at(k).fit > 0.0; })) {
        continue;
      }
      Fitting::OfClass best{.fit = -kWorst};
      for (Fitted& fitted : all) {
        Fitting::OfClass& of = fitted.classes[key];
        of = fitting.Nearest(fitted.form, key);
        if (best.of == nullptr || of.fit > best.fit) best = of;
      }
      const double rise = best.of->rise();
      if (best.fit >= kHopeless || std::abs(rise) < highest - kClassWidth) continue;
      hopeless.push_back(key);
      found.too_high.push_back(Formatted("no half-step that was tried leads %s by %.4g cm: ",
                                         rise > 0.0 ? "up" : "down", 100.0 * std::abs(rise)) +
                               fitting.Describe(best.missed));
    }
    if (hopeless.empty()) break;
    fitting.Drop([&](const Crossing& crossing) {
      return std::ranges::find(hopeless, Fitting::ClassOf(crossing)) != hopeless.end();
    });
  }
  if (fitting.crossings().empty()) {
    found.forms = {config.half_step};
    return found;
  }
  if (CrossesAll(all.front(), all)) found.forms.push_back(config.half_step);
  const bool own_first = !found.forms.empty();
  std::ranges::stable_sort(all,
                           [](const Fitted& a, const Fitted& b) { return a.score() > b.score(); });
  for (const Fitted& fitted : all) {
    if (found.forms.size() >= kForms) break;
    if (own_first && Differences(fitted.form, config.half_step).empty()) continue;
    found.forms.push_back(fitted.form);
  }
  return found;
}

std::string Differences(const HalfStepConfig& form, const HalfStepConfig& from) {
  std::string text;
  const auto add = [&](const char* key, double HalfStepConfig::*number) {
    if (form.*number == from.*number) return;
    text += (text.empty() ? "" : ", ") + std::string(key) + ": " + ShortestText(form.*number);
  };
  add("duration_s", &HalfStepConfig::duration);
  add("zmp_shift_s", &HalfStepConfig::zmp_shift);
  add("via_height_m", &HalfStepConfig::via_height);
  add("foot_delay", &HalfStepConfig::foot_delay);
  add("lift_share", &HalfStepConfig::lift_share);
  add("rise_begin", &HalfStepConfig::rise_begin);
  add("rise_end", &HalfStepConfig::rise_end);
  add("crouch_m", &HalfStepConfig::crouch);
  return text;
}

}  // namespace halfstep
