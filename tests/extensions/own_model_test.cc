// Another model of how CoM and ZMP move: everything beyond the proposal is the house's.

#include <gtest/gtest.h>

#include <cmath>

#include "opt/problem/derivative_check.h"
#include "smoothing/methods/methods.h"
#include "smoothing/methods/walk_problem.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/extensions/own_model.h"
#include "tests/scenarios/load_experiment.h"
#include "wpg/motion/half_step_tracks.h"

namespace halfstep {
namespace {

// Six steps on an empty floor, slow enough for a ZMP that overshoots by a half.
HalfStepSequence SixSteps(const Experiment& e, std::shared_ptr<const MotionModel> model) {
  std::vector<Footstep> footsteps;
  for (int i = 0; i < 6; ++i) {
    const Side side = i % 2 == 0 ? Side::kRight : Side::kLeft;
    footsteps.push_back({.side = side,
                         .X_WF = Foothold::Level({0.1 * (i + 1), Sign(side) * 0.085, 0.0}),
                         .via_height = 0.08,
                         .duration = 2.6});
  }
  const HalfStep& like = e.sequence.half_steps.front().half_step;
  return MakeSequence({Foothold::Level({0, 0.085, 0}), Foothold::Level({0, -0.085, 0})}, footsteps,
                      like.via_lateral, like.shape, std::move(model));
}

TEST(OwnModel, ProfilesHaveTheDerivativesAndBoundsThatTheySay) {
  const PolynomialModel model(0.8);
  for (const HalfStepKind kind : {HalfStepKind::kUp, HalfStepKind::kDown}) {
    HalfStep half_step{.kind = kind, .duration = 2.2, .shape = {.shift = 0.1}};
    half_step.X_SF = Foothold::Level({0.2, -0.2, 0.1});
    const HalfStepTracks tracks(half_step, model);
    for (double tau = 0.017; tau < 2.2; tau += 0.1) {
      const auto function = [&](const Eigen::VectorXd& d) {
        HalfStep moved = half_step;
        moved.duration += d[1];
        moved.shape.shift += d[2];
        const ProfileJets jets = HalfStepTracks(moved, model).Profiles(tau + d[0]);
        Eigen::VectorXd all(6);
        for (int i = 0; i < 2; ++i) {
          const ProfileJet& p = Nth(jets, i);
          all.segment<3>(3 * i) << p.value, p.first, p.second;
        }
        return all;
      };
      Eigen::MatrixXd jacobian(6, 3);
      const ProfileJets at = tracks.Profiles(tau);
      const ProfileJets by = tracks.ProfilesByShape(&HalfStepShape::shift, tau);
      for (int i = 0; i < 2; ++i) {
        const ProfileJet &p = Nth(at, i), &s = Nth(by, i);
        jacobian.middleRows<3>(3 * i) << p.first, p.value_T, s.value, p.second, p.first_T, s.first,
            p.third, p.second_T, s.second;
      }
      const DerivativeReport report = CheckJacobian(function, Eigen::Vector3d::Zero(), jacobian);
      EXPECT_TRUE(report.Passed(1e-6)) << report.Describe();
      const Range third = tracks.of(kComX).ThirdRange(tau, tau);
      EXPECT_LE(std::abs(at[kComProfile].third), third.most());
      EXPECT_LE(std::abs(at[kComProfile].second), tracks.of(kComX).SecondBound(tau, tau));
      EXPECT_LE(std::abs(at[kZmpProfile].second), tracks.of(kZmpX).SecondBound(tau, tau));
    }
  }
}

TEST(OwnModel, ItsWalksAreSmoothedAndCertifiedByTheRobotsZmp) {
  Experiment e = LoadExperiment("bar_5cm");
  e.config.smoothing.limits.demanded_of(MarginFamily::kZmpRobot) = 0.0;
  const auto test = std::make_shared<CertifiedFeasibility>(
      MarginEvaluator(e.robot, Scene{}, e.config.smoothing.limits),
      e.config.smoothing.certification);
  const WalkProblem problem(SixSteps(e, std::make_shared<PolynomialModel>(e.robot.com_height)),
                            test);
  SmoothingMonitor monitor;
  const Methods methods = Methods::Standard();
  const SmoothingResult result =
      methods.Find("dichotomy").Smooth(problem, e.config.smoothing.options, monitor);
  EXPECT_TRUE(result.feasible) << result.message;
  EXPECT_LT(DurationOf(result.parameters), 0.6 * DurationOf(problem.Start()));
  RecordProperty("duration_s", std::to_string(DurationOf(result.parameters)));
}

TEST(OwnModel, TheBoundOfLipmsIsNotToldOfIt) {
  const Experiment e = LoadExperiment("bar_5cm");
  const auto test = std::make_shared<CertifiedFeasibility>(
      MarginEvaluator(e.robot, Scene{}, e.config.smoothing.limits),
      e.config.smoothing.certification);
  const WalkProblem problem(SixSteps(e, std::make_shared<PolynomialModel>(e.robot.com_height)),
                            test);
  SmoothingMonitor monitor;
  const Methods methods = Methods::Standard();
  const SmoothingResult result =
      methods.Find("reference/lipm").Smooth(problem, e.config.smoothing.options, monitor);
  EXPECT_EQ(result.ending, opt::Ending::kNotRun);
  EXPECT_EQ(result.message, "the half-steps' model is no LIPM");
}

}  // namespace
}  // namespace halfstep
