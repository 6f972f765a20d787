#include "tests/benchmarks/dynamic_program.h"
#include "smoothing/walk/footstep_families.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "smoothing/proof/certified_feasibility.h"
#include "smoothing/walk/superposed_walk.h"

namespace halfstep {
namespace {

constexpr double kRounding = 1e-9;  // [s]

}  // namespace

DynamicProgram::DynamicProgram(const HalfStepSequence& sequence, const MarginEvaluator& evaluator,
                               HomotopyParameters start, double period)
    : sequence_(WithFootsteps(sequence, start)),
      evaluator_(evaluator),
      start_(std::move(start)),
      period_(period),
      scratch_(evaluator.MakeScratch()) {}

void DynamicProgram::Begin(const Choices& choices, double duration) {
  choices_ = &choices;
  duration_ = duration;
  duration_class_.clear();
  for (const auto& of_half_step : choices) {
    std::vector<int> classes;
    for (size_t c = 0; c < of_half_step.size(); ++c) {
      size_t first = 0;
      while (of_half_step[first].duration != of_half_step[c].duration) ++first;
      classes.push_back(static_cast<int>(first));
    }
    duration_class_.push_back(std::move(classes));
  }
  overlaps_.assign(choices.size(), {});
  remaining_.assign(choices.size(), 0.0);
  HomotopyParameters beside = start_;
  for (size_t k = choices.size() - 1; k > 0; --k) {
    double least = std::numeric_limits<double>::infinity();
    for (const StretchChoice& before : choices[k - 1]) {
      for (const StretchChoice& here : choices[k]) {
        beside.durations[k - 1] = before.duration;
        beside.durations[k] = here.duration;
        const double bound = NaturalOverlapBound(beside, static_cast<int>(k) - 1);
        overlaps_[k].push_back(std::clamp(here.overlap, 0.0, bound));
        least = std::min(least, here.duration - overlaps_[k].back());
      }
    }
    remaining_[k - 1] = remaining_[k] + least;
  }
  states_.assign(choices.size(), {});
  for (int c = 0; c < static_cast<int>(choices[0].size()); ++c) {
    states_[0].push_back({choice(0, c).duration, {-1, -1, -1, c}, -1});
  }
}

// The same for all combinations that have the same stretch of `half_step`, and later ones.
long DynamicProgram::Key(int half_step, const int* indices, bool with_first) const {
  long key = 0;
  for (int i = 0; i < 4; ++i) {
    const int k = half_step - 3 + i;
    int index = indices[i];
    if (i == 0) {
      // Of the oldest only its duration counts; before a down half-step it has ended.
      index = with_first && half_step % 2 == 0 && k >= 0
                  ? duration_class_[static_cast<size_t>(k)][static_cast<size_t>(index)]
                  : -1;
    }
    const long size = k < 0 ? 1 : static_cast<long>((*choices_)[static_cast<size_t>(k)].size()) + 1;
    key = key * size + (k < 0 ? 0 : index + 1);
  }
  return key;
}

double DynamicProgram::Longest(int k, const State& state, double longest) {
  // A walk of its own: the half-steps that matter, beginning with an up one and ending with a down.
  const int from = std::max(0, (k - 3) / 2 * 2), to = k % 2 == 0 ? k + 1 : k;
  HalfStepSequence part;
  part.start = sequence_.start;
  part.model = sequence_.model;
  part.half_steps.assign(sequence_.half_steps.begin() + from,
                         sequence_.half_steps.begin() + to + 1);
  HomotopyParameters parameters = PlannedMotion(part);
  for (const ParameterFamily family : AllParameterFamilies()) {
    // Overlaps are chosen, and the part stands where its footsteps are moved to.
    if (Traits(family).joins() || Traits(family).move != nullptr) continue;
    const auto first = start_.of(family).begin() + Traits(family).index_at(from);
    std::copy_n(first, parameters.of(family).size(), parameters.of(family).begin());
  }
  for (int i = std::max(0, k - 3); i <= k; ++i) {
    const int index = state.indices[i - k + 3];
    const size_t local = static_cast<size_t>(i - from);
    parameters.durations[local] = choice(i, index).duration;
    if (i % 2 == 0) parameters.height_scales[local / 2] = choice(i, index).height;
    if (i > std::max(0, k - 3)) {
      parameters.overlaps[local - 1] = Overlap(i, state.indices[i - 1 - k + 3], index);
    }
  }
  ++passes_;
  const SuperposedWalk walk(part, parameters);
  const int here = k - from;
  const double start = walk.start_of(here);
  std::vector<double> instants = {0.0};
  for (double tau = period_; tau < longest; tau += period_) instants.push_back(tau);
  for (double knot : KnotsInside(walk, {start, start + longest})) {
    instants.push_back(knot - start);
  }
  std::sort(instants.begin(), instants.end());
  for (double tau : instants) {
    if (evaluator_.FirstViolation(walk, {here, tau}, &scratch_)) return tau;
  }
  // The very end belongs to the next stretch, or is the end of the walk.
  if (k + 1 == sequence_.size() && evaluator_.FirstViolation(walk, {here, longest}, &scratch_)) {
    return longest;
  }
  return std::numeric_limits<double>::infinity();
}

void DynamicProgram::Extend(int k) {
  const std::vector<State>& here = states_[static_cast<size_t>(k)];
  std::vector<State>& next = states_[static_cast<size_t>(k) + 1];
  const int count = static_cast<int>((*choices_)[static_cast<size_t>(k) + 1].size());
  std::unordered_map<long, size_t> known;  // of the next half-step, by key
  for (size_t s = 0; s < here.size(); ++s) {
    const State& state = here[s];
    const int last = state.indices[3];
    const double T = choice(k, last).duration;
    double least = T;
    for (int c = 0; c < count; ++c) least = std::min(least, Overlap(k + 1, last, c));
    const double violated = Longest(k, state, T - least);
    for (int c = 0; c < count; ++c) {
      const double overlap = Overlap(k + 1, last, c);
      if (T - overlap > violated + kRounding || violated <= 0.0) continue;
      const double cost = state.cost + choice(k + 1, c).duration - overlap;
      if (cost + remaining_[static_cast<size_t>(k) + 1] > duration_ + kRounding) continue;
      const State candidate{
          cost, {state.indices[1], state.indices[2], last, c}, static_cast<long>(s)};
      const auto [place, is_new] =
          known.try_emplace(Key(k + 1, candidate.indices, true), next.size());
      if (is_new) {
        next.push_back(candidate);
      } else if (cost < next[place->second].cost) {
        next[place->second] = candidate;
      }
    }
  }
}

std::vector<int> DynamicProgram::End() {
  const int n = sequence_.size();
  std::vector<State>& states = states_.back();
  std::vector<size_t> order(states.size());
  for (size_t s = 0; s < order.size(); ++s) order[s] = s;
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return states[a].cost < states[b].cost; });
  for (size_t s : order) {
    const State* state = &states[s];
    if (Longest(n - 1, *state, choice(n - 1, state->indices[3]).duration) <
        std::numeric_limits<double>::infinity()) {
      continue;
    }
    std::vector<int> indices(static_cast<size_t>(n));
    for (int k = n - 1;; --k) {
      indices[static_cast<size_t>(k)] = state->indices[3];
      if (k == 0) return indices;
      state = &states_[static_cast<size_t>(k) - 1][static_cast<size_t>(state->predecessor)];
    }
  }
  return {};
}

HomotopyParameters DynamicProgram::ParametersOf(const Choices& choices,
                                                const std::vector<int>& indices) const {
  HomotopyParameters parameters = start_;
  for (size_t k = 0; k < indices.size(); ++k) {
    const StretchChoice& c = choices[k][static_cast<size_t>(indices[k])];
    parameters.durations[k] = c.duration;
    if (k % 2 == 0) parameters.height_scales[k / 2] = c.height;
    if (k == 0) continue;
    parameters.overlaps[k - 1] = c.overlap;
  }
  for (int i = 0; i < sequence_.num_junctions(); ++i) {
    double& overlap = parameters.overlaps[static_cast<size_t>(i)];
    overlap = std::clamp(overlap, 0.0, NaturalOverlapBound(parameters, i));
  }
  return parameters;
}

}  // namespace halfstep
