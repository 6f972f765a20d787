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
/// What its volume does not call free is asked of `proofs` when it passes over an obstacle or as
/// near as `near` to it, and no sole stands beside its narrower side's ends [m]. Thread-safe as
/// these are. Source: planner/README.md, "Over an obstacle".
class CrossingQuery : public HalfStepQuery {
 public:
  /// What half-steps may lead over, and how near to it proofs are asked for.
  struct Over {
    std::vector<ObstacleFootprint> obstacles;
    double near = 0.0;  ///< [m]
  };

  /// All is borrowed but `over`. Both queries are of `set`; `sole_outline` is
  /// RobotModel::sole_outline.
  CrossingQuery(const HalfStepQuery& volumes, const CertificateQuery& proofs, const StepSet& set,
                const Eigen::Matrix2Xd& sole_outline, Over over)
      : volumes_(volumes),
        proofs_(proofs),
        set_(set),
        sole_outline_(sole_outline),
        over_(std::move(over)) {}

  bool DownIsFree(int i, Side support, const Foothold& X_WS) const override;
  bool UpIsFree(int i, Side support, const Foothold& X_WS) const override;
  bool Bears(const Foothold& X_WF) const override { return volumes_.Bears(X_WF); }

 private:
  // Whether a half-step on S passes over an obstacle, or near it: its swing foot stands at F, and
  // the via point is beside S.
  bool LeadsOver(Side support, const Pose2& X_WS, const Pose2& X_WF) const;

  const HalfStepQuery& volumes_;
  const CertificateQuery& proofs_;
  const StepSet& set_;
  const Eigen::Matrix2Xd& sole_outline_;
  Over over_;
};

}  // namespace halfstep
