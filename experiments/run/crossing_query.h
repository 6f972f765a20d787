#pragma once

#include <Eigen/Core>
#include <vector>

#include "experiments/run/certificate_query.h"
#include "experiments/run/obstacle_footprint.h"
#include "planner/search/half_step_query.h"
#include "planner/search/step_set.h"

namespace halfstep {

/// Answers for planners by volumes, and by proofs where half-steps lead over an obstacle: a volume
/// holds all that its half-step sweeps and some more, which over an obstacle is often too much.
/// What its volume does not call free is asked of `proofs` when one of its soles stands wholly
/// before an obstacle and the other one wholly behind. Thread-safe as these are. Source:
/// planner/README.md, "Over an obstacle".
class CrossingQuery : public HalfStepQuery {
 public:
  /// All is borrowed but `over`, what half-steps may lead over. Both queries are of `set`;
  /// `sole_outline` is RobotModel::sole_outline.
  CrossingQuery(const HalfStepQuery& volumes, const CertificateQuery& proofs, const StepSet& set,
                const Eigen::Matrix2Xd& sole_outline, std::vector<ObstacleFootprint> over)
      : volumes_(volumes),
        proofs_(proofs),
        set_(set),
        sole_outline_(sole_outline),
        over_(std::move(over)) {}

  bool DownIsFree(int i, Side support, const Foothold& X_WS) const override;
  bool UpIsFree(int i, Side support, const Foothold& X_WS) const override;
  bool Bears(const Foothold& X_WF) const override { return volumes_.Bears(X_WF); }

 private:
  bool LeadsOver(int i, Side support, const Foothold& X_WS) const;

  const HalfStepQuery& volumes_;
  const CertificateQuery& proofs_;
  const StepSet& set_;
  const Eigen::Matrix2Xd& sole_outline_;
  std::vector<ObstacleFootprint> over_;
};

}  // namespace halfstep
