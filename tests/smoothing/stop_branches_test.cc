// Walks that are cut after a half-step. Statements by number: smoothing/README.md, "Stop branches".

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "smoothing/proof/stoppable_feasibility.h"
#include "tests/smoothing/fake_feasibility.h"
#include "tests/smoothing/test_walks.h"
#include "wpg/motion/lipm.h"

namespace halfstep {
namespace {

// Statement 1.
TEST(StopBranch, IsTheWalkToTheBitUntilTheNextHalfStepWouldBegin) {
  WalkDraw draw(510);
  for (int i = 0; i < Draws(100); ++i) {
    const HalfStepSequence sequence = draw.Sequence(4);
    const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence));
    for (int k = 0; k + 1 < walk.num_half_steps(); ++k) {
      const SuperposedWalk branch = walk.StopBranch(k);
      ASSERT_EQ(branch.num_half_steps(), k + 1);
      EXPECT_EQ(branch.duration(), walk.end_of(k));
      const double t = draw.Uniform(0, 1) * walk.start_of(k + 1);
      const WalkJet expected = walk.At(t), jet = branch.At(t);
      EXPECT_EQ(jet.value, expected.value);
      EXPECT_EQ(jet.first, expected.first);
      EXPECT_EQ(jet.second, expected.second);
      EXPECT_EQ(branch.StepInAir(branch.Locate(t)), walk.StepInAir(walk.Locate(t)));
      // C² where the two part.
      EXPECT_TRUE(IsC2At(branch, walk.start_of(k + 1), 1e-9));
    }
  }
}

// Statement 2, and that the CoM and the ZMP are a linear inverted pendulum all the way.
TEST(StopBranch, EndsAtRestOnOneFootOrOnBoth) {
  WalkDraw draw(511);
  for (int i = 0; i < Draws(100); ++i) {
    const HalfStepSequence sequence = draw.Sequence(4);
    const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence));
    for (int k = 0; k < walk.num_half_steps(); ++k) {
      const SuperposedWalk branch = walk.StopBranch(k);
      const WalkJet end = branch.At(branch.duration());
      EXPECT_LT(Largest(end.first), 1e-9);
      EXPECT_LT(Largest(end.second), 1e-8);
      const Pose2 X_WS = walk.X_WS(k).Planar();
      const bool up = walk.half_step(k).kind == HalfStepKind::kUp;
      EXPECT_EQ(branch.StepInAir(branch.Locate(branch.duration())), up ? k / 2 : -1);
      if (up) {
        const Eigen::Vector2d support_point = X_WS * walk.half_step(k).support_point();
        EXPECT_LT((end.value.segment<2>(kComX) - support_point).norm(), 1e-9);
      }
      const double omega_squared = std::pow(dynamic_cast<const Lipm&>(branch.model()).omega(), 2);
      for (int n = 0; n <= 10; ++n) {
        const WalkJet jet = branch.At(branch.duration() * n / 10);
        for (int axis = 0; axis < 2; ++axis) {
          const double zmp = jet.value[kComX + axis] - jet.second[kComX + axis] / omega_squared;
          EXPECT_NEAR(zmp, jet.value[kZmpX + axis], 1e-9);
        }
      }
    }
  }
}

// Statement 3, for one overlap that grew: the walk changed while both of its half-steps are under
// way, and the branches whose new part changed are those whose t_{k+1} lies there.
TEST(StopBranch, ChangesOnlyWhereTheWalkChangedWhenItsNewPartBegins) {
  WalkDraw draw(512);
  int changed = 0, same = 0;
  for (int i = 0; i < Draws(200); ++i) {
    const HalfStepSequence sequence = draw.Sequence(4);
    const SuperposedWalk before(sequence, draw.Parameters(sequence, 0.0, 1.0));
    SuperposedWalk after = before;
    const int junction = static_cast<int>(draw.Uniform(0, 7));
    const double bound = NaturalOverlapBound(before.parameters(), junction);
    const double was_overlap = before.parameters().overlaps[static_cast<size_t>(junction)];
    after.SetOverlap(junction, was_overlap + draw.Uniform(0, 1) * (bound - was_overlap));
    for (int k = 0; k + 1 < before.num_half_steps(); ++k) {
      const double new_part = after.end_of(k) - after.start_of(k + 1);
      if (new_part <= 0.0) continue;
      const SuperposedWalk branch = after.StopBranch(k), was = before.StopBranch(k);
      double difference = 0.0;
      for (int n = 0; n <= 10; ++n) {  // by the time that is left until it rests
        const double left = new_part * n / 10;
        const WalkJet a = branch.At(branch.duration() - left), b = was.At(was.duration() - left);
        difference = std::max({difference, Largest(a.value - b.value), Largest(a.first - b.first)});
      }
      if (difference < 1e-9) {
        ++same;
        continue;
      }
      ++changed;
      EXPECT_GE(after.start_of(k + 1), after.start_of(junction + 1));
      EXPECT_LE(after.start_of(k + 1), after.end_of(junction));
    }
  }
  EXPECT_GT(changed, Draws(200) / 10);
  EXPECT_GT(same, Draws(200));
}

class StoppableTest : public testing::Test {
 protected:
  // What the test within was asked, besides the walk: half-steps of each branch, and its span.
  using Asked = std::vector<std::pair<int, TimeSpan>>;
  Asked AskedOf(StopBranches branches, const TimeSpan& span) {
    const auto test = std::make_shared<FakeFeasibility>(
        evaluator_, [](const HomotopyParameters&) { return Verdict::kFeasible; });
    MarginEvaluator::Scratch scratch = evaluator_.MakeScratch();
    const StoppableFeasibility stoppable(test, branches);
    EXPECT_EQ(stoppable.Check(walk_, span, &scratch).verdict, Verdict::kFeasible);
    Asked asked;
    for (size_t i = 1; i < test->questions.size(); ++i) {
      const FakeFeasibility::Question& q = test->questions[i];
      asked.emplace_back(static_cast<int>(q.parameters.durations.size()), q.span);
    }
    return asked;
  }

  const MarginEvaluator evaluator_{Hrp2(), {}, {}};
  WalkDraw draw_{513};
  const HalfStepSequence sequence_ = draw_.Sequence(3);
  const SuperposedWalk walk_{sequence_, draw_.Parameters(sequence_, 0.3, 0.9)};
};

TEST_F(StoppableTest, ChecksTheNewPartsOfTheBranchesThatPartWithinTheWindow) {
  const auto all = AskedOf(StopBranches::kAll, {0.0, walk_.duration()});
  ASSERT_EQ(all.size(), 5u);
  for (int k = 0; k < 5; ++k) {
    EXPECT_EQ(all[static_cast<size_t>(k)].first, k + 1);
    EXPECT_EQ(all[static_cast<size_t>(k)].second.begin, walk_.start_of(k + 1));
    EXPECT_EQ(all[static_cast<size_t>(k)].second.end, walk_.end_of(k));
  }
  const auto down = AskedOf(StopBranches::kDown, {0.0, walk_.duration()});
  ASSERT_EQ(down.size(), 2u);
  EXPECT_EQ(down[0].first, 2);
  EXPECT_EQ(down[1].first, 4);
  EXPECT_TRUE(AskedOf(StopBranches::kNone, {0.0, walk_.duration()}).empty());
  const auto one = AskedOf(StopBranches::kAll, {walk_.start_of(3), walk_.start_of(3)});
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].first, 3);
}

TEST_F(StoppableTest, ARefusedBranchRefusesTheWalkAndIsNamed) {
  for (const Verdict verdict : {Verdict::kViolated, Verdict::kUndecided}) {
    const auto test =
        std::make_shared<FakeFeasibility>(evaluator_, [verdict](const HomotopyParameters& p) {
          return p.durations.size() == 3 ? verdict : Verdict::kFeasible;
        });
    MarginEvaluator::Scratch scratch = evaluator_.MakeScratch();
    const StoppableFeasibility stoppable(test, StopBranches::kAll);
    const Feasibility answer = stoppable.Check(walk_, {0.0, walk_.duration()}, &scratch);
    EXPECT_EQ(answer.verdict, verdict);
    EXPECT_EQ(answer.witness.stop_after, 2);
    EXPECT_NE(evaluator_.Describe(answer.witness).find("if the walk is stopped after half-step 3"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace halfstep
