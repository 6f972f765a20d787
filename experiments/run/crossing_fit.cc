#include "experiments/run/crossing_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "smoothing/proof/sampled_feasibility.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr double kWorst = 5.0;  // slacks below are as bad

bool Rises(const HalfStepConfig& form, const Crossing& crossing) {
  return std::abs(crossing.rise()) < form.via_height;
}

}  // namespace

CrossingFit::CrossingFit(const ExperimentConfig& config, const RobotModel& robot,
                         const Scene& scene, std::vector<Crossing> crossings)
    : evaluator_(robot, scene, config.smoothing.limits),
      certified_(evaluator_, config.smoothing.certification),
      scratch_(evaluator_.MakeScratch()),
      crossings_(std::move(crossings)) {}

double CrossingFit::Highest() const {
  double highest = 0.0;
  for (const Crossing& crossing : crossings_) {
    highest = std::max(highest, std::abs(crossing.rise()));
  }
  return highest;
}

void CrossingFit::Drop(int kind) {
  std::erase_if(crossings_, [kind](const Crossing& crossing) { return crossing.kind == kind; });
}

std::map<int, CrossingFit::OfKind> CrossingFit::Fit(const HalfStepConfig& form) {
  std::map<int, int> all, kept;
  for (const Crossing& crossing : crossings_) ++all[crossing.kind];
  std::map<int, OfKind> fits;
  for (const Crossing& crossing : crossings_) {
    double& fit = fits[crossing.kind].fit;
    if (fit < 1.0 && Keeps(form, crossing)) {
      fit = std::min(1.0, 10.0 * ++kept[crossing.kind] / all[crossing.kind]);
    }
  }
  return fits;
}

double CrossingFit::Share(const HalfStepConfig& form) {
  const auto kept = std::ranges::count_if(
      crossings_, [&](const Crossing& crossing) { return Keeps(form, crossing); });
  return static_cast<double>(kept) / static_cast<double>(crossings_.size());
}

CrossingFit::OfKind CrossingFit::Nearest(const HalfStepConfig& form, int kind, int looked) {
  OfKind best{.fit = -kWorst};
  for (const Crossing& crossing : crossings_) {
    if (crossing.kind != kind || looked == 0) continue;
    --looked;
    if (!Rises(form, crossing)) continue;
    const auto [slack, margin] = SlackOf(form, crossing);
    if (best.of == nullptr || slack > best.fit) best = {slack, margin, &crossing};
  }
  return best;
}

void CrossingFit::EachStep(const HalfStepConfig& form, const Crossing& crossing,
                           const std::function<bool(const SuperposedWalk&)>& goes_on) const {
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
    if (!goes_on(SuperposedWalk(sequence, PlannedMotion(sequence)))) return;
  }
}

void CrossingFit::Visit(
    const HalfStepConfig& form, const Crossing& crossing,
    const std::function<bool(const SuperposedWalk&, const LocalTime&)>& goes_on) {
  EachStep(form, crossing, [&](const SuperposedWalk& walk) {
    constexpr int kInstants = 10;
    for (int k = 0; k <= kInstants; ++k) {
      if (!goes_on(walk, walk.Locate(form.duration * k / kInstants))) return false;
    }
    return true;
  });
}

bool CrossingFit::Proves(const HalfStepConfig& form) {
  constexpr int kTried = 4;
  int tried = 0;
  for (const Crossing& crossing : crossings_) {
    if (tried == kTried) break;
    if (!Keeps(form, crossing)) continue;
    ++tried;
    bool proved = true;
    EachStep(form, crossing, [&](const SuperposedWalk& walk) {
      proved =
          certified_.Check(walk, {0.0, form.duration}, &scratch_).verdict == Verdict::kFeasible;
      return proved;
    });
    if (proved) return true;
  }
  return false;
}

std::vector<Foothold> CrossingFit::Landings(const HalfStepConfig& form) {
  constexpr double kSame = 1e-6;  // [m] and [rad]
  std::vector<Foothold> landings;
  for (const Crossing& crossing : crossings_) {
    const Foothold X_SF = crossing.X_WS.Inverse() * crossing.X_WF;
    const Foothold left = crossing.support == Side::kLeft ? X_SF : X_SF.Mirrored();
    const bool known = std::ranges::any_of(landings, [&](const Foothold& other) {
      return std::abs(other.x - left.x) < kSame && std::abs(other.y - left.y) < kSame &&
             std::abs(other.yaw - left.yaw) < kSame;
    });
    if (!known && Keeps(form, crossing)) landings.push_back(left);
  }
  return landings;
}

bool CrossingFit::Keeps(const HalfStepConfig& form, const Crossing& crossing) {
  bool keeps = Rises(form, crossing);
  if (!keeps) return false;
  Visit(form, crossing, [&](const SuperposedWalk& walk, const LocalTime& at) {
    keeps = !evaluator_.FirstViolation(walk, at, &scratch_);
    return keeps;
  });
  return keeps;
}

std::pair<double, Margin> CrossingFit::SlackOf(const HalfStepConfig& form,
                                               const Crossing& crossing) {
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

}  // namespace halfstep
