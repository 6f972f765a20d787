#include "experiments/run/certificate_query.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "experiments/config/experiment.h"
#include "experiments/run/isolated_step.h"
#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep {

CertificateQuery::CertificateQuery(const StepSet& set, const MarginEvaluator& evaluator,
                                   const CertificationOptions& options,
                                   std::vector<MarginFamily> families)
    : set_(set),
      model_(MotionModelOf(evaluator.robot(), set.prototype.shape)),
      // Eight instants refute most of what is not feasible.
      sampled_(evaluator, 0.125 * set.prototype.duration),
      certified_(evaluator, options, {.families = std::move(families)}),
      heights_(evaluator.robot(), evaluator.scene(),
               evaluator.limits().demanded_of(MarginFamily::kFoothold)),
      scratch_(evaluator.MakeScratch()) {
  HALFSTEP_CHECK(!AnythingMoves(evaluator.scene()), "obstacles move");
  for (const Foothold& X_SF : set.placements) X_SF.CheckLevel();
}

double CertificateQuery::HeightAt(const Pose2& X_WF, double from) const {
  return heights_.At(X_WF, from, set_.prototype.via_height);
}

bool CertificateQuery::Bears(const Foothold& X_WF) const { return std::isfinite(X_WF.height); }

Foothold CertificateQuery::Landing(int i, Side support, const Foothold& X_WS) const {
  const Pose2 X_WF = (X_WS * set_.Placement(i, support)).Planar();
  return {X_WF, HeightAt(X_WF, X_WS.height)};
}

bool CertificateQuery::DownIsFree(int i, Side support, const Foothold& X_WS) const {
  const Foothold X_WF = Landing(i, support, X_WS);
  if (!Bears(X_WF)) return false;
  HalfStep down = set_.Down(i, support);
  down.X_SF.height = X_WF.height - X_WS.height;
  return IsProved(down, X_WS);
}

bool CertificateQuery::UpIsFree(int i, Side support, const Foothold& X_WS) const {
  const Foothold X_WF = Landing(i, support, X_WS);
  if (!Bears(X_WF)) return false;
  HalfStep up = set_.Up(i, support);
  up.X_SF.height = X_WS.height - X_WF.height;
  return IsProved(up, X_WF);
}

bool CertificateQuery::IsProved(const HalfStep& half_step, const Foothold& X_WS) const {
  const Foothold& X_SF = half_step.X_SF;
  const Question question = {half_step.kind == HalfStepKind::kUp ? 1.0 : 0.0,
                             half_step.support == Side::kLeft ? 0.0 : 1.0,
                             X_WS.x,
                             X_WS.y,
                             X_WS.height,
                             X_WS.yaw,
                             X_SF.x,
                             X_SF.y,
                             X_SF.height,
                             X_SF.yaw};
  const std::lock_guard lock(mutex_);
  const auto [answer, is_new] = known_.try_emplace(question, false);
  if (is_new) {
    answer->second = AcceptsHalfStep(sampled_, half_step, X_WS, model_, &scratch_) &&
                     AcceptsHalfStep(certified_, half_step, X_WS, model_, &scratch_);
  }
  return answer->second;
}

Work CertificateQuery::work() const {
  const std::lock_guard lock(mutex_);
  return scratch_.work;
}

bool AnythingMoves(const Scene& scene) {
  return !std::ranges::all_of(scene.obstacles, &Obstacle::rests);
}

}  // namespace halfstep
