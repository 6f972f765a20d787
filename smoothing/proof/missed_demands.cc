#include "smoothing/proof/missed_demands.h"

#include <algorithm>
#include <cmath>

namespace halfstep {
namespace {

constexpr double kPeriod = 0.02;    // [s] between instants, at most
constexpr int kMostInstants = 300;  // unless they are more than these
constexpr size_t kRefined = 10;  // of the worst demands, whose instants are looked at more closely
constexpr int kCloser = 8;       // instants between two, for that
constexpr int kRounds = 2;

bool SameDemand(const Margin& a, const Margin& b) {
  return a.family == b.family && a.subject == b.subject && a.other == b.other &&
         a.stop_after == b.stop_after;
}

class Survey {
 public:
  Survey(const MarginEvaluator& evaluator, const SuperposedWalk& walk)
      : evaluator_(evaluator), walk_(walk), scratch_(evaluator.MakeScratch()) {}

  MissedDemands Run(const Margin& witness) {
    std::vector<MissedDemand>& demands = found_.demands;
    const int n =
        std::clamp(static_cast<int>(std::ceil(walk_.duration() / kPeriod)), 1, kMostInstants);
    const double period = walk_.duration() / n;
    for (int i = 0; i <= n; ++i) {
      ++found_.instants;
      for (const Margin& margin : At(i * period)) Note(margin);
    }
    if (Find(witness) == demands.end()) demands.push_back({witness, 0});
    Sort();
    for (size_t k = 0; k < std::min(kRefined, demands.size()); ++k) {
      if (demands[k].instants > 0) Refine(period, &demands[k]);
    }
    Sort();
    return std::move(found_);
  }

 private:
  std::vector<Margin> At(double t) {
    const LocalTime at = walk_.Locate(t);
    return evaluator_.Violations(walk_, at, &scratch_);
  }
  std::vector<MissedDemand>::iterator Find(const Margin& margin) {
    return std::ranges::find_if(found_.demands,
                                [&](const MissedDemand& d) { return SameDemand(d.worst, margin); });
  }
  void Note(const Margin& margin) {
    auto known = Find(margin);
    if (known == found_.demands.end()) {
      known = found_.demands.insert(known, {margin, 0});
    }
    ++known->instants;
    if (margin.value < known->worst.value) known->worst = margin;
  }
  void Sort() {
    std::ranges::stable_sort(found_.demands, {}, [this](const MissedDemand& demand) {
      const double slack = evaluator_.limits().Slack(demand.worst);
      return std::isnan(slack) ? 0.0 : slack;
    });
  }
  void Refine(double period, MissedDemand* demand) {
    for (int round = 0; round < kRounds; ++round) {
      const double middle = demand->worst.t;
      for (int i = -kCloser; i <= kCloser; ++i) {
        const double t = middle + i * period / kCloser;
        if (t < 0.0 || t > walk_.duration()) continue;
        for (const Margin& margin : At(t)) {
          if (SameDemand(margin, demand->worst) && margin.value < demand->worst.value) {
            demand->worst = margin;
          }
        }
      }
      period /= kCloser;
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
