// The whole robot's dynamics against MuJoCo's inverse dynamics, and what joint torques and friction
// walks need. Prints the tables of notebooks-data/measurements.md, "Torques and friction". Not a
// test.
// Run: robot_torque_study inverse POSTURES [SEED [ROBOT]] | needs CONFIG DURATION... |
//      cost CONFIG...

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/replay/mujoco_model.h"
#include "smoothing/margins/slack_evaluator.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/experiments/robot_motion_at.h"
#include "tests/places.h"
#include "tests/smoothing/certificate_draws.h"
#include "tests/smoothing/robot_truth.h"
#include "tests/smoothing/smoothed.h"
#include "wpg/motion/foot_friction.h"
#include "wpg/motion/foot_loads.h"

namespace halfstep {
namespace {

constexpr double kGravity = 9.81;

void Inverse(int postures, unsigned seed, const std::string& only) {
  std::printf("%-10s %9s %12s\n", "robot", "postures", "off, at most");
  for (const WholeRobot& whole : WholeRobots()) {
    const RobotModel& robot = whole.model;
    if (!only.empty() && robot.name != only) continue;
    const std::string waist = whole.tree.urdf.links[static_cast<size_t>(whole.tree.waist)].name;
    replay::Simulation engine(
        replay::MujocoModel(robot, whole.tree, {.armature = 0.0, .principal_axes = true}), robot,
        waist);
    WalkDraw draw(seed);
    int compared = 0;
    double worst = 0;
    while (compared < postures) {
      const HalfStepSequence sequence = DrawSequence(robot, 2, {}, &draw);
      const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence));
      for (int k = 0; k < 20; ++k) {
        const WalkJet jet = walk.At(draw.Uniform(0, walk.duration()));
        Posture posture = SolvePosture(robot, jet.value);
        if (!posture.reachable || !SolveJointSpeeds(robot, jet, &posture)) continue;
        const RobotDynamics dynamics(robot, jet, posture, kGravity);
        const replay::RobotForces needed =
            engine.Needed(replay::RobotMotionAt(robot, jet, posture, dynamics));
        worst = std::max(worst, replay::OffFromEngine(needed, posture, dynamics));
        ++compared;
      }
    }
    std::printf("%-10s %9d %12.1e\n", robot.name.c_str(), compared, worst);
  }
}

// The largest |torque| of each joint of either leg, and the largest coefficient of friction, of the
// walk by dichotomy that demands nothing of them.
void Needs(const std::string& name, const std::vector<std::string>& durations) {
  std::printf("%-6s %8s", "T [s]", "D [s]");
  for (int j = 0; j < 6; ++j) std::printf("  joint %d", j);
  std::printf("  friction\n");
  for (const std::string& duration : durations) {
    const Experiment e = Prepare(LoadConfig(InSources("experiments/configs/") + name + ".yaml",
                                            {{"half_step.duration_s", duration},
                                             {"smoothing.margins.torque_n_m", "none"},
                                             {"smoothing.margins.friction", "none"}}));
    const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
    const CertifiedFeasibility proof(evaluator, {});
    const SmoothingResult smoothed = Smoothed(Dichotomy, ProblemOf(e.sequence, proof),
                                              e.config.smoothing.options.Get(DichotomyGroup()));
    const SuperposedWalk walk(e.sequence, smoothed.parameters);
    Vector6d most = Vector6d::Zero();
    double friction = 0;
    for (double t = 0; t <= walk.duration(); t += 0.001) {
      const LocalTime at = walk.Locate(t);
      const WalkJet jet = walk.At(at);
      Posture posture = SolvePosture(e.robot, jet.value);
      if (!posture.reachable || !SolveJointSpeeds(e.robot, jet, &posture)) continue;
      const RobotDynamics dynamics(e.robot, jet, posture, kGravity);
      const auto zmp = dynamics.Zmp();
      if (!zmp) continue;
      const int step = walk.StepInAir(at);
      const FootLoads loads = step >= 0 ? FootLoads::OneFoot(walk.half_step(2 * step).support)
                                        : FootLoads::BothFeet(FootPose(jet.value, Side::kLeft),
                                                              FootPose(jet.value, Side::kRight),
                                                              e.robot.sole_size, *zmp);
      for (const Side side : {Side::kLeft, Side::kRight}) {
        const Vector6d foot = loads.On(side, dynamics.contact());
        most = most.cwiseMax(LegTorques(dynamics, side, foot).cwiseAbs());
      }
      const auto needed =
          FootFriction::Of(dynamics, SupportAt(walk, at, jet.value, e.robot.sole_size));
      if (needed) friction = std::max(friction, needed->needed());
    }
    std::printf("%-6s %8.3f", duration.c_str(), walk.duration());
    for (int j = 0; j < 6; ++j) std::printf(" %8.1f", most[j]);
    std::printf("  %8.2f\n", friction);
    std::fflush(stdout);
  }
}

// Of this process's CPU, so that others on the machine matter less; the least of several times.
double LeastSeconds(const std::function<void()>& work) {
  double least = 1e9;
  for (int k = 0; k < 5; ++k) {
    const std::clock_t begin = std::clock();
    work();
    least = std::min(least, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return least;
}

// Margins at instants, certificate and rows of the program of one walk: without torque and
// friction, with torque, with friction, with both.
void Cost(const std::string& name) {
  const Experiment e = Prepare(LoadConfig(InSources("experiments/configs/") + name + ".yaml", {}));
  MarginLimits none = e.config.smoothing.limits;
  none.demanded_of(MarginFamily::kTorque) = none.demanded_of(MarginFamily::kFriction) =
      kNotDemanded;
  RobotModel robot = e.robot;
  for (Leg& leg : robot.legs) {  // where no limits are known
    for (LegJoint& joint : leg.joints) joint.max_torque = std::min(joint.max_torque, 500.0);
  }
  const MarginEvaluator evaluator(robot, e.scene, none);
  const CertifiedFeasibility proof(evaluator, {});
  const SmoothingResult smoothed = Smoothed(Dichotomy, ProblemOf(e.sequence, proof),
                                            e.config.smoothing.options.Get(DichotomyGroup()));
  const SuperposedWalk walk(e.sequence, smoothed.parameters);
  std::array<double, 2> first{};
  for (const int with : {0, 1, 2, 3}) {
    MarginLimits limits = none;
    if (with & 1) limits.demanded_of(MarginFamily::kTorque) = 0.0;
    if (with & 2) limits.demanded_of(MarginFamily::kFriction) = 0.0;
    const MarginEvaluator of = evaluator.WithLimits(limits);
    const CertifiedFeasibility certifier(of, {});
    size_t rows = 0;
    Verdict verdict = Verdict::kUndecided;
    const double certificate = LeastSeconds([&] {
      MarginEvaluator::Scratch scratch = of.MakeScratch();
      Certificate all;
      verdict = certifier.Certify(walk, &scratch, &all).verdict;
      rows = all.size();
    });
    const double program = LeastSeconds([&] {
      SlackEvaluator slacks(of, 2.0);
      InstantSlacks out;
      for (double t = 0; t < walk.duration(); t += 0.01) {
        slacks.At(walk, walk.Locate(t), {}, true, &out);
      }
    });
    if (with == 0) first = {certificate, program};
    std::printf(
        "%-22s %-18s %-10s %6zu rows  certificate %7.1f ms %5.2fx  program %7.1f ms %5.2fx\n",
        name.c_str(),
        with == 0   ? "without"
        : with == 1 ? "torque"
        : with == 2 ? "friction"
                    : "both",
        verdict == Verdict::kFeasible ? "certified" : "not", rows, 1e3 * certificate,
        certificate / first[0], 1e3 * program, program / first[1]);
  }
}

}  // namespace
}  // namespace halfstep

int main(int argc, char** argv) {
  using namespace halfstep;
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() >= 2 && words[0] == "inverse") {
    if (const std::string why = replay::WhyNoSimulation(); !why.empty()) {
      std::fprintf(stderr, "%s\n", why.c_str());
      return 1;
    }
    Inverse(std::atoi(words[1].c_str()),
            words.size() > 2 ? static_cast<unsigned>(std::atoi(words[2].c_str())) : 1,
            words.size() > 3 ? words[3] : "");
  } else if (words.size() >= 3 && words[0] == "needs") {
    Needs(words[1], {words.begin() + 2, words.end()});
  } else if (words.size() >= 2 && words[0] == "cost") {
    for (size_t i = 1; i < words.size(); ++i) Cost(words[i]);
  } else {
    std::fprintf(stderr,
                 "robot_torque_study inverse POSTURES [SEED [ROBOT]] | needs CONFIG "
                 "DURATION... | cost CONFIG...\n");
    return 2;
  }
  return 0;
}
