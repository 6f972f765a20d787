#pragma once

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "experiments/run/sole_heights.h"
#include "planner/search/half_step_query.h"
#include "planner/search/step_set.h"
#include "smoothing/margins/margin_evaluator.h"
#include "smoothing/margins/work.h"
#include "smoothing/proof/certified_feasibility.h"
#include "smoothing/proof/sampled_feasibility.h"

namespace halfstep {

/// Answers for planners by proofs instead of baked volumes: a half-step is free when every demanded
/// margin of it, alone, is certified in the scene for all t. Elements of the set have no height of
/// their own; they land on the ground under them, as high as it is. Nothing is baked, so any
/// difference of height will do, and an answer takes milliseconds where a volume needs
/// microseconds. What some instants refute is refused before it is proved; each question is
/// answered once. Thread-safe; threads wait for each other. Source: planner/README.md, "By
/// certificates".
class CertificateQuery : public HalfStepQuery {
 public:
  /// `set` is borrowed and must outlive this. Nothing but `families` is proved. Preconditions: all
  /// elements are level, and nothing in the evaluator's scene moves (std::logic_error).
  CertificateQuery(const StepSet& set, const MarginEvaluator& evaluator,
                   const CertificationOptions& options,
                   std::vector<MarginFamily> families = CertificationScope{}.families);

  bool DownIsFree(int i, Side support, const Foothold& X_WS) const override;
  bool UpIsFree(int i, Side support, const Foothold& X_WS) const override;
  /// Whether a height was found.
  bool Bears(const Foothold& X_WF) const override;

  /// The height at which the ground bears a sole at X_WF, as `foothold` demands it, for who stands
  /// at the height `from`: the highest level that is no higher above or below than the via point is
  /// above the support sole [m]. NaN: none. It is PlanRequest::ground.
  double HeightAt(const Pose2& X_WF, double from) const;
  Work work() const;  ///< of all answers so far

 private:
  // By kind, support, X_WS and X_SF.
  using Question = std::array<double, 10>;
  Foothold Landing(int i, Side support, const Foothold& X_WS) const;
  bool IsProved(const HalfStep& half_step, const Foothold& X_WS) const;

  const StepSet& set_;
  std::shared_ptr<const MotionModel> model_;
  SampledFeasibility sampled_;
  CertifiedFeasibility certified_;
  SoleHeights heights_;
  mutable std::mutex mutex_;
  mutable MarginEvaluator::Scratch scratch_;
  mutable std::map<Question, bool> known_;
};

/// Whether obstacles of a scene move, or may: a half-step by itself then says nothing of when it is
/// executed.
bool AnythingMoves(const Scene& scene);

}  // namespace halfstep
