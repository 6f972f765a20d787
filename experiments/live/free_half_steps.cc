#include "experiments/live/free_half_steps.h"

#include "experiments/run/ground_steps.h"
#include "experiments/run/planning.h"
#include "planner/swept/swept_volume_query.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

std::vector<MarginFamily> FamiliesOfScenes() {
  std::vector<MarginFamily> families;
  for (const MarginFamily family : AllMarginFamilies()) {
    if (Traits(family).scope == MarginScope::kScene) families.push_back(family);
  }
  return families;
}

// Obstacles wherever they may be at any time, as if they rested.
Scene AtAnyTime(Scene scene) {
  for (Obstacle& obstacle : scene.obstacles) {
    ObstacleMotion& motion = obstacle.motion;
    if (motion.speed > 0.0) motion.error += motion.speed * motion.horizon;
    motion.speed = 0.0;
  }
  return scene;
}

// Free is what is proved on the ground, and then among the obstacles.
class ProvedAmong : public HalfStepQuery {
 public:
  ProvedAmong(const CertificateQuery& alone, const StepSet& set, const MarginEvaluator& evaluator,
              const CertificationOptions& options)
      : alone_(alone), among_(set, evaluator, options, FamiliesOfScenes()) {}

  bool DownIsFree(int i, Side support, const Foothold& X_WS) const override {
    return alone_.DownIsFree(i, support, X_WS) && among_.DownIsFree(i, support, X_WS);
  }
  bool UpIsFree(int i, Side support, const Foothold& X_WS) const override {
    return alone_.UpIsFree(i, support, X_WS) && among_.UpIsFree(i, support, X_WS);
  }
  bool Bears(const Foothold& X_WF) const override { return alone_.Bears(X_WF); }

 private:
  const CertificateQuery& alone_;
  CertificateQuery among_;
};

}  // namespace

FreeHalfSteps::FreeHalfSteps(const SweptVolumes& volumes, const RobotModel& robot,
                             const ExperimentConfig& config)
    : robot_(robot), limits_(config.smoothing.limits), volumes_(&volumes) {}

FreeHalfSteps::FreeHalfSteps(const Place& place, const ExperimentConfig& config)
    : robot_(place.robot),
      limits_(config.smoothing.limits),
      certification_(config.smoothing.certification),
      set_(StepsByGround(place.robot, config)),
      alone_(std::make_unique<const CertificateQuery>(
          set_, MarginEvaluator(robot_, place.scene.Emptied(), limits_), certification_)) {
  if (set_.size() == 0) ThrowNoHalfStep(robot_, config);
}

const StepSet& FreeHalfSteps::set() const { return volumes_ != nullptr ? volumes_->set : set_; }

std::unique_ptr<const HalfStepQuery> FreeHalfSteps::Among(const Scene& scene) const {
  if (volumes_ != nullptr) {
    return std::make_unique<const SweptVolumeQuery>(*volumes_, robot_.sole_outline, scene,
                                                    limits_.demanded_of(MarginFamily::kNoStep));
  }
  return std::make_unique<const ProvedAmong>(
      *alone_, set_, MarginEvaluator(robot_, AtAnyTime(scene), limits_), certification_);
}

PlanRequest FreeHalfSteps::Request(const HalfStepQuery& query) const {
  PlanRequest request{.start = {}, .goal = {}, .set = set(), .query = query};
  if (volumes_ == nullptr) {
    request.ground = [this](const Pose2& X_WF, double from) {
      return alone_->HeightAt(X_WF, from);
    };
  }
  return request;
}

bool FreeByProofs(const Place& place, const ExperimentConfig& config) {
  return HasLevels(*place.scene.ground) || config.planner.free_by == "certificates";
}

EpisodeForm FormFor(const Place& place, const ExperimentConfig& config,
                    const std::stop_token& stop) {
  if (!HasLevels(*place.scene.ground)) return {config.half_step};
  if (config.planner.free_by == "volumes") {
    throw InputError(
        {"planner.free_by: volumes know no ground that a walk is replanned on when it "
         "has levels (valid: certificates)"});
  }
  const PlannedWalk walk =
      PlanWalk(config, {.robot = place.robot, .scene = place.scene.Emptied()}, {.stop = stop});
  if (walk.plan.status == PlanStatus::kSolved) return {walk.config.half_step};
  return {config.half_step, walk.plan.sentence};
}

}  // namespace halfstep
