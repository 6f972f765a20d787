#include "smoothing/proof/certified_feasibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stop_token>

#include "smoothing/methods/dichotomy.h"
#include "smoothing/proof/sampled_feasibility.h"
#include "tests/smoothing/certificate_draws.h"
#include "tests/smoothing/smoothed.h"
#include "wpg/motion/lipm.h"

namespace halfstep {
namespace {

constexpr double kAnyClearance = -10.0;  // [m] below every margin of a walk within reach

// Only obstacles count.
MarginLimits ObstaclesOnly() {
  MarginLimits limits;
  limits.foot_speed.reset();
  limits.foot_yaw_rate.reset();
  limits.demanded.fill(-100.0);
  // It is −∞ where the ZMP is outside the support polygon.
  limits.demanded_of(MarginFamily::kFriction) = kNotDemanded;
  limits.demanded_of(MarginFamily::kSelfClearance) = kAnyClearance;
  limits.demanded_of(MarginFamily::kClearance) = 0.0;
  return limits;
}

Scene With(ConvexBody shape, const Eigen::Isometry3d& X_WO) {
  Scene scene;
  scene.obstacles.push_back({.name = "obstacle", .shape = std::move(shape), .X_WO = X_WO});
  return scene;
}

Feasibility Certified(const RobotModel& robot, const Scene& scene, const MarginLimits& limits,
                      const SuperposedWalk& walk) {
  const MarginEvaluator evaluator(robot, scene, limits);
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  return CertifiedFeasibility(evaluator, {}).Check(walk, {0.0, walk.duration()}, &scratch);
}

Feasibility Sampled(const RobotModel& robot, const Scene& scene, const MarginLimits& limits,
                    const SuperposedWalk& walk, double period) {
  const MarginEvaluator evaluator(robot, scene, limits);
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  return SampledFeasibility(evaluator, period).Check(walk, {0.0, walk.duration()}, &scratch);
}

// One fast step of the right foot, from behind the left one to before it.
struct FastStep {
  RobotModel robot = Hrp2();
  double y = 0.5 * robot.standing_width;
  HalfStepSequence sequence = MakeSequence(
      {Foothold::Level({0, y, 0}), Foothold::Level({-0.12, -y, 0})},
      {{.side = Side::kRight,
        .X_WF = Foothold::Level({0.12, -y, 0}),
        .via_height = 0.12,
        .duration = 0.8}},
      0.24, {.shift = 0.1, .foot_delay = 0.05}, std::make_shared<Lipm>(robot.com_height));
  SuperposedWalk walk{sequence, Overlapped(sequence, 0.8)};
  double middle = 0.5 * walk.duration();

  WalkState At(double t) const { return walk.At(t).value; }
};

// A plate of 0.1 mm stands across the way of the foot, beside the leg, at the height of the foot's
// middle; its inner edge is where the foot passes it on the way out.
Scene Fence(double x, double inner_y, double z) {
  const Eigen::Vector3d size(1e-4, 0.2, 0.05);
  return With(MakeBox(size), ToIsometry({x, inner_y - 0.5 * size.y(), 0}, z));
}

TEST(CertifiedFeasibility, RefusesTheFenceThatSamplingEvery15MsMisses) {
  const FastStep step;
  const MarginLimits limits = ObstaclesOnly();
  const WalkJet jet = step.walk.At(step.middle);
  const double z = jet.value[kRightZ] + 0.02;
  const auto check = [&](const Scene& scene, double period) {
    return Sampled(step.robot, scene, limits, step.walk, period);
  };
  const auto violated = [&](const Scene& scene, double period) {
    return check(scene, period).verdict == Verdict::kViolated;
  };
  int missed = 0;
  for (double ahead : {-0.20, -0.19, 0.19, 0.20, 0.21}) {
    // How far out the foot reaches there, by bisection; the plate stands 0.2 mm farther in, where
    // only a corner of the foot comes, for some milliseconds.
    const double x = jet.value[kRightX] + ahead;
    double hit = jet.value[kRightY], clear = jet.value[kRightY] - 0.2;
    ASSERT_TRUE(violated(Fence(x, hit, z), 1e-3));
    while (hit - clear > 5e-5) {
      const double middle = 0.5 * (hit + clear);
      (violated(Fence(x, middle, z), 1e-3) ? hit : clear) = middle;
    }
    const Scene fence = Fence(x, hit + 2e-4, z);
    const Feasibility dense = check(fence, 2.5e-4);
    ASSERT_EQ(dense.verdict, Verdict::kViolated);
    const Feasibility certified = Certified(step.robot, fence, limits, step.walk);
    EXPECT_EQ(certified.verdict, Verdict::kViolated) << ahead;
    const Eigen::Vector2d velocity = step.walk.At(dense.witness.t).first.segment<2>(kRightX);
    missed += velocity.norm() > 0.8 && !violated(fence, 0.015);
  }
  EXPECT_GE(missed, 1);
}

TEST(CertifiedFeasibility, FindsSmallObstaclesInsideWhatABodySweeps) {
  const FastStep step;
  const MarginLimits limits = ObstaclesOnly();
  const WalkState mid = step.At(step.middle), begin = step.At(0.0);
  const double waist = step.robot.waist_height;
  const Pose2 X_WC{begin[kComX], begin[kComY], begin[kWaistYaw]};
  struct Case {
    const char* what;
    Eigen::Isometry3d X_WO;
  };
  for (const Case& c : std::array<Case, 4>{
           {{"in the foot on its way",
             ToIsometry(FootPose(mid, Side::kRight), mid[kRightZ] + 0.03)},
            {"in the foot at rest", ToIsometry(FootPose(begin, Side::kRight), 0.03)},
            {"in the support foot", ToIsometry(FootPose(begin, Side::kLeft), 0.03)},
            {"in the waist", ToIsometry(X_WC * Pose2{-step.robot.com_x_B, 0, 0}, waist)}}}) {
    const Scene scene = With(MakeSphere(0.0025), c.X_WO);
    EXPECT_EQ(Certified(step.robot, scene, limits, step.walk).verdict, Verdict::kViolated)
        << c.what;
  }
  const Scene beside = With(MakeSphere(0.0025), ToIsometry({0.0, -1.0, 0.0}, 0.03));
  EXPECT_EQ(Certified(step.robot, beside, limits, step.walk).verdict, Verdict::kFeasible);
}

TEST(CertifiedFeasibility, IsNeverContradictedBySampling) {
  const RobotModel robot = Hrp2();
  WalkDraw draw(11);
  int certified = 0, walks = 0;
  while (walks < Draws(40)) {
    const SceneKind kind = static_cast<SceneKind>(walks % 3);
    const bool at_limit = walks % 2 == 0;
    const auto drawn = DrawNearLimit(robot, kind, {}, at_limit ? 0.0 : 0.1, &draw);
    if (!drawn) continue;
    ++walks;
    const SuperposedWalk walk(drawn->sequence, drawn->parameters);
    const Verdict verdict = Certified(robot, drawn->scene, {}, walk).verdict;
    const double period = kFewDraws ? 1e-2 : 1e-3;
    const Verdict sampled = Sampled(robot, drawn->scene, {}, walk, period).verdict;
    certified += verdict == Verdict::kFeasible;
    if (verdict == Verdict::kFeasible) {
      EXPECT_EQ(sampled, Verdict::kFeasible) << walks;
    }
    if (!at_limit) {  // 1 mm to spare is enough
      EXPECT_EQ(verdict, Verdict::kFeasible) << walks;
    }
  }
  EXPECT_GE(certified, walks / 2);
}

// Every statement of every family holds at every instant, by rows that say so.
TEST(CertifiedFeasibility, CertificateCoversTheWholeWalk) {
  const RobotModel robot = Hrp2();
  WalkDraw draw(12);
  const MarginLimits limits;
  int walks = 0;
  while (walks < Draws(10)) {
    const auto drawn = DrawNearLimit(robot, SceneKind::kClutter, limits, 0.1, &draw);
    if (!drawn) continue;
    ++walks;
    const SuperposedWalk walk(drawn->sequence, drawn->parameters);
    const MarginEvaluator evaluator(robot, drawn->scene, limits);
    const CertifiedFeasibility test(evaluator, {});
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    Certificate certificate;
    ASSERT_EQ(test.Certify(walk, &scratch, &certificate).verdict, Verdict::kFeasible);
    std::set<double> ends = {0.0, walk.duration()};
    for (const CertificateRow& row : certificate) {
      ASSERT_LT(row.begin, row.end);
      ASSERT_TRUE(row.bound > 0.0 || std::isinf(row.margin.value));  // room for rounding
      ASSERT_GE(row.margin.value - row.bound, limits.demanded_of(row.family))
          << Name(row.family) << " in [" << row.begin << ", " << row.end << "]";
      ends.insert({row.begin, row.end});
    }
    ASSERT_EQ(*ends.begin(), 0.0);
    ASSERT_EQ(*ends.rbegin(), walk.duration());
    for (auto next = ends.begin(), end = next++; next != ends.end(); end = next++) {
      std::array<int, kNumMarginFamilies> counts{};
      for (const CertificateRow& row : certificate) {
        if (row.begin <= *end && *next <= row.end) {
          counts[static_cast<size_t>(row.family)] += row.count;
        }
      }
      for (const MarginFamily family : test.evaluator().families()) {
        ASSERT_EQ(counts[static_cast<size_t>(family)], test.CountOf(family)) << Name(family);
      }
    }
  }
}

// Also one that would be certified, or violated at once.
TEST(CertifiedFeasibility, StoppedIsUndecided) {
  const FastStep step;
  MarginLimits violated;
  violated.demanded.fill(100.0);
  for (const MarginLimits& limits : {ObstaclesOnly(), violated}) {
    const MarginEvaluator evaluator(step.robot, {}, limits);
    const CertifiedFeasibility test(evaluator, {});
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    Certificate certificate;
    std::stop_source source;
    const Feasibility whole = test.Certify(step.walk, &scratch, &certificate, source.get_token());
    EXPECT_NE(whole.verdict, Verdict::kUndecided);
    EXPECT_FALSE(whole.stopped);
    source.request_stop();
    const Feasibility stopped = test.Certify(step.walk, &scratch, &certificate, source.get_token());
    EXPECT_EQ(stopped.verdict, Verdict::kUndecided);
    EXPECT_TRUE(stopped.stopped);
    EXPECT_TRUE(certificate.empty());
  }
}

// What the dichotomy accepted span by span holds for the walk as a whole.
TEST(CertifiedFeasibility, DichotomyEndsCertified) {
  const RobotModel robot = Hrp2();
  WalkDraw draw(13);
  int walks = 0;
  while (walks < Draws(10)) {
    const auto drawn = DrawNearLimit(robot, SceneKind::kCylinders, {}, 0.1, &draw);
    if (!drawn) continue;
    ++walks;
    const MarginEvaluator evaluator(robot, drawn->scene, {});
    const CertifiedFeasibility test(evaluator, {});
    const SmoothingResult result = Smoothed(Dichotomy, ProblemOf(drawn->sequence, test), {});
    ASSERT_EQ(result.ending, opt::Ending::kConverged);
    EXPECT_EQ(result.evidence, Evidence::kCertified);
    const SuperposedWalk walk(drawn->sequence, result.parameters);
    EXPECT_EQ(Certified(robot, drawn->scene, {}, walk).verdict, Verdict::kFeasible) << walks;
    EXPECT_EQ(Sampled(robot, drawn->scene, {}, walk, 1e-3).verdict, Verdict::kFeasible) << walks;
  }
}

// Lengths of the intervals from knot to knot of a stretch, which certification starts from.
std::vector<double> Gaps(const SuperposedWalk& walk, const TimeSpan& stretch) {
  std::vector<double> knots = KnotsInside(walk, stretch);
  knots.insert(knots.begin(), stretch.begin);
  knots.push_back(stretch.end);
  std::vector<double> gaps;
  for (size_t i = 0; i + 1 < knots.size(); ++i) {
    if (knots[i + 1] - knots[i] > 1e-9) gaps.push_back(knots[i + 1] - knots[i]);
  }
  return gaps;
}

bool StartsWith(const std::vector<double>& all, const std::vector<double>& part) {
  return part.size() <= all.size() &&
         std::equal(part.begin(), part.end(), all.begin(),
                    [](double a, double b) { return std::abs(a - b) < 1e-9; });
}

// Regression: knots move with an overlap, and the intervals beside its span are cut anew. A walk
// that was proved span by span could then be undecided as a whole.
TEST(CertifiedFeasibility, OutsideOfACheckedWindowIntervalsAreTheOldOnes) {
  const RobotModel robot = Hrp2();
  WalkDraw draw(29);
  int cut_without = 0;
  for (int i = 0; i < 50; ++i) {
    const auto drawn = DrawNearLimit(robot, SceneKind::kCylinders, {}, 0.1, &draw);
    if (!drawn) continue;
    SuperposedWalk walk(drawn->sequence, drawn->parameters);
    const int j = static_cast<int>(draw.Uniform(0, drawn->sequence.num_junctions()));
    const double overlap = drawn->parameters.overlaps[static_cast<size_t>(j)];
    walk.SetOverlap(j, 0.5 * overlap);
    const std::vector<double> old_gaps = Gaps(walk, {0.0, walk.duration()});
    walk.SetOverlap(j, overlap);
    const TimeSpan span{std::nextafter(walk.start_of(j + 1), -1.0), walk.end_of(j)};
    const auto old_before = [&](double begin) {
      return StartsWith(old_gaps, Gaps(walk, {0.0, begin}));
    };
    const auto old_after = [&](double end) {
      std::vector<double> reversed(old_gaps.rbegin(), old_gaps.rend());
      std::vector<double> after = Gaps(walk, {end, walk.duration()});
      std::reverse(after.begin(), after.end());
      return StartsWith(reversed, after);
    };
    const TimeSpan checked = ExtendedToKnots(walk, span);
    EXPECT_LE(checked.begin, span.begin);
    EXPECT_GE(checked.end, span.end);
    EXPECT_TRUE(old_before(checked.begin)) << i;
    EXPECT_TRUE(old_after(checked.end)) << i;
    cut_without += !old_before(span.begin) || !old_after(span.end);
  }
  EXPECT_GT(cut_without, 0) << "the case that this is about";
}

// Regression: a down half-step that overlaps all of the next one ends where the one after that
// begins. Its span was taken for a whole stretch, beside which nothing is cut.
TEST(CertifiedFeasibility, OnlyWholeStretchesAreCheckedAsTheyAre) {
  const HalfStepSequence sequence = WalkDraw(30).Sequence(3);
  const int j = 1;  // down → up
  HomotopyParameters parameters = PlannedMotion(sequence);
  for (double& duration : parameters.durations) duration = 2.0;
  parameters.overlaps[1] = 2.0;
  const SuperposedWalk walk(sequence, parameters);
  ASSERT_EQ(walk.end_of(j), walk.start_of(j + 2));
  const TimeSpan stretch{walk.start_of(j + 1), walk.start_of(j + 2)};
  const TimeSpan alone = ExtendedToKnots(walk, stretch);
  EXPECT_EQ(alone.begin, stretch.begin);
  EXPECT_EQ(alone.end, stretch.end);
  const TimeSpan changed{std::nextafter(stretch.begin, -1.0), stretch.end};
  EXPECT_LT(ExtendedToKnots(walk, changed).begin, stretch.begin - 1e-3);
  EXPECT_GT(ExtendedToKnots(walk, changed).end, stretch.end + 1e-3);
}

// What lies between a span and the next knots is checked as well: where an overlap's change puts
// a knot, intervals beside the span are cut anew.
TEST(CertifiedFeasibility, ChecksAWindowUpToTheKnotsAroundIt) {
  const FastStep step;
  const MarginLimits limits = ObstaclesOnly();
  const WalkState mid = step.At(step.middle);
  const Scene scene =
      With(MakeSphere(0.0025), ToIsometry(FootPose(mid, Side::kRight), mid[kRightZ] + 0.03));
  std::vector<double> knots = KnotsInside(step.walk, {0.0, step.walk.duration()});
  const auto after = std::upper_bound(knots.begin(), knots.end(), step.middle);
  ASSERT_TRUE(after != knots.begin() && after != knots.end());
  const double begin = *(after - 1), end = *after;
  const MarginEvaluator evaluator(step.robot, scene, limits);
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  for (const TimeSpan& span :
       {TimeSpan{begin + 1e-4, begin + 2e-4}, TimeSpan{end - 2e-4, end - 1e-4}}) {
    ASSERT_EQ(SampledFeasibility(evaluator, 1e-5).Check(step.walk, span, &scratch).verdict,
              Verdict::kFeasible);
    EXPECT_EQ(CertifiedFeasibility(evaluator, {}).Check(step.walk, span, &scratch).verdict,
              Verdict::kViolated);
  }
}

// At the resolution what is neither proved nor violated is undecided, however near.
TEST(CertifiedFeasibility, IsUndecidedAtACoarseResolution) {
  const FastStep step;
  MarginLimits limits = ObstaclesOnly();
  const MarginEvaluator any(step.robot, {}, limits);
  MarginEvaluator::Scratch scratch = any.MakeScratch();
  const MarginSet least = SampleMargins(any, step.walk, 1e-3, &scratch);
  limits.demanded_of(MarginFamily::kReach) =
      least[static_cast<size_t>(MarginFamily::kReach)].value - 1e-5;
  const MarginEvaluator evaluator(step.robot, {}, limits);
  const TimeSpan whole{0.0, step.walk.duration()};
  const auto verdict = [&](double resolution) {
    const CertifiedFeasibility test(evaluator, {.resolution = resolution, .longest = 0.07});
    return test.Check(step.walk, whole, &scratch).verdict;
  };
  EXPECT_EQ(verdict(0.07), Verdict::kUndecided);
  EXPECT_EQ(verdict(1e-5), Verdict::kFeasible);
}

}  // namespace
}  // namespace halfstep
