// Whether what CrossingQuery calls free is certified: random elements of the set of a form that
// leads over a bar, at random places near bars of random heights and turns.
//   crossing_study [N [SEED [ROBOT]]]     default: 100000 half-steps, seed 1, hrp2
// Prints the figures of planner/README.md, "Over an obstacle". Exit status 1: a contradiction.
// Swept volumes from the user's cache, baked when they are not there. Not a test.

#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>

#include "experiments/config/experiment.h"
#include "experiments/run/certified_half_steps.h"
#include "experiments/run/crossing_query.h"
#include "experiments/run/ground_steps.h"
#include "experiments/run/half_step_forms.h"
#include "experiments/run/planning.h"
#include "planner/swept/swept_volume_query.h"
#include "tests/places.h"
#include "tests/planner/swept_volume_draws.h"
#include "wpg/robot/robot_measures.h"

int main(int argc, char** argv) {
  using namespace halfstep;
  const long wanted = argc > 1 ? std::atol(argv[1]) : 100000;
  SweptDraw draw(argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1);
  const std::string name = argc > 3 ? argv[3] : "hrp2";
  ExperimentConfig config =
      LoadConfig(InSources("experiments/configs/island.yaml"), {{"robot", name}});
  const RobotModel robot = LoadPlace(config).robot;
  const double leg = LegLengthOf(robot);
  const auto bar_at = [&](double height, const Foothold& at) {
    Obstacle bar{"bar", Box{{0.03 * leg, 4.0 * leg, height}}, Eigen::Isometry3d::Identity()};
    bar.X_WO.translate(Eigen::Vector3d(at.x, at.y, 0.5 * height));
    bar.X_WO.rotate(Eigen::AngleAxisd(at.yaw, Eigen::Vector3d::UnitZ()));
    return bar;
  };
  const FormOver found =
      FindFormOver(config, robot, bar_at(0.2 * leg, {}), PlacesOf(config.step_set));
  if (!found.form) {
    std::printf("%s: no form leads over it: %s\n", name.c_str(), found.missed.c_str());
    return 1;
  }
  config.half_step = *found.form;
  const BakedHalfSteps baked = BakeHalfSteps(robot, config, {});
  const SweptVolumes& volumes = *baked.cached.volumes;
  long asked = 0, by_volume = 0, by_proof = 0, wrong = 0, controls = 0, refuted = 0;
  while (asked < wanted) {
    Scene scene;
    scene.obstacles = {bar_at(leg * draw.Uniform(0.02, 0.25), Foothold::Level(draw.Floor(1.0)))};
    const SweptVolumeQuery query(volumes, robot.sole_outline, scene);
    const MarginEvaluator evaluator(robot, scene, config.smoothing.limits);
    const CertificateQuery proofs(volumes.set, evaluator, config.smoothing.certification,
                                  {MarginFamily::kClearance, MarginFamily::kNoStep});
    const ObstacleFootprint print = FootprintOf(scene.obstacles.front());
    const CrossingQuery crossing(query, proofs, volumes.set, robot.sole_outline, {print});
    const HalfStepCertifier certifier(evaluator, config.smoothing.certification);
    for (int k = 0; k < 1000 && asked < wanted; ++k, ++asked) {
      const int i = draw.Index(volumes.set.size());
      const bool down = draw.Index(2) == 0;
      const Side side = draw.AnySide();
      const Pose2 beside = draw.Floor(1.0);
      const Eigen::Vector2d p_W = scene.obstacles.front().X_WO.translation().head<2>() +
                                  0.5 * leg * Eigen::Vector2d(beside.x, beside.y);
      const Foothold X_WS = Foothold::Level({p_W.x(), p_W.y(), beside.yaw});
      const auto is_free = [&](const HalfStepQuery& of, const Foothold& at) {
        return down ? of.DownIsFree(i, side, at) : of.UpIsFree(i, side, at);
      };
      if (!is_free(crossing, X_WS)) continue;
      const bool volume = is_free(query, X_WS);
      ++(volume ? by_volume : by_proof);
      const HalfStep half_step = down ? volumes.set.Down(i, side) : volumes.set.Up(i, side);
      const auto certified = [&](const Foothold& at) {
        return certifier.Certifies(half_step, down ? at : at * volumes.set.Placement(i, side));
      };
      if (!volume || by_volume % 20 == 0) wrong += !certified(X_WS);
      if (volume) continue;
      // A control: moved across, it must be wrong now and then.
      ++controls;
      const Eigen::Vector2d off = p_W + 0.05 * leg * print.across;
      refuted += !certified(Foothold::Level({off.x(), off.y(), X_WS.yaw}));
    }
  }
  std::printf(
      "%s: %ld half-steps of %d elements: %ld free by volumes (every 20th was proved), %ld by "
      "proofs; not certified: %ld; control: of %ld moved by %.0f mm %ld are not\n",
      name.c_str(), asked, volumes.set.size(), by_volume, by_proof, wrong, controls, 50.0 * leg,
      refuted);
  return wrong == 0 ? 0 : 1;
}
