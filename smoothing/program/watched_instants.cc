#include "smoothing/program/watched_instants.h"

#include <algorithm>

#include "smoothing/program/band_columns.h"
#include "smoothing/program/soft_minimum.h"
#include "wpg/elementary.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Family = HomotopyParameter::Family;

constexpr double kReserve = 3.0;
constexpr double kInside = 1e-9;  // of T, from an event

// Just inside the horizontal motion, next to the floor, as a fraction of T.
double MotionEvent(const HalfStep& half_step) {
  const HalfStepShape& shape = half_step.shape;
  const double delay = shape.foot_delay;
  return half_step.kind == HalfStepKind::kUp ? shape.t2() + delay + kInside
                                             : shape.t1() - delay - kInside;
}

// Just inside the flight, next to the floor, as a fraction of T.
double FlightEvent(const HalfStep& half_step) {
  return half_step.kind == HalfStepKind::kUp ? half_step.shape.t2() + kInside
                                             : half_step.shape.t1() - kInside;
}

}  // namespace

WatchedInstants::WatchedInstants(const OverlapVariables& variables,
                                 const MarginEvaluator& evaluator, const WatchOptions& options)
    : variables_(variables),
      evaluator_(evaluator),
      order_(evaluator.families()),
      options_(options),
      reserves_(variables.sequence().size(), NumRowFamilies(), kReserve / options.sharpness) {
  for (int v = 0; v < variables.size() && !footsteps_move_; ++v) {
    footsteps_move_ = Traits(variables.at(v).family).move != nullptr;
  }
  const int n = variables.sequence().size();
  for (int k = 0; k < n; ++k) {
    std::vector<Instant> instants;
    const bool looked_at = options.range.contains(k);
    for (int m = 0; looked_at && m < options.instants; ++m) {
      instants.push_back({(m + 0.5) / options.instants, Instant::Of::kStretch});
    }
    const HalfStep& planned = Nth(variables.sequence().half_steps, k).half_step;
    const bool flight_moves = variables.IndexOf({Family::kZmpShift, k}) >= 0;
    const bool motion_moves = flight_moves || variables.IndexOf({Family::kFootDelay, k}) >= 0;
    if (looked_at) {  // just inside where a statement begins or ends to count, in order of time
      const bool up = planned.kind == HalfStepKind::kUp;
      std::array<Instant, 3> events = {
          Instant{FlightEvent(planned),
                  flight_moves ? Instant::Of::kFlight : Instant::Of::kHalfStep},
          Instant{MotionEvent(planned),
                  motion_moves ? Instant::Of::kMotion : Instant::Of::kHalfStep},
          Instant{up ? 1.0 - kInside : kInside, Instant::Of::kHalfStep}};
      if (!up) std::ranges::reverse(events);
      instants.insert(instants.end(), events.begin(), events.end());
    }
    const int in_branch = WatchesBranch(k) ? std::max(1, options.instants / 2) : 0;
    for (int m = 0; m < in_branch; ++m) {
      instants.push_back({(m + 0.5) / in_branch, Instant::Of::kBranch});
    }
    instants_.push_back(std::move(instants));
    bands_.push_back(variables.Band(k));
  }
  CountRows();
}

void WatchedInstants::SetSharpness(double sharpness) {
  options_.sharpness = sharpness;
  SetReserves(1.0);
}

void WatchedInstants::SetReserves(double times) {
  reserves_.SetAll(times * kReserve / options_.sharpness);
}

bool WatchedInstants::WatchesBranch(int k) const {
  const std::vector<PlacedHalfStep>& half_steps = variables_.sequence().half_steps;
  return k + 1 < variables_.sequence().size() && options_.range.contains(k) &&
         Demands(options_.stop_branches, Nth(half_steps, k).half_step.kind);
}

void WatchedInstants::CountRows() {
  first_rows_.assign(1, 0);
  for (const std::vector<Instant>& instants : instants_) {
    const int groups = options_.row_per_instant
                           ? static_cast<int>(std::ranges::count(instants, false, &Instant::far))
                           : 1;
    first_rows_.push_back(first_rows_.back() + groups * NumRowFamilies());
  }
}

int WatchedInstants::half_step_of(int row) const {
  const auto after = std::upper_bound(first_rows_.begin(), first_rows_.end(), row);
  return static_cast<int>(after - first_rows_.begin()) - 1;
}

size_t WatchedInstants::num_nonzeros() const {
  size_t sum = 0;
  for (size_t k = 0; k < bands_.size(); ++k) {
    sum += bands_[k].size() * static_cast<size_t>(first_rows_[k + 1] - first_rows_[k]);
  }
  return sum;
}

double WatchedInstants::StretchOf(const SuperposedWalk& walk, int half_step) {
  const bool last = half_step + 1 == walk.num_half_steps();
  return (last ? walk.duration() : walk.start_of(half_step + 1)) - walk.start_of(half_step);
}

LocalTime WatchedInstants::At(const SuperposedWalk& walk, int k, const Instant& instant,
                              ParameterRates* moving) {
  moving->clear();
  const double u = instant.fraction, T = walk.tracks(k).duration();
  if (instant.of == Instant::Of::kHalfStep) {
    moving->push_back({{Family::kDuration, k}, u});
    return {k, u * T};
  }
  if (instant.of == Instant::Of::kMotion || instant.of == Instant::Of::kFlight) {
    const bool motion = instant.of == Instant::Of::kMotion;
    const HalfStep& half_step = walk.half_step(k);
    const double v = motion ? MotionEvent(half_step) : FlightEvent(half_step);
    const double inwards = half_step.kind == HalfStepKind::kUp ? T : -T;
    moving->push_back({{Family::kDuration, k}, v});
    moving->push_back({{Family::kZmpShift, k}, 0.5 * inwards});
    if (motion) moving->push_back({{Family::kFootDelay, k}, inwards});
    return {k, v * T};
  }
  const bool last = k + 1 == walk.num_half_steps();
  if (instant.of == Instant::Of::kStretch) {
    moving->push_back({{Family::kDuration, k}, u});
    if (!last) moving->push_back({{Family::kOverlap, k}, -u});
    return {k, u * StretchOf(walk, k)};
  }
  moving->push_back({{Family::kDuration, k}, 1.0});
  const double overlap = T - StretchOf(walk, k);
  if (overlap <= 0.0) return {k, T};
  moving->push_back({{Family::kOverlap, k}, u - 1.0});
  return {k, T - (1.0 - u) * overlap};
}

void WatchedInstants::EvaluateHalfStep(const SuperposedWalk& walk, const Eigen::VectorXd& x, int k,
                                       SlackEvaluator* slacks, Eigen::VectorXd* values,
                                       double* nonzeros) const {
  const double rho = options_.sharpness;
  const Eigen::Index width = std::ssize(band(k));
  std::optional<BandColumns> columns;
  if (nonzeros) columns.emplace(variables_, band(k), x, walk.parameters());
  // Gradients are gathered along parameters, and pulled back to x when all is gathered.
  const SoftMinimum nothing{options_.cutoff, 1.0, Eigen::VectorXd::Zero(nonzeros ? width : 0)};
  std::vector<SoftMinimum> minima(static_cast<size_t>(NumRowFamilies()), nothing);
  double* value = values->data() + Nth(first_rows_, k);
  const auto write = [&] {
    for (int row = 0; row < NumRowFamilies(); ++row) {
      SoftMinimum& minimum = Nth(minima, row);
      *value++ = minimum.least - Log(minimum.sum) / rho - reserves_.of(k, row);
      if (nonzeros) {
        minimum.gradient /= minimum.sum;
        columns->Pull(minimum.gradient, nonzeros);
        nonzeros += width;
      }
      minimum = nothing;
    }
  };
  ParameterRates moving;
  InstantSlacks instant;
  std::vector<Eigen::Index> of_parameters;  // their columns
  std::optional<SuperposedWalk> branch;
  if (WatchesBranch(k)) branch = walk.StopBranch(k);
  for (const Instant& where : Nth(instants_, k)) {
    if (where.far) continue;
    const LocalTime at = At(walk, k, where, &moving);
    const bool of_branch = where.of == Instant::Of::kBranch;
    slacks->At(of_branch ? *branch : walk, at, moving, nonzeros != nullptr, &instant);
    of_parameters.clear();
    for (size_t r = 0; r < instant.rows.size(); ++r) {
      const SlackRow& row = instant.rows[r];
      SoftMinimum& minimum = Nth(minima, order_.row(row.family));
      const double weight = minimum.Add(row.slack, rho);
      if (!nonzeros || weight < 1e-9) continue;
      if (of_parameters.empty()) {
        for (const auto& along : instant.parameters) of_parameters.push_back(columns->Of(along));
      }
      for (size_t p = 0; p < of_parameters.size(); ++p) {
        minimum.gradient[of_parameters[p]] +=
            weight * instant.gradient(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(p));
      }
      for (const auto& [parameter, slope] : instant.times) {
        if (variables_.IndexOf(parameter) < 0) continue;
        minimum.gradient[columns->Of(parameter)] += weight * row.rate * slope;
      }
    }
    if (options_.row_per_instant) write();
  }
  if (!options_.row_per_instant) write();
}

void WatchedInstants::Evaluate(const Eigen::VectorXd& x, Eigen::VectorXd* values,
                               std::vector<double>* nonzeros) const {
  EvaluateOn(SuperposedWalk(variables_.sequence(), variables_.ToParameters(x)), x, values,
             nonzeros);
}

void WatchedInstants::EvaluateOn(const SuperposedWalk& walk, const Eigen::VectorXd& x,
                                 Eigen::VectorXd* values, std::vector<double>* nonzeros) const {
  std::vector<SlackEvaluator> slacks = Evaluators(
      options_.cutoff + 20.0 / options_.sharpness,
      [this](const HomotopyParameter& parameter) { return variables_.IndexOf(parameter) >= 0; });
  values->resize(rows());
  if (nonzeros) nonzeros->resize(num_nonzeros());
  std::vector<size_t> first = {0};  // entry of each half-step
  for (size_t k = 0; k < bands_.size(); ++k) {
    first.push_back(first.back() +
                    bands_[k].size() * static_cast<size_t>(first_rows_[k + 1] - first_rows_[k]));
  }
  RunWith(workers_, walk.num_half_steps(), [&](int k, int thread) {
    EvaluateHalfStep(walk, x, k, &Nth(slacks, thread), values,
                     nonzeros ? nonzeros->data() + Nth(first, k) : nullptr);
    return true;
  });
  Count(slacks);
}

void WatchedInstants::Count(const std::vector<SlackEvaluator>& slacks) const {
  if (work_ == nullptr) return;
  for (const SlackEvaluator& of_thread : slacks) *work_ += of_thread.work();
}

std::vector<SlackEvaluator> WatchedInstants::Evaluators(double cutoff,
                                                        const ParameterFilter& wanted) const {
  return std::vector<SlackEvaluator>(static_cast<size_t>(NumThreads(workers_)),
                                     SlackEvaluator(evaluator_, cutoff, wanted, footsteps_move_));
}

double WatchedInstants::LeastSlack(const HomotopyParameters& parameters,
                                   const std::array<bool, kNumMarginFamilies>& of) const {
  const SuperposedWalk walk(variables_.sequence(), parameters);
  std::vector<SlackEvaluator> slacks = Evaluators(options_.cutoff, nullptr);
  std::vector<double> least(bands_.size(), options_.cutoff);
  RunWith(workers_, walk.num_half_steps(), [&](int k, int thread) {
    Nth(least, k) = LeastSlackOf(walk, k, of, &Nth(slacks, thread));
    return true;
  });
  Count(slacks);
  return std::ranges::min(least);
}

double WatchedInstants::LeastSlackOf(const SuperposedWalk& walk, int k,
                                     const std::array<bool, kNumMarginFamilies>& of,
                                     SlackEvaluator* slacks) const {
  double least = options_.cutoff;
  InstantSlacks instant;
  ParameterRates moving;
  std::optional<SuperposedWalk> branch;
  if (WatchesBranch(k)) branch = walk.StopBranch(k);
  for (const Instant& where : Nth(instants_, k)) {
    const bool of_branch = where.of == Instant::Of::kBranch;
    slacks->At(of_branch ? *branch : walk, At(walk, k, where, &moving), moving, false, &instant);
    for (const SlackRow& row : instant.rows) {
      if (Nth(of, row.family)) least = std::min(least, row.slack);
    }
  }
  return least;
}

}  // namespace halfstep
