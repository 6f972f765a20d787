#include "smoothing/margins/slack_evaluator.h"

#include <algorithm>
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
                        const std::vector<std::pair<HomotopyParameter, double>>& moving,
                        bool gradient, InstantSlacks* out) {
  ++(gradient ? scratch_.work.derivatives : scratch_.work.instants);
  out->parameters.clear();
  out->times.clear();
  sink_.Clear();
  const MarginLimits& limits = evaluator_.limits();
  Instant instant(evaluator_.place(), limits, walk, at, &scratch_);
  const bool regular = instant.regular();
  if (gradient) {
    std::vector<WalkSensitivity>& sensitivities = sink_.sensitivities;
    const WalkJet& jet = instant.jet();
    walk.Sensitivities(at, &sensitivities, wanted_);
    WalkState third = WalkState::Zero();
    if (!moving.empty()) third = walk.ThirdRanges(instant.t(), instant.t()).center;
    for (const auto& [moves, rate] : moving) {
      const HomotopyParameter& parameter = moves;  // clang 14 captures no binding
      if (wanted_ && !wanted_(parameter)) continue;
      auto found = std::find_if(sensitivities.begin(), sensitivities.end(),
                                [&](const WalkSensitivity& s) { return s.parameter == parameter; });
      if (found == sensitivities.end()) {
        sensitivities.push_back({parameter, {}});
        found = sensitivities.end() - 1;
      }
      found->jet.value += rate * jet.first;
      found->jet.first += rate * jet.second;
      found->jet.second += rate * third;
    }
    if (!evaluator_.scene().rests()) {
      walk.StartSensitivities(at.half_step, &out->times);
      out->times.insert(out->times.end(), moving.begin(), moving.end());
    }
    for (const WalkSensitivity& s : sensitivities) {
      out->parameters.push_back(s.parameter);
      if (regular) {
        sink_.tangents.push_back(Differentiate(evaluator_.robot(), jet, instant.posture(), s.jet));
      }
    }
  }
  for (const MarginFamily family : evaluator_.families()) {
    sink_.Begin(family, limits.demanded_of(family));
    evaluator_.statements(family).AddRows(&instant, &sink_);
  }
  out->rows = sink_.rows();
  if (gradient) out->gradient = sink_.Gradient();
}

}  // namespace halfstep
