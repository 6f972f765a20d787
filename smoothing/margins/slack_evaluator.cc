#include "smoothing/margins/slack_evaluator.h"

#include <utility>

namespace halfstep {

double InstantSlacks::Slope(size_t row, const HomotopyParameter& parameter) const {
  double slope = 0.0;
  for (size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i] != parameter) continue;
    slope += gradient(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(i));
  }
  for (const auto& [moving, rate] : times) {
    if (moving == parameter) slope += rows[row].rate * rate;
  }
  return slope;
}

SlackEvaluator::SlackEvaluator(const MarginEvaluator& evaluator, double cutoff,
                               ParameterFilter wanted, bool footsteps_move)
    : evaluator_(evaluator),
      wanted_(std::move(wanted)),
      sink_(cutoff),
      scratch_(evaluator.MakeScratch()) {
  sink_.footsteps_move = footsteps_move;
}

void SlackEvaluator::At(const SuperposedWalk& walk, const LocalTime& at,
                        const ParameterRates& moving, bool gradient, InstantSlacks* out) {
  ++(gradient ? scratch_.work.derivatives : scratch_.work.instants);
  out->parameters.clear();
  out->times.clear();
  sink_.Clear();
  const MarginLimits& limits = evaluator_.limits();
  Instant instant(evaluator_.place(), limits, walk, at, &scratch_);
  if (gradient) {
    walk.Sensitivities(at, &sink_.sensitivities, wanted_, moving);
    if (!evaluator_.scene().rests()) {
      walk.StartSensitivities(at.half_step, &out->times);
      out->times.insert(out->times.end(), moving.begin(), moving.end());
    }
    for (const WalkSensitivity& s : sink_.sensitivities) out->parameters.push_back(s.parameter);
  }
  for (const MarginFamily family : evaluator_.families()) {
    sink_.Begin(family, limits.demanded_of(family));
    evaluator_.statements(family).AddRows(&instant, &sink_);
  }
  out->rows = sink_.rows();
  if (gradient) out->gradient = sink_.Gradient();
}

}  // namespace halfstep
