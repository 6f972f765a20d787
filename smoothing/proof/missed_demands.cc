#include "smoothing/proof/missed_demands.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "smoothing/margins/instant.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr double kPeriod = 0.02;    // [s] between instants, at most
constexpr int kMostInstants = 300;  // unless they are more than these
// The same of instants at which only what was not seen before is told [s].
constexpr double kClosePeriod = 0.005;
constexpr int kMostCloseInstants = 20000;  // 100 s
constexpr size_t kRefined = 10;  // of the worst demands, whose instants are looked at more closely
constexpr int kCloser = 8;       // instants between two, for that
constexpr int kRounds = 2;
// Slacks that differ by no more are the same but for rounding. A foot that stands has the same
// margin at every instant, but what it is computed from (the pose of the waist, the angles of the
// leg) is not, and rounds to 1e-12 m or rad at most (MarginStatements::kRounding), which is 1e-10
// of the smallest scale. Nobody blames a step for a billionth of a clear change.
constexpr double kSameSlack = 1e-9;
// The least slacks of two demands that differ by no more are equally bad: they are found by looking
// at instants, which tells the least of a smooth curve to some 1e-5 of a scale.
constexpr double kEquallyBad = 1e-3;

bool SameDemand(const Margin& a, const Margin& b) {
  return a.family == b.family && a.subject == b.subject && a.other == b.other &&
         a.stop_after == b.stop_after;
}

// The latest step that has put `side` on the floor at `at`, where it stands; −1: it has not moved.
int StepThatPlaced(const SuperposedWalk& walk, const LocalTime& at, Side side) {
  const double t = walk.Absolute(at);
  int placed = -1;
  for (int step = 0; 2 * step + 1 < walk.num_half_steps(); ++step) {
    if (walk.half_step(2 * step).swing() != side) continue;
    if (walk.start_of(2 * step + 1) > t) break;
    placed = step;
  }
  return placed;
}

class Survey {
 public:
  Survey(const MarginEvaluator& evaluator, const SuperposedWalk& walk)
      : evaluator_(evaluator), walk_(walk), scratch_(evaluator.MakeScratch()) {}

  MissedDemands Run(const Margin& witness) {
    std::vector<MissedDemand>& demands = found_.demands;
    const int n = InstantsOf(kPeriod, kMostInstants);
    const double period = walk_.duration() / n;
    for (int i = 0; i <= n; ++i) {
      ++found_.instants;
      for (const Margin& margin : At(i * period)) ++Note(margin)->instants;
    }
    LookClosely();
    if (Find(witness) == demands.end()) demands.push_back({.worst = witness});
    Sort();
    for (size_t k = 0; k < std::min(kRefined, demands.size()); ++k) {
      if (!std::isfinite(demands[k].worst.value)) continue;
      Refine(demands[k].instants > 0 ? period : kClosePeriod, &demands[k]);
    }
    Sort();
    for (MissedDemand& demand : demands) Blame(&demand);
    return std::move(found_);
  }

 private:
  int InstantsOf(double period, int most) const {
    return std::clamp(static_cast<int>(std::ceil(walk_.duration() / period)), 1, most);
  }
  std::vector<Margin> At(double t) {
    const LocalTime at = walk_.Locate(t);
    return evaluator_.Violations(walk_, at, &scratch_);
  }
  // What could not be decided is nearly missed; what cannot be told, because something else is
  // missed, such as reach, comes last.
  double Slack(const Margin& margin) const {
    const double slack = evaluator_.limits().Slack(margin);
    return std::isnan(slack) ? 0.0 : std::isinf(slack) ? kUnlimited : slack;
  }
  // Whether a demand is missed worse by `a`, or as much but earlier.
  bool IsWorse(const Margin& a, const Margin& b) const {
    const double slack_a = Slack(a), slack_b = Slack(b);
    if (slack_a == slack_b || std::abs(slack_a - slack_b) <= kSameSlack) return a.t < b.t;
    return slack_a < slack_b;
  }
  std::vector<MissedDemand>::iterator Find(const Margin& margin) {
    return std::ranges::find_if(found_.demands,
                                [&](const MissedDemand& d) { return SameDemand(d.worst, margin); });
  }
  std::vector<MissedDemand>::iterator Note(const Margin& margin) {
    auto known = Find(margin);
    if (known == found_.demands.end()) known = found_.demands.insert(known, {.worst = margin});
    if (IsWorse(margin, known->worst)) known->worst = margin;
    return known;
  }
  // What is missed for a moment, at the instants of trajectory.csv.
  void LookClosely() {
    const int n = InstantsOf(kClosePeriod, kMostCloseInstants);
    const double period = std::max(kClosePeriod, walk_.duration() / n);
    for (int i = 0; i <= n; ++i) {
      const LocalTime at = walk_.Locate(std::min(walk_.duration(), i * period));
      Instant instant(evaluator_.place(), evaluator_.limits(), walk_, at, &scratch_);
      for (const MarginFamily family : evaluator_.families_by_cost()) NoteNews(family, &instant);
    }
  }
  // Distances are only compared with what is demanded, which is quick, unless there is news.
  void NoteNews(MarginFamily family, Instant* instant) {
    const MarginStatements& statements = evaluator_.statements(family);
    const double demanded = evaluator_.limits().demanded_of(family);
    std::optional<Margin> first = statements.FirstBelow(instant, demanded);
    if (!first || std::isinf(first->value)) return;  // −∞: because a leg does not reach
    first->at = instant->at();
    first->t = instant->t();
    const auto known = Find(*first);
    if (known != found_.demands.end() && !IsWorse(*first, known->worst)) return;
    std::vector<Margin> below;
    statements.AddBelow(instant, demanded, &below);
    for (Margin& margin : below) {
      margin.at = instant->at();
      margin.t = instant->t();
      Note(margin);
    }
  }
  // Where a leg does not reach there is no motion, and what else is missed around that, by joints
  // that turn too fast and all that they throw about, follows from it.
  static bool DoesNotReach(const Margin& margin) {
    return margin.family == MarginFamily::kReach && margin.value < 0.0;
  }
  // Legs that do not reach first, then by slack; those that are equally bad by time.
  void Sort() {
    std::vector<MissedDemand>& demands = found_.demands;
    std::ranges::stable_sort(demands, {}, [this](const MissedDemand& d) {
      return std::pair(!DoesNotReach(d.worst), Slack(d.worst));
    });
    for (auto begin = demands.begin(); begin != demands.end();) {
      auto end = begin + 1;
      while (end != demands.end() && EquallyBad((end - 1)->worst, end->worst)) ++end;
      std::stable_sort(begin, end, [](const MissedDemand& a, const MissedDemand& b) {
        return a.worst.t < b.worst.t;
      });
      begin = end;
    }
  }
  bool EquallyBad(const Margin& a, const Margin& b) const {
    if (DoesNotReach(a) != DoesNotReach(b)) return false;
    return Slack(a) == Slack(b) || std::abs(Slack(a) - Slack(b)) <= kEquallyBad;
  }
  void Refine(double period, MissedDemand* demand) {
    for (int round = 0; round < kRounds; ++round) {
      const double middle = demand->worst.t;
      for (int i = -kCloser; i <= kCloser; ++i) {
        const double t = middle + i * period / kCloser;
        if (t < 0.0 || t > walk_.duration()) continue;
        for (const Margin& margin : At(t)) {
          if (SameDemand(margin, demand->worst) && IsWorse(margin, demand->worst)) {
            demand->worst = margin;
          }
        }
      }
      period /= kCloser;
    }
  }

  // The feet that a margin is about where they stand; none: it is about how something moves.
  std::vector<Side> StandingFeet(const Margin& margin) const {
    std::vector<Side> feet = evaluator_.statements(margin.family).PlacedFeet(margin);
    const auto in_air = [&](Side side) { return walk_.InAir(margin.at, side); };
    if (std::ranges::any_of(feet, in_air)) feet.clear();
    return feet;
  }
  void Blame(MissedDemand* demand) const {
    demand->footstep = demand->worst.at.half_step / 2;
    if (demand->worst.stop_after >= 0) return;
    const std::vector<Side> feet = StandingFeet(demand->worst);
    demand->stands = !feet.empty();
    if (demand->stands) demand->footstep = -1;
    for (const Side side : feet) {
      const int step = StepThatPlaced(walk_, demand->worst.at, side);
      demand->footstep = std::max(demand->footstep, step);
    }
  }

  const MarginEvaluator& evaluator_;
  const SuperposedWalk& walk_;
  MarginEvaluator::Scratch scratch_;
  MissedDemands found_;
};

}  // namespace

MissedDemands FindMissedDemands(const MarginEvaluator& evaluator, const SuperposedWalk& walk,
                                const Margin& witness) {
  return Survey(evaluator, walk).Run(witness);
}

}  // namespace halfstep
