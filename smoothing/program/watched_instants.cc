#include "smoothing/program/watched_instants.h"

#include <algorithm>
#include <cmath>

#include "smoothing/program/slack_samples.h"
#include "smoothing/program/soft_minimum.h"

namespace halfstep {
namespace {

using Family = HomotopyParameter::Family;

constexpr double kReserve = 3.0;
// Slacks that are near the level, and that are far from it.
constexpr double kNear = 0.3, kFar = 1.0;

// Families that have a row of their own, in their order; and by family the place of its row among
// them, or of the family whose row it shares; −1: it has none.
struct RowOrder {
  std::vector<MarginFamily> families;
  std::array<int, kNumMarginFamilies> place{};
};

const RowOrder& Rows() {
  static const RowOrder kRows = [] {
    RowOrder rows;
    for (const MarginFamily family : AllMarginFamilies()) {
      if (Traits(family).row == family) rows.families.push_back(family);
    }
    for (const MarginFamily family : AllMarginFamilies()) {
      const auto& own = Traits(family).row;
      const auto found = own ? std::ranges::find(rows.families, *own) : rows.families.end();
      rows.place[static_cast<size_t>(family)] =
          found == rows.families.end() ? -1 : static_cast<int>(found - rows.families.begin());
    }
    return rows;
  }();
  return kRows;
}

double StretchOf(const SuperposedWalk& walk, int half_step) {
  const bool last = half_step + 1 == walk.num_half_steps();
  return (last ? walk.duration() : walk.start_of(half_step + 1)) - walk.start_of(half_step);
}

constexpr double kInside = 1e-9;  // of T, from an event

// Just inside the horizontal motion, next to the floor, as a fraction of T.
double MotionEvent(const HalfStep& half_step) {
  const HalfStepShape& shape = half_step.shape;
  const double delay = shape.horizontal_delay;
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
    : variables_(variables), evaluator_(evaluator), options_(options) {
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
    const HalfStep& planned = variables.sequence().half_steps[static_cast<size_t>(k)].half_step;
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

bool WatchedInstants::WatchesBranch(int k) const {
  const std::vector<PlacedHalfStep>& half_steps = variables_.sequence().half_steps;
  return k + 1 < variables_.sequence().size() && options_.range.contains(k) &&
         Demands(options_.stop_branches, half_steps[static_cast<size_t>(k)].half_step.kind);
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

int WatchedInstants::NumRowFamilies() { return static_cast<int>(Rows().families.size()); }

MarginFamily WatchedInstants::family_of(int row) {
  return Rows().families[static_cast<size_t>(row % NumRowFamilies())];
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

LocalTime WatchedInstants::At(const SuperposedWalk& walk, int k, const Instant& instant,
                              std::vector<std::pair<HomotopyParameter, double>>* moving) {
  moving->clear();
  const double u = instant.fraction, T = walk.profiles(k).duration();
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

bool WatchedInstants::Learn(const SuperposedWalk& walk, const LocalTime& at, bool of_branch) {
  const bool learned = Look(walk, at, of_branch, Instant::Why::kLearned);
  CountRows();
  return learned;
}

bool WatchedInstants::Look(const SuperposedWalk& walk, const LocalTime& at, bool of_branch,
                           Instant::Why why) {
  constexpr double kSame = 1e-3;  // of T
  if (!options_.range.contains(at.half_step)) return false;
  const double T = walk.profiles(at.half_step).duration();
  double fraction = at.tau / T;
  const Instant::Of of = of_branch ? Instant::Of::kBranch : Instant::Of::kHalfStep;
  if (of_branch) {
    const double stretch = StretchOf(walk, at.half_step);
    fraction = stretch < T ? (at.tau - stretch) / (T - stretch) : 1.0;
  }
  std::vector<Instant>& instants = instants_[static_cast<size_t>(at.half_step)];
  for (const Instant& known : instants) {
    if (known.of == of && !known.far && std::abs(known.fraction - fraction) < kSame) return false;
  }
  instants.push_back({std::clamp(fraction, 0.0, 1.0), of, why});
  return true;
}

double WatchedInstants::Focus(const SuperposedWalk& walk, double period, double level) {
  // Rows by half-step cost no more for looking at more instants; long rounds need them.
  if (options_.row_per_instant) {
    for (std::vector<Instant>& instants : instants_) {
      std::erase_if(instants, [](const Instant& i) { return i.why == Instant::Why::kMinimum; });
    }
  }
  double least = FocusOn(walk, std::nullopt, period, level);
  for (int k = 0; k + 1 < walk.num_half_steps(); ++k) {
    if (!WatchesBranch(k) || walk.end_of(k) <= walk.start_of(k + 1)) continue;
    least = std::min(least, FocusOn(walk, k, period, level));
  }
  CountRows();
  return least;
}

double WatchedInstants::FocusOn(const SuperposedWalk& walk, std::optional<int> branch,
                                double period, double level) {
  const double far = level + kFar;
  const double begin = branch ? walk.start_of(*branch + 1) : 0.0;
  const double end = branch ? walk.end_of(*branch) : walk.duration();
  const std::vector<LeastSlacks> samples =
      SampledSlacks(branch ? walk.StopBranch(*branch) : walk, evaluator_, options_.range,
                    {.begin = begin, .period = period, .cutoff = far}, workers_);
  const int last = static_cast<int>(samples.size()) - 1;
  const auto lowest = [&samples](int i) {
    return std::ranges::min(samples[static_cast<size_t>(i)]);
  };
  std::vector<std::pair<HomotopyParameter, double>> moving;
  const int from = branch.value_or(0), to = branch.value_or(walk.num_half_steps() - 1);
  for (int k = from; options_.row_per_instant && k <= to; ++k) {
    for (Instant& instant : instants_[static_cast<size_t>(k)]) {
      if ((instant.of == Instant::Of::kBranch) != branch.has_value()) continue;
      const double t = walk.start_of(k) + At(walk, k, instant, &moving).tau;
      const int i = std::clamp(static_cast<int>((t - begin) / period), 0, last);
      instant.far = lowest(i) >= far && lowest(std::min(i + 1, last)) >= far;
    }
  }
  double least = far;
  for (int i = 0; i <= last; ++i) {
    least = std::min(least, lowest(i));
    const double minimum = LocalMinimum(samples, i, far);
    if (minimum >= far) continue;
    // It moves with the parameters.
    const int around = minimum < level + kNear ? 2 : 0;
    for (int j = -around; j <= around; ++j) {
      const double t = std::clamp(begin + (i + j) * period, begin, end);
      const LocalTime at = branch ? LocalTime{*branch, t - walk.start_of(*branch)} : walk.Locate(t);
      Look(walk, at, branch.has_value(), Instant::Why::kMinimum);
    }
  }
  return least;
}

void WatchedInstants::EvaluateHalfStep(const SuperposedWalk& walk, const Eigen::VectorXd& x, int k,
                                       SlackEvaluator* slacks, Eigen::VectorXd* values,
                                       double* nonzeros) const {
  const double rho = options_.sharpness;
  const std::vector<int>& columns = band(k);
  const Eigen::Index width = static_cast<Eigen::Index>(columns.size());
  const SoftMinimum nothing{options_.cutoff, 1.0, Eigen::VectorXd::Zero(nonzeros ? width : 0)};
  std::vector<SoftMinimum> minima(static_cast<size_t>(NumRowFamilies()), nothing);
  double* value = values->data() + first_rows_[static_cast<size_t>(k)];
  const auto write = [&] {
    for (SoftMinimum& minimum : minima) {
      *value++ = minimum.least - (std::log(minimum.sum) + kReserve) / rho;
      for (Eigen::Index c = 0; nonzeros && c < width; ++c) {
        *nonzeros++ = minimum.gradient[c] / minimum.sum;
      }
      minimum = nothing;
    }
  };
  std::vector<std::pair<HomotopyParameter, double>> moving;
  InstantSlacks instant;
  std::optional<SuperposedWalk> branch;
  if (WatchesBranch(k)) branch = walk.StopBranch(k);
  Eigen::MatrixXd pull;   // ∂parameter/∂x on the band (parameters × width)
  Eigen::VectorXd later;  // ∂t/∂x on the band (width); empty where obstacles rest
  for (const Instant& where : instants_[static_cast<size_t>(k)]) {
    if (where.far) continue;
    const LocalTime at = At(walk, k, where, &moving);
    const bool of_branch = where.of == Instant::Of::kBranch;
    slacks->At(of_branch ? *branch : walk, at, moving, nonzeros != nullptr, &instant);
    if (nonzeros && !instant.rows.empty()) {
      pull.setZero(static_cast<Eigen::Index>(instant.parameters.size()), width);
      later.setZero(instant.times.empty() ? 0 : width);
      // Adds what a derivative along a parameter makes of x.
      const auto add = [&](const HomotopyParameter& parameter, double slope, auto&& row) {
        variables_.Pull(parameter, slope, x, walk.parameters(), [&](int variable, double value) {
          row(std::find(columns.begin(), columns.end(), variable) - columns.begin()) += value;
        });
      };
      for (size_t p = 0; p < instant.parameters.size(); ++p) {
        add(instant.parameters[p], 1.0, pull.row(static_cast<Eigen::Index>(p)));
      }
      for (const auto& [parameter, slope] : instant.times) add(parameter, slope, later);
    }
    for (size_t r = 0; r < instant.rows.size(); ++r) {
      const int place = Rows().place[static_cast<size_t>(instant.rows[r].family)];
      SoftMinimum& minimum = minima[static_cast<size_t>(place)];
      const double weight = minimum.Add(instant.rows[r].slack, rho);
      if (!nonzeros || weight < 1e-9) continue;
      minimum.gradient.noalias() +=
          weight *
          (pull.transpose() * instant.gradient.row(static_cast<Eigen::Index>(r)).transpose());
      if (later.size() > 0) minimum.gradient += weight * instant.rows[r].rate * later;
    }
    if (options_.row_per_instant) write();
  }
  if (!options_.row_per_instant) write();
}

void WatchedInstants::Evaluate(const Eigen::VectorXd& x, Eigen::VectorXd* values,
                               std::vector<double>* nonzeros) const {
  const SuperposedWalk walk(variables_.sequence(), variables_.ToParameters(x));
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
    EvaluateHalfStep(walk, x, k, &slacks[static_cast<size_t>(thread)], values,
                     nonzeros ? nonzeros->data() + first[static_cast<size_t>(k)] : nullptr);
    return true;
  });
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
    least[static_cast<size_t>(k)] = LeastSlackOf(walk, k, of, &slacks[static_cast<size_t>(thread)]);
    return true;
  });
  return std::ranges::min(least);
}

double WatchedInstants::LeastSlackOf(const SuperposedWalk& walk, int k,
                                     const std::array<bool, kNumMarginFamilies>& of,
                                     SlackEvaluator* slacks) const {
  double least = options_.cutoff;
  InstantSlacks instant;
  std::vector<std::pair<HomotopyParameter, double>> moving;
  std::optional<SuperposedWalk> branch;
  if (WatchesBranch(k)) branch = walk.StopBranch(k);
  for (const Instant& where : instants_[static_cast<size_t>(k)]) {
    const bool of_branch = where.of == Instant::Of::kBranch;
    slacks->At(of_branch ? *branch : walk, At(walk, k, where, &moving), moving, false, &instant);
    for (const SlackRow& row : instant.rows) {
      if (of[static_cast<size_t>(row.family)]) least = std::min(least, row.slack);
    }
  }
  return least;
}

}  // namespace halfstep
