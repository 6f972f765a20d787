#include "smoothing/proof/stretch_proofs.h"

#include <algorithm>
#include <optional>

#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr size_t kMostProved = 4, kMostSuspects = 4;

template <typename T>
void PushBack(T value, size_t most, std::vector<T>* list) {
  if (list->size() == most) list->erase(list->begin());
  list->push_back(std::move(value));
}

}  // namespace

std::vector<double> StretchParameters(const SuperposedWalk& walk, int half_step) {
  const HomotopyParameters& p = walk.parameters();
  std::vector<double> key;
  for (int i = half_step; i >= 0; --i) {
    if (i < half_step && walk.end_of(i) <= walk.start_of(half_step)) break;
    for (const ParameterFamily family : AllParameterFamilies()) {
      const size_t index = static_cast<size_t>(Traits(family).index_at(i));
      const std::vector<double>& values = p.of(family);
      key.push_back(index < values.size() ? values[index] : 0.0);
    }
    // The half-step stands on the footsteps of the two steps before its own.
    for (int step = i / 2 - 1; step >= std::max(0, i / 2 - 2); --step) {
      for (const ParameterFamily family : AllParameterFamilies()) {
        if (Traits(family).move != nullptr) key.push_back(Nth(p.of(family), step));
      }
    }
  }
  return key;
}

StretchProofs::StretchProofs(const FeasibilityTest& test, int num_half_steps,
                             const StretchRange& range)
    : test_(test),
      range_(range),
      rests_(test.evaluator().scene().rests()),
      stretches_(static_cast<size_t>(num_half_steps)) {}

StretchProofs::Key StretchProofs::KeyOf(const SuperposedWalk& walk, int k) const {
  Key key = StretchParameters(walk, k);
  if (!rests_) key.push_back(walk.start_of(k));
  return key;
}

void StretchProofs::Keep(Key key, Stretch* stretch) {
  PushBack(std::move(key), kMostProved, &stretch->proved);
}

void StretchProofs::Remember(const SuperposedWalk& walk) {
  for (int k = 0; k < walk.num_half_steps(); ++k) {
    if (!range_.contains(k)) continue;
    Keep(KeyOf(walk, k), &Nth(stretches_, k));
  }
}

std::vector<Margin> StretchProofs::Refusals(const SuperposedWalk& walk,
                                            MarginEvaluator::Scratch* scratch) {
  std::vector<Margin> refusals;
  for (int k = 0; k < walk.num_half_steps(); ++k) {
    if (!range_.contains(k)) continue;
    Stretch& stretch = Nth(stretches_, k);
    Key key = KeyOf(walk, k);
    if (std::find(stretch.proved.begin(), stretch.proved.end(), key) != stretch.proved.end()) {
      continue;
    }
    std::optional<Margin> refusal;
    const double T = walk.tracks(k).duration();
    const bool last = k + 1 == walk.num_half_steps();
    const TimeSpan span{walk.start_of(k), last ? walk.duration() : walk.start_of(k + 1)};
    for (const double fraction : stretch.suspects) {
      if (walk.start_of(k) + fraction * T > span.end || refusal) continue;
      refusal = test_.evaluator().FirstViolation(walk, {k, fraction * T}, scratch);
    }
    if (!refusal) {
      const Feasibility answer = test_.Check(walk, span, scratch);
      if (answer.verdict == Verdict::kFeasible) {
        Keep(std::move(key), &stretch);
        continue;
      }
      refusal = answer.witness;
      if (refusal->at.half_step == k) {
        PushBack(refusal->at.tau / T, kMostSuspects, &stretch.suspects);
      }
    }
    refusals.push_back(*refusal);
  }
  return refusals;
}

}  // namespace halfstep
