// Walks of shipped configs in tubes of the size that `halfstep replay --suggest-tube` finds: every
// drawn motion keeps what is demanded.
//
// A few hundred motions; HALFSTEP_TUBE=10000 for that many of each walk.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <optional>

#include "smoothing/methods/dichotomy.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/places.h"
#include "tests/scenarios/load_experiment.h"
#include "tests/smoothing/smoothed.h"
#include "tests/smoothing/tube_cases.h"
#include "tests/smoothing/tube_draw.h"
#include "tests/smoothing/tube_margins.h"

namespace halfstep {
namespace {

/// A config with the tube of its walk on servos of 10,000 N m/rad by `dcm`.
struct ReplayedTube {
  const char* config;
  Tube tube;
};

/// The walk of the dichotomy, certified in the tube with nothing demanded beyond it.
class WalkInItsTube {
 public:
  explicit WalkInItsTube(const ReplayedTube& of)
      : experiment_(Prepare(LoadConfig(
            InSources("experiments/configs/") + of.config + ".yaml",
            {{"smoothing.margins.clearance_m", "0"}, {"smoothing.margins.floor_m", "0"}}))),
        tube_(of.tube),
        limits_(experiment_.config.smoothing.limits) {
    limits_.tube = tube_;
    const MarginEvaluator evaluator(experiment_.robot, experiment_.scene, limits_);
    const CertifiedFeasibility test(evaluator, {});
    walk_.emplace(experiment_.sequence,
                  Smoothed(Dichotomy, ProblemOf(experiment_.sequence, test), {}).parameters);
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    verdict_ = CertifiedFeasibility(evaluator, {})
                   .Check(*walk_, {0.0, walk_->duration()}, &scratch)
                   .verdict;
  }

  Verdict verdict() const { return verdict_; }
  // How many of `motions` in a tube so many times as wide miss a demand, by family.
  std::map<MarginFamily, int> Beyond(int motions, double times) const {
    const Tube wide{.foot = times * tube_.foot,
                    .foot_turn = times * tube_.foot_turn,
                    .waist = times * tube_.waist,
                    .waist_turn = times * tube_.waist_turn,
                    .joint = times * tube_.joint,
                    .joint_speed = 0.0,
                    .zmp = 0.0};
    const MarginEvaluator evaluator(experiment_.robot, experiment_.scene, {});
    TubeDraw draw(experiment_.robot, wide, 5);
    std::map<MarginFamily, int> beyond;
    for (int i = 0; i < motions; ++i) {
      const LocalTime at = walk_->Locate(draw.draw().Uniform(0, walk_->duration()));
      const Posture plan = SolvePosture(experiment_.robot, walk_->At(at).value);
      for (const auto& [family, margin] : TubeMarginsOf(evaluator, draw.Near(plan), *walk_, at)) {
        if (margin < Nth(limits_.demanded, family)) ++beyond[family];
      }
    }
    return beyond;
  }

 private:
  Experiment experiment_;
  Tube tube_;
  MarginLimits limits_;
  std::optional<SuperposedWalk> walk_;
  Verdict verdict_;
};

TEST(TubeOfReplay, NoDrawnMotionMissesWhatIsDemanded) {
  const ReplayedTube tubes[] = {{"fig3_two_half_steps",
                                 {.foot = 0.0055,
                                  .foot_turn = 0.36 * kTubeDegree,
                                  .waist = 0.0033,
                                  .waist_turn = 0.3 * kTubeDegree,
                                  .joint = 0.004}},
                                {"fig5_box",
                                 {.foot = 0.0041,
                                  .foot_turn = 0.31 * kTubeDegree,
                                  .waist = 0.0032,
                                  .waist_turn = 0.27 * kTubeDegree,
                                  .joint = 0.0091}}};
  for (const ReplayedTube& one : tubes) {
    const WalkInItsTube walk(one);
    ASSERT_EQ(walk.verdict(), Verdict::kFeasible) << one.config;
    EXPECT_THAT(walk.Beyond(Motions(500), 1.0), testing::IsEmpty()) << one.config;
    EXPECT_FALSE(walk.Beyond(500, 8.0).empty()) << one.config;
  }
}

}  // namespace
}  // namespace halfstep
