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

// Six steps of HRP-2 by the model of one's own, with the ZMP of the whole robot demanded.
struct OwnModelProblem {
  Experiment e = LoadExperiment("bar_5cm");
  WalkProblem problem = [this] {
    MarginLimits limits = e.config.smoothing.limits;
    limits.demanded_of(MarginFamily::kZmpRobot) = 0.0;
    return WalkProblem(
        SixSteps(e, std::make_shared<PolynomialModel>(e.robot.com_height)),
        std::make_shared<CertifiedFeasibility>(MarginEvaluator(e.robot, Scene{}, limits),
                                               e.config.smoothing.certification));
  }();

  SmoothingResult By(const std::string& method) const {
    SmoothingMonitor monitor;
    return Methods::Standard().Find(method).Smooth(problem, e.config.smoothing.options, monitor);
  }
};

TEST(OwnModel, ItsWalksAreSmoothedAndCertifiedByTheRobotsZmp) {
  const OwnModelProblem own;
  const SmoothingResult result = own.By("dichotomy");
  EXPECT_TRUE(result.feasible) << result.message;
  EXPECT_EQ(result.evidence, Evidence::kCertified);
  EXPECT_LT(DurationOf(result.parameters), 0.5 * DurationOf(own.problem.Start()));
}

TEST(OwnModel, TheBoundOfLipmsIsNotToldOfIt) {
  const SmoothingResult result = OwnModelProblem().By("reference/lipm");
  EXPECT_EQ(result.ending, opt::Ending::kNotRun);
  EXPECT_EQ(result.message, "the half-steps' model is no LIPM");
}

}  // namespace
}  // namespace halfstep
