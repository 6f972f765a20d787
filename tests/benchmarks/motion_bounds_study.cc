// How far the motion bounds are from the truth. Prints the tables of
// notebooks-data/measurements.md, "Motion bounds". Not a test. Run: motion_bounds_study [DRAWS]

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "smoothing/margins/margin_evaluator.h"
#include "smoothing/proof/interval_statements.h"
#include "tests/smoothing/certificate_draws.h"
#include "tests/smoothing/motion_truth.h"
#include "wpg/motion/motion_bounds.h"

namespace halfstep {
namespace {

double Quantile(std::vector<double> values, double fraction) {
  if (values.empty()) return std::nan("");
  const size_t k = static_cast<size_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<long>(k), values.end());
  return values[k];
}

void PrintRatios(const char* what, const std::vector<double>& ratios) {
  std::printf("%-38s %8zu", what, ratios.size());
  for (double q : {0.05, 0.25, 0.5, 0.75, 0.95, 1.0}) std::printf(" %7.2f", Quantile(ratios, q));
  std::printf("\n");
}

// Truth against bound on random intervals of 0.1 to 200 ms. A draw is an interval and an instant of
// it; every body's outermost points are looked at.
void NeverExceeded(const std::vector<RobotModel>& robots, long draws) {
  std::printf("\n%-24s %9s %9s  largest truth - bound\n", "robot", "intervals", "bounded");
  for (size_t r = 0; r < robots.size(); ++r) {
    const RobotModel& robot = robots[r];
    const auto points = OuterPoints(robot);
    const MotionBounds bounds(robot);
    WalkDraw draw(100 + static_cast<unsigned>(r));
    std::array<double, kNumBounded> excess;
    excess.fill(-1.0);
    IntervalMotion motion;
    long drawn = 0, bounded = 0, unreached = 0;
    // Draws without a bound make no claim and do not count.
    while (bounded < draws / static_cast<long>(robots.size())) {
      const HalfStepSequence sequence =
          DrawSequence(robot, 1 + static_cast<int>(draw.Uniform(0, 3)), {}, &draw);
      const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence));
      for (int k = 0; k < 100; ++k) {
        ++drawn;
        const double length = 1e-4 * std::pow(2000.0, draw.Uniform(0, 1));
        const double begin = draw.Uniform(0.0, walk.duration() - length);
        BoundMotion(bounds, walk, begin, begin + length, &motion);
        if (!motion.bounded) continue;
        ++bounded;
        const double choice = draw.Uniform(0, 4);
        const double part = choice < 1 ? 0.0 : choice < 2 ? 1.0 : draw.Uniform(0, 1);
        unreached += !CompareWithTruth(robot, points, walk, motion, begin + part * length,
                                       [&](Bounded kind, int, double truth, double bound) {
                                         double& worst = excess[static_cast<size_t>(kind)];
                                         worst = std::max(worst, truth - bound);
                                       });
      }
    }
    std::printf("%-24s %9ld %9ld ", robot.name.c_str(), drawn, bounded);
    for (size_t kind = 0; kind < kNumBounded; ++kind) {
      std::printf(" %s %.1e;", std::string(kBoundedNames[kind]).c_str(), excess[kind]);
    }
    std::printf(" not reached %ld\n", unreached);
    std::fflush(stdout);
  }
}

// Bound against the largest displacement (and the rest) over random intervals. Where there is no
// bound it counts as infinite.
void Tightness(const RobotModel& robot, double length, bool feasible, int intervals) {
  constexpr int kInstants = 20;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const auto points = OuterPoints(robot);
  const MotionBounds bounds(robot);
  const MarginEvaluator evaluator(robot, {}, {});
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  WalkDraw draw(7);
  std::array<std::vector<double>, kNumBounded> ratios;
  std::vector<double> swing, other;
  long bounded = 0, drawn = 0;
  while (drawn < intervals) {
    const HalfStepSequence sequence = DrawSequence(robot, 2, {.stride = 0.7}, &draw);
    const SuperposedWalk walk(sequence, draw.Parameters(sequence, 0.0, 1.0));
    const double begin = draw.Uniform(0.0, walk.duration() - length);
    const LocalTime mid = walk.Locate(begin + 0.5 * length);
    if (feasible && evaluator.FirstViolation(walk, mid, &scratch)) continue;
    IntervalMotion motion;
    BoundMotion(bounds, walk, begin, begin + length, &motion);
    if (!motion.posture.reachable) continue;
    ++drawn;
    bounded += motion.bounded;
    std::array<std::vector<double>, kNumBounded> sup, most;
    for (int k = 0; k <= kInstants; ++k) {
      CompareWithTruth(robot, points, walk, motion, begin + length * k / kInstants,
                       [&](Bounded kind, int index, double truth, double bound) {
                         const size_t f = static_cast<size_t>(kind), j = static_cast<size_t>(index);
                         if (sup[f].size() <= j) {
                           sup[f].resize(j + 1, 0.0);
                           most[f].resize(j + 1, 0.0);
                         }
                         sup[f][j] = std::max(sup[f][j], truth);
                         most[f][j] = motion.bounded ? bound : kNone;
                       });
    }
    const int step = walk.StepInAir(walk.Locate(0.5 * (begin + begin + length)));
    for (size_t f = 0; f < kNumBounded; ++f) {
      for (size_t j = 0; j < sup[f].size(); ++j) {
        if (sup[f][j] < 1e-5) continue;  // at rest
        const double ratio = most[f][j] / sup[f][j];
        ratios[f].push_back(ratio);
        if (f > 0) continue;
        const int leg = robot.bodies[j].leg;
        (step >= 0 && leg == Index(walk.half_step(2 * step).swing()) ? swing : other)
            .push_back(ratio);
      }
    }
  }
  std::printf("\n%s, %.0f ms, %s: %.1f %% of %d intervals bounded\n", robot.name.c_str(),
              1e3 * length, feasible ? "feasible at the midpoint" : "any within reach",
              100.0 * static_cast<double>(bounded) / intervals, intervals);
  std::printf("%-38s %8s %7s %7s %7s %7s %7s %7s\n", "bound / true sup", "number", "5%", "25%",
              "median", "75%", "95%", "largest");
  for (size_t f = 0; f < kNumBounded; ++f) {
    PrintRatios(std::string(kBoundedNames[f]).c_str(), ratios[f]);
  }
  PrintRatios("displacement, bodies of the swing leg", swing);
  PrintRatios("displacement, other bodies", other);
  std::fflush(stdout);
}

void Bounds(long draws) {
  const std::vector<RobotModel> robots = RobotsOfAllKinds();
  for (bool feasible : {true, false}) {
    for (double length : {0.005, 0.01, 0.02, 0.05}) Tightness(robots[0], length, feasible, 3000);
  }
  for (size_t r = 1; r < robots.size(); ++r) Tightness(robots[r], 0.02, false, 1000);
  NeverExceeded(robots, draws);
  NeverExceeded(RobotsWithOffsets(), draws / 10);
}

}  // namespace
}  // namespace halfstep

int main(int argc, char** argv) { halfstep::Bounds(argc > 1 ? std::atol(argv[1]) : 1000000); }
