#pragma once

#include <memory>
#include <stop_token>
#include <string>

#include "experiments/config/experiment.h"
#include "experiments/run/certificate_query.h"
#include "planner/scene/scene.h"
#include "planner/search/footstep_planner.h"
#include "planner/search/step_set.h"
#include "planner/swept/swept_volumes.h"

namespace halfstep {

/// The half-steps that a replanner chooses from, and what calls them free: swept volumes, or, on
/// ground with levels, their own proofs. Const and thread-safe.
class FreeHalfSteps {
 public:
  /// By `volumes`, which is borrowed. Clearances of volumes are those that the config demands.
  FreeHalfSteps(const SweptVolumes& volumes, const RobotModel& robot,
                const ExperimentConfig& config);
  /// By proofs, on the ground of the place. What the ground has a say in is proved once, among
  /// whatever obstacles are asked about.
  FreeHalfSteps(const Place& place, const ExperimentConfig& config);
  FreeHalfSteps(const FreeHalfSteps&) = delete;  // answers borrow the set
  FreeHalfSteps& operator=(const FreeHalfSteps&) = delete;

  const StepSet& set() const;  ///< all of them
  /// Null: by proofs.
  const SweptVolumes* volumes() const { return volumes_; }
  /// Answers about a scene as it was measured, whose ground is the place's: free is what is free
  /// whenever it is executed. Borrows this.
  std::unique_ptr<const HalfStepQuery> Among(const Scene& scene) const;
  /// The height of the ground under a sole at X_WF for who stands at the height `from` [m]; NaN: it
  /// bears none there.
  double HeightAt(const Pose2& X_WF, double from) const {
    return alone_ ? alone_->HeightAt(X_WF, from) : from;
  }
  /// Lets a search know what it chooses from, and how high the ground is.
  PlanRequest Request(const HalfStepQuery& query) const;

 private:
  RobotModel robot_;
  MarginLimits limits_;
  CertificationOptions certification_;
  const SweptVolumes* volumes_ = nullptr;
  StepSet set_;                                    // of proofs
  std::unique_ptr<const CertificateQuery> alone_;  // of the ground without obstacles
};

/// Whether an episode calls half-steps free by their proofs: on ground with levels, or where the
/// config says so (`planner.free_by`).
bool FreeByProofs(const Place& place, const ExperimentConfig& config);

/// The form of an episode's half-steps.
struct EpisodeForm {
  HalfStepConfig half_step;  ///< as a config has it
  /// Why start and goal are not joined even where nothing stands; "": they are, or the ground is
  /// flat.
  std::string why_none = {};
};
/// On ground with levels the first form by which an episode's start and goal are joined where
/// nothing stands (planner/README.md, "By certificates"); the config's own where there is none, or
/// the ground is flat. Throws InputError as PlanWalk, and where the config asks for volumes on
/// levels.
EpisodeForm FormFor(const Place& place, const ExperimentConfig& config,
                    const std::stop_token& stop = {});

}  // namespace halfstep
