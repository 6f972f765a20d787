// Derivatives of a walk in its homotopy parameters against differences.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "opt/problem/derivative_check.h"
#include "smoothing/walk/superposed_walk.h"
#include "tests/smoothing/test_walks.h"
#include "wpg/motion/posture.h"

namespace halfstep {
namespace {

// A random walk whose overlaps may all move both ways, and an instant away from its knots.
struct Instance {
  explicit Instance(WalkDraw* draw)
      : sequence(draw->Sequence(3)),
        parameters(draw->Parameters(sequence, 0.02, 0.98)),
        all(AllParameters(sequence)) {
    const SuperposedWalk walk(sequence, parameters);
    double t = draw->Uniform(0, walk.duration());
    while (NearKnot(walk, t, 1e-3)) t = draw->Uniform(0, walk.duration());
    // Named by a half-step under way, not always the latest.
    at = walk.Locate(t);
    const double tau = t - walk.start_of(std::max(0, at.half_step - 1));
    if (at.half_step > 0 && draw->Uniform(0, 1) < 0.5 &&
        tau < walk.tracks(at.half_step - 1).duration()) {
      at = {at.half_step - 1, tau};
    }
  }

  HomotopyParameters MovedBy(const Eigen::VectorXd& d) const {
    HomotopyParameters moved = parameters;
    for (size_t i = 0; i < all.size(); ++i) all[i].in(moved) += d[static_cast<Eigen::Index>(i)];
    return moved;
  }
  WalkJet At(const Eigen::VectorXd& d) const { return SuperposedWalk(sequence, MovedBy(d)).At(at); }
  Eigen::Index Column(const HomotopyParameter& parameter) const {
    return std::find(all.begin(), all.end(), parameter) - all.begin();
  }
  std::vector<WalkSensitivity> Sensitivities() const {
    std::vector<WalkSensitivity> out;
    SuperposedWalk(sequence, parameters).Sensitivities(at, &out);
    return out;
  }
  // Zero where a parameter is not listed.
  Eigen::MatrixXd Jacobian() const {
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(3 * kNumQuantities, size());
    for (const WalkSensitivity& s : Sensitivities())
      jacobian.col(Column(s.parameter)) = Stacked(s.jet);
    return jacobian;
  }
  Eigen::Index size() const { return static_cast<Eigen::Index>(all.size()); }

  HalfStepSequence sequence;
  HomotopyParameters parameters;
  std::vector<HomotopyParameter> all;
  LocalTime at;
};

TEST(WalkSensitivity, AgreesWithDifferencesOnUnevenGround) {
  WalkDraw draw(44, 0.15);
  int of_rises = 0;
  for (int i = 0; i < Draws(200); ++i) {
    const Instance instance(&draw);
    const auto function = [&](const Eigen::VectorXd& d) { return Stacked(instance.At(d)); };
    const Eigen::MatrixXd jacobian = instance.Jacobian();
    const DerivativeReport report =
        CheckJacobian(function, Eigen::VectorXd::Zero(instance.size()), jacobian);
    EXPECT_TRUE(report.Passed(1e-6)) << report.Describe();
    for (size_t k = 0; k < instance.all.size(); ++k) {
      const bool of_rise = Traits(instance.all[k].family).of_heights;
      of_rises += of_rise && !jacobian.col(static_cast<Eigen::Index>(k)).isZero(0.0);
    }
  }
  EXPECT_GT(of_rises, Draws(200) / 4);
}

TEST(WalkSensitivity, AgreesWithDifferencesInAllParameters) {
  WalkDraw draw(40);
  double worst = 0;
  int listed = 0;
  for (int i = 0; i < Draws(1000); ++i) {
    const Instance instance(&draw);
    const auto function = [&](const Eigen::VectorXd& d) { return Stacked(instance.At(d)); };
    const DerivativeReport report =
        CheckJacobian(function, Eigen::VectorXd::Zero(instance.size()), instance.Jacobian());
    worst = std::max(worst, report.worst_error);
    EXPECT_TRUE(report.Passed(1e-6)) << report.Describe();
    listed += static_cast<int>(instance.Sensitivities().size());
  }
  // Some parameters matter at each instant, by far not all.
  EXPECT_GT(listed, Draws(1000) * 2);
  EXPECT_LT(listed, Draws(1000) * 20);
  RecordProperty("worst_1e12", static_cast<int>(1e12 * worst));
}

TEST(WalkSensitivity, ParametersNotListedChangeNothing) {
  WalkDraw draw(41);
  int unlisted = 0;
  for (int i = 0; i < Draws(300); ++i) {
    const Instance instance(&draw);
    std::vector<bool> is_listed(instance.all.size(), false);
    for (const WalkSensitivity& s : instance.Sensitivities()) {
      const size_t column = static_cast<size_t>(instance.Column(s.parameter));
      EXPECT_FALSE(is_listed.at(column)) << "listed twice";
      is_listed[column] = true;
    }
    const Eigen::VectorXd here = Stacked(instance.At(Eigen::VectorXd::Zero(instance.size())));
    for (Eigen::Index j = 0; j < instance.size(); ++j) {
      if (is_listed[static_cast<size_t>(j)]) continue;
      ++unlisted;
      const Eigen::VectorXd d = 1e-4 * Eigen::VectorXd::Unit(instance.size(), j);
      EXPECT_LT((Stacked(instance.At(d)) - here).cwiseAbs().maxCoeff(),
                1e-12 * (1 + here.cwiseAbs().maxCoeff()));
    }
  }
  EXPECT_GT(unlisted, Draws(300));
}

TEST(WalkSensitivity, OnePercentOrASignInOneEntryIsCaught) {
  WalkDraw draw(42);
  int broken = 0;
  for (int i = 0; i < Draws(50); ++i) {
    const Instance instance(&draw);
    const auto function = [&](const Eigen::VectorXd& d) { return Stacked(instance.At(d)); };
    const Eigen::MatrixXd jacobian = instance.Jacobian();
    Eigen::Index row, column;
    // One entry that is neither the largest nor negligible.
    const Eigen::MatrixXd size = jacobian.cwiseAbs();
    (size.array() < 0.01).select(1e9, size).minCoeff(&row, &column);
    if (size(row, column) < 0.01) continue;
    for (double factor : {1.01, -1.0}) {
      Eigen::MatrixXd wrong = jacobian;
      wrong(row, column) *= factor;
      const auto report = CheckJacobian(function, Eigen::VectorXd::Zero(instance.size()), wrong);
      EXPECT_FALSE(report.Passed(1e-6)) << report.Describe();
      EXPECT_EQ(report.row, row);
      EXPECT_EQ(report.column, column);
      ++broken;
    }
  }
  EXPECT_GT(broken, Draws(50));
}

TEST(WalkSensitivity, AtTheNaturalBoundsOneSidedDifferencesAgree) {
  // Overlaps at 0 or at their bounds, as the dichotomy leaves them: derivatives stay finite and
  // agree with a step inwards.
  WalkDraw draw(43);
  for (int i = 0; i < Draws(200); ++i) {
    const HalfStepSequence sequence = draw.Sequence(3);
    const HomotopyParameters parameters = draw.ExtremeParameters(sequence);
    const SuperposedWalk walk(sequence, parameters);
    const double t = draw.Uniform(0, walk.duration());
    if (NearKnot(walk, t, 1e-3)) continue;
    const LocalTime at = walk.Locate(t);
    std::vector<WalkSensitivity> sensitivities;
    walk.Sensitivities(at, &sensitivities);
    for (const WalkSensitivity& s : sensitivities) {
      EXPECT_TRUE(Stacked(s.jet).allFinite());
      if (s.parameter.family != HomotopyParameter::Family::kOverlap) continue;
      const double overlap = parameters.overlaps[static_cast<size_t>(s.parameter.index)];
      const double h = overlap > 1e-3 ? -1e-6 : 1e-6;
      HomotopyParameters moved = parameters;
      s.parameter.in(moved) += h;
      const WalkJet there = SuperposedWalk(sequence, moved).At(at), here = walk.At(at);
      EXPECT_LT(((there.value - here.value) / h - s.jet.value).cwiseAbs().maxCoeff(), 1e-4);
      EXPECT_LT(((there.first - here.first) / h - s.jet.first).cwiseAbs().maxCoeff(), 1e-2);
    }
  }
}

TEST(WalkSensitivity, JointAnglesThroughTheInverseKinematics) {
  const RobotModel robot = Hrp2();
  WalkDraw draw(44);
  double worst = 0;
  int checked = 0;
  for (int i = 0; i < Draws(400); ++i) {
    Instance instance(&draw);
    const Posture posture =
        SolvePosture(robot, instance.At(Eigen::VectorXd::Zero(instance.size())).value);
    // Differences need room up to the stretched knee.
    if (!posture.reachable || posture.ik[0].reach_margin < 0.01 ||
        posture.ik[1].reach_margin < 0.01) {
      continue;
    }
    ++checked;
    const auto function = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
      const Posture moved = SolvePosture(robot, instance.At(d).value);
      Eigen::VectorXd q(12);
      q << moved.ik[0].q, moved.ik[1].q;
      return q;
    };
    // q's derivative is linear in that of the walk, so speeds of a walk that moves like it.
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(12, instance.size());
    for (const WalkSensitivity& s : instance.Sensitivities()) {
      Posture copy = posture;
      WalkJet jet;
      jet.first = s.jet.value;
      ASSERT_TRUE(SolveJointSpeeds(robot, jet, &copy));
      jacobian.col(instance.Column(s.parameter)) << copy.speeds[0], copy.speeds[1];
    }
    const auto report = CheckJacobian(function, Eigen::VectorXd::Zero(instance.size()), jacobian);
    worst = std::max(worst, report.worst_error);
    EXPECT_TRUE(report.Passed(1e-6)) << report.Describe();
  }
  EXPECT_GT(checked, Draws(100));
  RecordProperty("worst_1e12", static_cast<int>(1e12 * worst));
}

}  // namespace
}  // namespace halfstep
