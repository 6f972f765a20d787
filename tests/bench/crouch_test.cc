// Plans under what hangs too low for who stands upright.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/config/experiment.h"
#include "experiments/run/planning.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/temporary_folder.h"
#include "wpg/files/text.h"
#include "wpg/robot/standing_bounds.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
using testing::Not;

// Half-steps straight ahead on coarse cells, in a room as wide as the robot needs; below a beam
// `low` [m] above the floor.
struct UnderABeam {
  explicit UnderABeam(double low, const std::string& more = "") {
    WriteText(place / "scene.yaml",
              Formatted("obstacles: [{name: beam, box: {size_m: [0.1, 6, 0.2]}, pose: {xyz: [0.6, "
                        "0, %.4f]}}]\n",
                        low + 0.1));
    config = LoadConfig(
        WriteText(place / "walk.yaml",
                  "robot: hrp2\nscene: scene.yaml\ngoal: {x_m: 1, y_m: 0, radius_m: 0.15}\n"
                  "step_set: {x_min_m: 0, x_max_m: 0.2, y_min_m: -0.21, y_max_m: -0.21,\n"
                  "           spacing_m: 0.2, yaws_rad: [0]}\n"
                  "swept_volumes: {cell_m: 0.03, displacement_m: 0.03, cache: cache}\n"
                  "planner: {unimproved_nodes: 0, effort: 1, workspace_m: [-0.5, -0.6, 1.5, 0.6]}\n"
                  "smoothing: {methods: []}\n" +
                      more),
        {});
    at = LoadPlace(config);
    walk = PlanWalk(config, at, {});
  }

  TemporaryFolder place;
  ExperimentConfig config;
  Place at;
  PlannedWalk walk;
};

double Height() {
  ExperimentConfig config;
  config.robot = "hrp2";
  config.scene = "none";
  return StandingBounds(LoadPlace(config).robot).max().z();
}

bool IsCertified(const ExperimentConfig& config) {
  const Experiment e = Prepare(config);
  const CertifiedFeasibility test(MarginEvaluator(e.robot, e.scene, e.config.smoothing.limits),
                                  e.config.smoothing.certification);
  const SuperposedWalk walk(e.sequence, PlannedMotion(e.sequence));
  MarginEvaluator::Scratch scratch = test.evaluator().MakeScratch();
  return test.Check(walk, {0.0, walk.duration()}, &scratch).verdict == Verdict::kFeasible;
}

TEST(Crouch, LeadsUnderABeamThatIsTooLowForWhoStands) {
  const UnderABeam low(Height() - 0.04);
  ASSERT_EQ(low.walk.plan.status, PlanStatus::kSolved) << low.walk.plan.sentence;
  EXPECT_EQ(low.walk.config.half_step.crouch, 0.15);
  EXPECT_THAT(low.walk.changed_half_step, HasSubstr("crouch_m: 0.15"));
  EXPECT_THAT(
      low.walk.plan.sentence,
      HasSubstr(
          "since 'beam' hangs 1.467 m above the floor, where half-steps upright need 1.572 m"));
  EXPECT_TRUE(IsCertified(low.walk.config));
  // The same footsteps upright are not: the beam is what the crouch is for.
  ExperimentConfig upright = low.walk.config;
  upright.half_step = low.config.half_step;
  EXPECT_FALSE(IsCertified(upright));
}

TEST(Crouch, IsNotForBeamsThatAreHighEnough) {
  const UnderABeam high(Height() + 0.07);
  ASSERT_EQ(high.walk.plan.status, PlanStatus::kSolved) << high.walk.plan.sentence;
  EXPECT_EQ(high.walk.config.half_step.crouch, 0.0);
  EXPECT_EQ(high.walk.changed_half_step, "");
}

TEST(Crouch, DoesNotHelpUnderABeamThatIsFarTooLow) {
  const UnderABeam lower(Height() - 0.3);
  EXPECT_NE(lower.walk.plan.status, PlanStatus::kSolved);
  EXPECT_THAT(lower.walk.plan.sentence, HasSubstr("meet 'beam'; 'beam' hangs 1.2"));
  EXPECT_THAT(lower.walk.plan.sentence, HasSubstr("where half-steps upright need 1.512 m"));
  EXPECT_THAT(lower.walk.plan.sentence, Not(HasSubstr("half_step: {")));
}

}  // namespace
}  // namespace halfstep
