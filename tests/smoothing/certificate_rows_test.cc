#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "smoothing/proof/certified_feasibility.h"
#include "smoothing/proof/interval_statements.h"
#include "tests/smoothing/certificate_draws.h"
#include "tests/smoothing/motion_truth.h"
#include "tests/wpg/joint_limits.h"

namespace halfstep {
namespace {

// What a certificate's rows say, compared with what happens inside them: a bound that is too small
// shows as a true margin below `margin − bound`; one that is too large hides others, and shows as a
// share of it that is never used.

constexpr double kRounding = 1e-9;  // of distances, which are found by iteration
constexpr double kCap = 0.5;        // [m]

// Nothing is demanded, so that every statement holds in the longest interval.
MarginLimits Undemanding() {
  MarginLimits limits;
  limits.demanded.fill(-1e4);
  limits.clearance_cap = kCap;
  limits.landing_speed = 0.3;
  return limits;
}

// Whether a family's bound is one by norms.
bool IsOfDynamics(MarginFamily family) {
  return family == MarginFamily::kZmpRobot || family == MarginFamily::kTorque ||
         family == MarginFamily::kFriction || family == MarginFamily::kJointAcceleration;
}

// By family: rows compared, and the largest (margin at the midpoint − true margin) / bound.
struct Tally {
  std::array<int, kNumMarginFamilies> rows{};
  std::array<double, kNumMarginFamilies> share{};

  void Add(const CertificateRow& row, double truth) {
    const size_t f = static_cast<size_t>(row.family);
    if (std::isinf(row.margin.value)) {  // nothing is to be watched, inside the whole interval
      EXPECT_TRUE(std::isinf(truth)) << Name(row.family) << " in [" << row.begin << ", " << row.end;
      return;
    }
    const double claimed = row.margin.value - row.bound;
    if (Unit(row.family) == "m" && claimed < 0.0) return;  // how deep an overlap is, none says
    EXPECT_GE(truth, claimed - kRounding)
        << Name(row.family) << " of " << row.margin.subject << " and " << row.margin.other
        << " in [" << row.begin << ", " << row.end << "]";
    ++rows[f];
    if (row.bound > 1e-6) share[f] = std::max(share[f], (row.margin.value - truth) / row.bound);
  }
};

// Instants strictly inside an interval: what is in the air may differ at its ends.
std::vector<double> InstantsOf(const CertificateRow& row, int count) {
  std::vector<double> instants;
  for (int k = 0; k <= count; ++k) {
    const double part = std::clamp(static_cast<double>(k) / count, 1e-9, 1.0 - 1e-9);
    instants.push_back(row.begin + part * (row.end - row.begin));
  }
  return instants;
}

HalfStepSequence DrawQuickSequence(const RobotModel& robot, WalkDraw* draw) {
  return DrawSequence(robot, 2, {.stride = 0.7, .shortest = 1.0, .longest = 1.6}, draw);
}

TEST(CertificateRows, HoldInsideWholeCertificates) {
  Tally tally;
  WalkDraw draw(41);
  int certified = 0;
  for (const RobotModel& plain : RobotsOfAllKinds()) {
    const RobotModel robot = WithAccelerationLimits(plain, 30.0);
    for (int i = 0; i < Draws(3); ++i) {
      const HalfStepSequence sequence = DrawQuickSequence(robot, &draw);
      const SuperposedWalk walk(sequence, Overlapped(sequence, draw.Uniform(0.2, 0.9)));
      const Scene scene = DrawScene(walk, static_cast<SceneKind>(i % 3), 3, &draw);
      const MarginEvaluator evaluator(robot, scene, Undemanding());
      MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
      Certificate certificate;
      const CertifiedFeasibility test(evaluator, {.longest = draw.Uniform(0.03, 0.1)});
      if (test.Certify(walk, &scratch, &certificate).verdict != Verdict::kFeasible) continue;
      ++certified;
      // Rows of one interval stand one after the other.
      for (size_t r = 0; r < certificate.size();) {
        const CertificateRow& first = certificate[r];
        size_t end = r;
        while (end < certificate.size() && certificate[end].begin == first.begin &&
               certificate[end].end == first.end) {
          ++end;
        }
        for (double t : InstantsOf(first, 3)) {
          const MarginSet truth = evaluator.At(walk, walk.Locate(t), &scratch);
          for (size_t k = r; k < end; ++k) {
            tally.Add(certificate[k], truth[static_cast<size_t>(certificate[k].family)].value);
          }
        }
        r = end;
      }
    }
  }
  EXPECT_GE(certified, Draws(6));
  for (const MarginFamily family : FamiliesWith({})) {
    // There are none; soles that stand do not move.
    if (family == MarginFamily::kNoStep || family == MarginFamily::kFoothold) continue;
    EXPECT_GT(tally.rows[static_cast<size_t>(family)], Draws(100)) << Name(family);
    if (family == MarginFamily::kDoubleSupport) continue;  // it does not change
    // So near that half a bound, or a term forgotten, would show. The legs' inertia has its bound
    // by norms, whose parts have a test of their own (LegDrift).
    const double share = kFewDraws ? 0.3 : IsOfDynamics(family) ? 0.3 : 0.7;
    EXPECT_GT(tally.share[static_cast<size_t>(family)], share) << Name(family);
  }
}

// One statement of an interval, whatever the others say.
CertificateRow RowOf(const MarginEvaluator& evaluator, const SuperposedWalk& walk, double begin,
                     double end, OpenGroups pending) {
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  Certificate rows;
  IntervalStatements(evaluator).Prove(walk, begin, end, &pending, &scratch, &rows);
  return rows.size() == 1 ? rows.front() : CertificateRow{};  // of no length: not bounded
}

// A random interval between two knots of a walk.
TimeSpan DrawInterval(const SuperposedWalk& walk, WalkDraw* draw) {
  const TimeSpan whole{0.0, walk.duration()};
  std::vector<double> knots = KnotsInside(walk, whole);
  knots.insert(knots.begin(), whole.begin);
  knots.push_back(whole.end);
  const size_t k = static_cast<size_t>(draw->Uniform(0, static_cast<double>(knots.size() - 1)));
  const double length =
      std::min(knots[k + 1] - knots[k], 3e-3 * std::pow(30.0, draw->Uniform(0, 1)));
  const double begin = draw->Uniform(knots[k], knots[k + 1] - length);
  return {begin, begin + length};
}

// A pin stands where the fastest point of a body comes to in the interval, or just beyond: the body
// moves straight towards it.
TEST(CertificateRows, HoldForEveryBodyThatMovesTowardsAnObstacle) {
  const RobotModel robot = Hrp2();
  const std::vector<Eigen::Matrix3Xd> points = OuterPoints(robot);
  const MarginLimits limits = Undemanding();
  WalkDraw draw(42);
  Tally tally;
  std::vector<double> share(robot.bodies.size(), 0.0);
  for (int i = 0; i < Draws(200); ++i) {
    const HalfStepSequence sequence = DrawQuickSequence(robot, &draw);
    const SuperposedWalk walk(sequence, Overlapped(sequence, draw.Uniform(0.2, 0.9)));
    const auto [begin, end] = DrawInterval(walk, &draw);
    const Posture mid = SolvePosture(robot, walk.At(0.5 * (begin + end)).value);
    const Posture last = SolvePosture(robot, walk.At(end).value);
    if (!mid.reachable || !last.reachable) continue;
    for (size_t b = 0; b < robot.bodies.size(); b += 1 + static_cast<size_t>(draw.Uniform(0, 3))) {
      const RobotBody& body = robot.bodies[b];
      const Eigen::Matrix3Xd moved = last.OfBody(body) * points[b] - mid.OfBody(body) * points[b];
      Eigen::Index fastest = 0;
      moved.colwise().norm().maxCoeff(&fastest);
      Obstacle pin{.name = "pin", .shape = Sphere{1e-3}};
      pin.X_WO.setIdentity();
      pin.X_WO.translation() = last.OfBody(body) * points[b].col(fastest) +
                               (0.03 + moved.col(fastest).norm()) * moved.col(fastest).normalized();
      Scene scene;
      scene.obstacles.push_back(pin);
      const MarginEvaluator evaluator(robot, scene, limits);
      const OpenGroups pending = {{MarginFamily::kClearance, static_cast<uint16_t>(b)}};
      const CertificateRow row = RowOf(evaluator, walk, begin, end, pending);
      if (row.count == 0) continue;
      MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
      for (double t : InstantsOf(row, 6)) {
        const Posture posture = SolvePosture(robot, walk.At(t).value);
        const double truth =
            evaluator.clearances().OfBody(b, posture, 0.0, kCap, &scratch.bodies).value;
        tally.Add(row, truth);
        if (row.bound > 1e-5) {
          share[b] = std::max(share[b], (row.margin.value - truth) / row.bound);
        }
      }
    }
  }
  for (size_t b = 0; b < robot.bodies.size(); ++b) {
    EXPECT_GT(share[b], kFewDraws ? 0.3 : 0.6) << robot.bodies[b].name;
  }
}

TEST(CertificateRows, HoldForEveryPairOfBodies) {
  const RobotModel robot = Hrp2();
  const MarginEvaluator evaluator(robot, {}, [] {
    MarginLimits limits = Undemanding();
    limits.clearance_cap = 3.0;
    return limits;
  }());
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  WalkDraw draw(43);
  Tally tally;
  for (int i = 0; i < Draws(150); ++i) {
    const HalfStepSequence sequence = DrawQuickSequence(robot, &draw);
    const SuperposedWalk walk(sequence, Overlapped(sequence, draw.Uniform(0.2, 0.9)));
    const auto [begin, end] = DrawInterval(walk, &draw);
    for (size_t p = static_cast<size_t>(draw.Uniform(0, 10)); p < robot.self_pairs.size();
         p += 1 + static_cast<size_t>(draw.Uniform(0, 20))) {
      const OpenGroups pending = {{MarginFamily::kSelfClearance, static_cast<uint16_t>(p)}};
      const CertificateRow row = RowOf(evaluator, walk, begin, end, pending);
      if (row.count == 0) break;
      for (double t : InstantsOf(row, 2)) {
        const Posture posture = SolvePosture(robot, walk.At(t).value);
        evaluator.clearances().Place(posture, &scratch.bodies);
        tally.Add(row, evaluator.clearances().OfPair(p, posture, 3.0, &scratch.bodies).value);
      }
    }
  }
  EXPECT_GT(tally.share[static_cast<size_t>(MarginFamily::kSelfClearance)], kFewDraws ? 0.7 : 0.9);
}

// Position and speed of each joint by itself: the others have no limits.
TEST(CertificateRows, HoldForEveryJoint) {
  WalkDraw draw(44);
  Tally tally;
  std::array<double, 12> angle{}, speed{};
  std::vector<SuperposedWalk> walks;
  for (int i = 0; i < Draws(20); ++i) {
    const HalfStepSequence sequence = DrawQuickSequence(Hrp2(), &draw);
    walks.emplace_back(sequence, Overlapped(sequence, draw.Uniform(0.2, 0.9)));
  }
  for (int joint = 0; joint < 12; ++joint) {
    RobotModel robot = Hrp2();
    for (int other = 0; other < 12; ++other) {
      if (other == joint) continue;
      LegJoint& free =
          robot.legs[static_cast<size_t>(other / 6)].joints[static_cast<size_t>(other % 6)];
      free.lower = -1e3;
      free.upper = 1e3;
      free.max_speed = 1e3;
    }
    const MarginEvaluator evaluator(robot, {}, Undemanding());
    for (const SuperposedWalk& walk : walks) {
      for (int k = 0; k < 8; ++k) {
        const auto [begin, end] = DrawInterval(walk, &draw);
        for (MarginFamily family : {MarginFamily::kJoint, MarginFamily::kJointSpeed}) {
          const CertificateRow row = RowOf(evaluator, walk, begin, end, {{family}});
          if (row.count == 0) continue;
          ASSERT_EQ(row.margin.subject, joint);
          const LegJoint& limits =
              robot.legs[static_cast<size_t>(joint / 6)].joints[static_cast<size_t>(joint % 6)];
          for (double t : InstantsOf(row, 4)) {
            const auto posture = PostureAt(robot, walk.At(t));
            ASSERT_TRUE(posture);
            const double q = posture->ik[static_cast<size_t>(joint / 6)].q[joint % 6];
            const double rate = posture->speeds[static_cast<size_t>(joint / 6)][joint % 6];
            const bool of_angle = family == MarginFamily::kJoint;
            const double truth = of_angle ? std::min(q - limits.lower, limits.upper - q)
                                          : limits.max_speed - std::abs(rate);
            tally.Add(row, truth);
            double& share = (of_angle ? angle : speed)[static_cast<size_t>(joint)];
            if (row.bound > 1e-5) {
              share = std::max(share, (row.margin.value - truth) / row.bound);
            }
          }
        }
      }
    }
  }
  for (size_t joint = 0; joint < 12; ++joint) {
    EXPECT_GT(angle[joint], kFewDraws ? 0.3 : 0.9) << joint;
    EXPECT_GT(speed[joint], kFewDraws ? 0.05 : 0.2) << joint;
  }
}

// A statement is proved when margin − bound is what is demanded, and not when it is less, though
// the margin at the midpoint be more.
TEST(CertificateRows, AreGivenWhereTheyKeepWhatIsDemandedAndOnlyThere) {
  const RobotModel robot = WithAccelerationLimits(WithTorqueLimits(Hrp2(), 300.0), 300.0);
  WalkDraw draw(45);
  std::array<int, kNumMarginFamilies> refused{};
  const auto pending_of = [&](MarginFamily family) -> OpenGroups {
    double groups = 0;
    if (family == MarginFamily::kClearance) groups = 20;
    if (family == MarginFamily::kSelfClearance) groups = 100;
    return {{family, static_cast<uint16_t>(groups > 0 ? draw.Uniform(0, groups) : 0)}};
  };
  for (int i = 0; i < Draws(100); ++i) {
    const HalfStepSequence sequence = DrawQuickSequence(robot, &draw);
    const SuperposedWalk walk(sequence, Overlapped(sequence, draw.Uniform(0.2, 0.9)));
    const Scene scene = DrawScene(walk, static_cast<SceneKind>(i % 3), 5, &draw);
    const auto [begin, end] = DrawInterval(walk, &draw);
    MarginLimits limits = Undemanding();
    const MarginEvaluator undemanding(robot, scene, limits);
    for (const MarginFamily family : FamiliesWith({})) {
      const OpenGroups pending = pending_of(family);
      const CertificateRow row = RowOf(undemanding, walk, begin, end, pending);
      // Where little changes, and where an overlap or the cap hides the margin, nothing is
      // told.
      if (row.count == 0 || row.bound < 1e-6 || row.margin.value <= 0.0) continue;
      if (Unit(family) == "m" && row.margin.value >= kCap) continue;
      limits.demanded_of(family) = row.margin.value - 1.01 * row.bound;
      EXPECT_GT(RowOf(undemanding.WithLimits(limits), walk, begin, end, pending).count, 0)
          << Name(family);
      limits.demanded_of(family) = row.margin.value - 0.5 * row.bound;
      const bool has_rates = family == MarginFamily::kZmpRobot || family == MarginFamily::kFriction;
      if (has_rates) {  // They are asked for where norms do not suffice.
        const CertificateRow tight =
            RowOf(undemanding.WithLimits(limits), walk, begin, end, pending);
        if (tight.count > 0) {
          EXPECT_LE(tight.bound, 0.5 * row.bound) << Name(family);
          limits.demanded_of(family) = row.margin.value - 0.5 * tight.bound;
        }
      }
      EXPECT_EQ(RowOf(undemanding.WithLimits(limits), walk, begin, end, pending).count, 0)
          << Name(family);
      ++refused[static_cast<size_t>(family)];
    }
  }
  for (const MarginFamily family : FamiliesWith({})) {
    // These scenes have no areas and flat ground; soles that stand do not move, so there is nothing
    // to bound.
    if (family == MarginFamily::kNoStep || family == MarginFamily::kFoothold ||
        family == MarginFamily::kDoubleSupport) {
      continue;
    }
    EXPECT_GT(refused[static_cast<size_t>(family)], Draws(10)) << Name(family);
  }
}

}  // namespace
}  // namespace halfstep
