// What smoothing a long walk costs. Prints the tables of notebooks-data/measurements.md, "Windows
// along long walks". Not a test.
// Run: long_walk_study METHOD VARIABLES straight|arc N[:OBSTACLES]…
//      VARIABLES: o, and h, t, s beside it for heights, durations, support points
// The walks have N half-steps of 10 cm, straight or with 5 degrees a footstep; boxes of 10 x 10 x
// 20 cm lie at random within 27 m, none nearer than 55 cm to a straight walk of 40. Times are
// processor time.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "experiments/config/experiment.h"
#include "smoothing/methods/methods.h"
#include "smoothing/methods/solver_method_options.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/places.h"
#include "tests/smoothing/smoothed.h"

namespace halfstep {
namespace {

double Processor() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Experiment LongWalk(int half_steps, bool arc) {
  Experiment e = Prepare(LoadConfig(InSources("experiments/configs/fig4_raw_sequence.yaml"), {}));
  e.config.footsteps.clear();
  Pose2 middle;
  for (int i = 1; i <= half_steps / 2; ++i) {
    FootstepConfig step;
    step.foot = i % 2 == 0 ? "left" : "right";
    middle = middle * Pose2{0.0, 0.0, arc ? 5.0 * M_PI / 180.0 : 0.0} * Pose2{0.1, 0.0, 0.0};
    step.X_WF = middle * Pose2{0.0, (i % 2 == 0 ? 0.105 : -0.105), 0.0};
    e.config.footsteps.push_back(step);
  }
  return Prepare(e.config);
}

void AddBoxes(int count, Scene* scene) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-27.0, 27.0);
  for (int i = 0; i < count;) {
    const double x = 2.0 + place(random), y = place(random);
    if (std::abs(y) < 0.55 && x > -0.6 && x < 4.6) continue;
    Obstacle box{.name = "box_" + std::to_string(i++), .shape = Box{{0.1, 0.1, 0.2}}};
    box.X_WO.translation() = Eigen::Vector3d(x, y, 0.1);
    scene->obstacles.push_back(box);
  }
}

void Study(const std::string& method, const std::string& variables, bool arc, int n,
           int obstacles) {
  Experiment e = LongWalk(n, arc);
  AddBoxes(obstacles, &e.scene);
  const CertifiedFeasibility test({e.robot, e.scene, e.config.smoothing.limits}, {});
  MethodOptions options;
  OptimizerOptions& optimizer = options.Edit(OptimizerGroup()).options;
  optimizer.effort = 1e4;
  ParameterChoice& choice = optimizer.program.parameters;
  choice = {};
  choice.heights = variables.find('h') != std::string::npos;
  choice.durations = variables.find('t') != std::string::npos;
  choice.support_points = variables.find('s') != std::string::npos;
  const double begin = Processor();
  double shortest = DurationOf(PlannedMotion(e.sequence));
  std::vector<std::pair<double, double>> gains;  // when, and how long the walk then was [s]
  SmoothingMonitor monitor({.on_incumbent = [&](const HomotopyParameters& parameters) {
    const double duration = DurationOf(parameters);
    if (!(duration < shortest - 1e-9)) return;
    shortest = duration;
    gains.emplace_back(Processor() - begin, duration);
  }});
  const SmoothingResult result =
      Methods::Standard().Find(method).Smooth(ProblemOf(e.sequence, test), options, monitor);
  const double end = Processor() - begin, D = DurationOf(result.parameters);
  const auto within = [&](double part) {
    for (const auto& [when, duration] : gains) {
      if (duration <= D * (1.0 + part)) return when;
    }
    return end;
  };
  const SuperposedWalk walk(e.sequence, result.parameters);
  MarginEvaluator::Scratch scratch = test.evaluator().MakeScratch();
  const double check = Processor();
  const bool certified = test.Check(walk, {0.0, D}, &scratch).verdict == Verdict::kFeasible;
  std::printf("%s,%s,%d,%d,%.3f,%d,%.3f,%.2f,%.2f,%.2f,%.3f,%s\n", method.c_str(),
              variables.c_str(), n, obstacles, D, certified,
              gains.empty() ? -1.0 : gains.front().first, within(0.05), within(0.01), end,
              Processor() - check, std::string(Name(result.ending)).c_str());
  std::fflush(stdout);
}

}  // namespace
}  // namespace halfstep

int main(int argc, char** argv) {
  if (argc < 5) {
    std::fprintf(stderr, "long_walk_study METHOD VARIABLES straight|arc N[:OBSTACLES]...\n");
    return 2;
  }
  std::puts(
      "method,variables,n,obstacles,duration_s,certified,first_gain_s,within_5pct_s,within_1pct_s,"
      "end_s,proof_of_the_end_s,ending");
  for (int i = 4; i < argc; ++i) {
    const std::string size = argv[i];
    const size_t colon = size.find(':');
    const int obstacles = colon == std::string::npos ? 0 : std::atoi(size.c_str() + colon + 1);
    halfstep::Study(argv[1], argv[2], std::string(argv[3]) == "arc", std::atoi(size.c_str()),
                    obstacles);
  }
}
