// What the whole robot's ZMP costs beside the other families, and how tight its bound is. Prints
// the tables of notebooks-data/measurements.md, "The whole robot's ZMP". Not a test.
// Run: robot_zmp_study cost CONFIG... | drift [INTERVALS [SEED [ROBOT]]] |
//      replayed RUN METHOD_FOLDER

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/report/robot_zmp.h"
#include "experiments/tables/csv_reader.h"
#include "smoothing/margins/slack_evaluator.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/places.h"
#include "tests/smoothing/certificate_draws.h"
#include "tests/smoothing/smoothed.h"
#include "wpg/motion/zmp_drift.h"
#include "wpg/robot/gravity.h"

namespace halfstep {
namespace {

// Of this process's CPU, so that others on the machine matter less.
double Seconds(const std::function<void()>& work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

// The least of several times with and without the family, taken in turn, so that both meet the same
// machine.
struct Pair {
  double with = 1e9, without = 1e9;

  static Pair Of(const std::function<void()>& with, const std::function<void()>& without) {
    Pair pair;
    for (int k = 0; k < 7; ++k) {
      pair.without = std::min(pair.without, Seconds(without));
      pair.with = std::min(pair.with, Seconds(with));
    }
    return pair;
  }
};

void Cost(const std::string& name) {
  const Experiment e = Prepare(LoadConfig(InSources("experiments/configs/") + name + ".yaml", {}));
  const MarginLimits limits = e.config.smoothing.limits;
  MarginLimits without = limits;
  for (const MarginFamily family :
       {MarginFamily::kZmpRobot, MarginFamily::kTorque, MarginFamily::kFriction}) {
    without.demanded_of(family) = kNotDemanded;
  }
  const MarginEvaluator all(e.robot, e.scene, limits), some = all.WithLimits(without);
  const CertifiedFeasibility proof(all, {}), proof_without(some, {});
  const SmoothingResult smoothed = Smoothed(Dichotomy, ProblemOf(e.sequence, proof),
                                            e.config.smoothing.options.Get(DichotomyGroup()));
  const SuperposedWalk walk(e.sequence, smoothed.parameters);
  const auto sampled = [&](const MarginEvaluator& evaluator) {
    return [&] {
      MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
      for (double t = 0; t < walk.duration(); t += 0.005) {
        if (evaluator.FirstViolation(walk, walk.Locate(t), &scratch)) std::abort();
      }
    };
  };
  const auto certified = [&](const CertifiedFeasibility& test, bool rows) {
    return [&, rows] {
      MarginEvaluator::Scratch scratch = test.evaluator().MakeScratch();
      Certificate certificate;
      const Feasibility answer = rows ? test.Certify(walk, &scratch, &certificate)
                                      : test.Check(walk, {0.0, walk.duration()}, &scratch);
      if (answer.verdict != Verdict::kFeasible) std::abort();
    };
  };
  const auto sloped = [&](const MarginEvaluator& evaluator) {
    return [&] {
      SlackEvaluator slacks(evaluator, 6.0);
      InstantSlacks out;
      for (double t = 0; t < walk.duration(); t += 0.01) {
        slacks.At(walk, walk.Locate(t), {}, true, &out);
      }
    };
  };
  const auto dichotomy = [&](const CertifiedFeasibility& test) {
    return [&] {
      Smoothed(Dichotomy, ProblemOf(e.sequence, test),
               e.config.smoothing.options.Get(DichotomyGroup()));
    };
  };
  const auto print = [&](const char* what, const Pair& pair) {
    std::printf("%-14s %-34s %9.2f ms %9.2f ms %6.2f\n", name.c_str(), what, 1e3 * pair.without,
                1e3 * pair.with, pair.with / pair.without);
  };
  const auto midpoints = [&](const CertifiedFeasibility& test) {
    MarginEvaluator::Scratch scratch = test.evaluator().MakeScratch();
    if (test.Check(walk, {0.0, walk.duration()}, &scratch).verdict != Verdict::kFeasible) {
      std::abort();
    }
    return scratch.work.evaluated();
  };
  std::printf("%-14s %-34s %9ld    %9ld\n", name.c_str(), "midpoints of the verdict",
              midpoints(proof_without), midpoints(proof));
  print("margins against demands, 5 ms", Pair::Of(sampled(all), sampled(some)));
  print("verdict for all t", Pair::Of(certified(proof, false), certified(proof_without, false)));
  print("certificate with rows", Pair::Of(certified(proof, true), certified(proof_without, true)));
  print("slacks with slopes, 10 ms", Pair::Of(sloped(all), sloped(some)));
  print("dichotomy", Pair::Of(dichotomy(proof), dichotomy(proof_without)));
}

// Random intervals of random walks: how often there is a bound, how often it is exceeded, and how
// many times the largest of nine sampled changes it is.
void Drift(long intervals, unsigned seed, const std::string& name) {
  const RobotModel robot = RobotNamed(name);
  const MotionBounds bounds(robot);
  const double gravity = kGravity;
  WalkDraw draw(seed);
  constexpr double kLengths[] = {0.001, 0.003, 0.01, 0.03};
  for (const double length : kLengths) {
    long drawn = 0, moving = 0, bounded = 0, exceeded = 0, exceeded_by_rates = 0, unbounded = 0;
    std::vector<double> ratios, by_rates;
    while (drawn < intervals) {
      const HalfStepSequence sequence = DrawSequence(robot, 2, {.stride = 0.7}, &draw);
      const SuperposedWalk walk(sequence, draw.Parameters(sequence, 0.0, 0.8));
      for (int k = 0; k < 50 && drawn < intervals; ++k) {
        ++drawn;
        const double begin = draw.Uniform(0.0, walk.duration() - length);
        IntervalMotion motion;
        BoundMotion(bounds, walk, begin, begin + length, &motion);
        if (!motion.bounded) continue;
        ++moving;
        const RobotDynamics dynamics(robot, motion.jet, motion.posture, gravity);
        const auto zmp = dynamics.Zmp();
        if (!zmp) continue;
        const WalkThirds thirds = walk.ThirdRanges(begin, begin + length);
        const RobotDrift of_robot(robot, motion, thirds, dynamics, gravity);
        const ZmpDrift drift = ZmpDrift::Over(robot, motion, thirds, of_robot, dynamics, gravity);
        if (!(drift.least_push > 0)) continue;
        ++bounded;
        const double angle = draw.Uniform(0, 6.28);
        const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
        const double bound = drift.Along(direction);
        const auto rate = ContactRate::Over(robot, motion, thirds, of_robot, dynamics, gravity);
        const double bound_by_rates =
            rate ? ZmpDrift::At(*rate, dynamics.contact()[5]).Along(direction) : INFINITY;
        unbounded += !std::isfinite(bound_by_rates);
        double most = 0;
        for (int i = 0; i <= 8; ++i) {
          const WalkJet jet = walk.At(begin + length * i / 8);
          Posture posture = SolvePosture(robot, jet.value);
          if (!posture.reachable || !SolveJointSpeeds(robot, jet, &posture)) std::abort();
          const auto there = RobotDynamics(robot, jet, posture, gravity).Zmp();
          most = std::max(most, std::abs(direction.dot(*there - *zmp)));
        }
        exceeded += most > bound + 1e-9;
        exceeded_by_rates += most > bound_by_rates + 1e-9;
        if (most <= 1e-5) continue;
        ratios.push_back(bound / most);
        by_rates.push_back(bound_by_rates / most);
      }
    }
    std::printf(
        "%-12s %5.0f ms %9ld intervals, the motion bounded %9ld, the ZMP %9ld; bound / "
        "largest change:\n",
        name.c_str(), 1e3 * length, drawn, moving, bounded);
    const auto print = [](const char* what, std::vector<double>* of, long wrong) {
      std::sort(of->begin(), of->end());
      const auto at = [&](double share) {
        return of->empty()
                   ? 0.0
                   : (*of)[static_cast<size_t>(share * static_cast<double>(of->size() - 1))];
      };
      std::printf("  %-9s exceeded %ld; median %.2f, 90 %% %.2f, 99 %% %.2f\n", what, wrong,
                  at(0.5), at(0.9), at(0.99));
    };
    print("by norms", &ratios, exceeded);
    print("by rates", &by_rates, exceeded_by_rates);
    std::printf("  without a bound by rates: %ld\n", unbounded);
  }
}

// How much of what MuJoCo measures (`halfstep replay RUN --out`: replay.csv) beyond the planned ZMP
// is the ZMP of the whole robot, both seen from the sole that carries more.
void PrintReplayed(const std::string& run, const std::string& method) {
  const RobotModel robot = LoadPlace(LoadConfig(run + "/config.yaml", {})).robot;
  const CsvTable walk = ReadCsv(run + "/" + method + "/trajectory.csv"),
                 replay = ReadCsv(run + "/" + method + "/replay.csv");
  const std::vector<RobotZmp> zmps = RobotZmps(robot, walk);
  const auto column = [](const CsvTable& table, const std::string& name) {
    return table.Numbers(name);
  };
  const auto t = column(walk, "t_s"), x = column(walk, "zmp_x_m"), y = column(walk, "zmp_y_m");
  const std::vector<double> yaws[] = {column(walk, "left_foot_yaw_rad"),
                                      column(walk, "right_foot_yaw_rad")};
  const auto ends = column(replay, "t_s"), off_x = column(replay, "zmp_error_x_m"),
             off_y = column(replay, "zmp_error_y_m"), left = column(replay, "left_foot_force_n"),
             right = column(replay, "right_foot_force_n");
  double measured = 0, model = 0, rest = 0, most_measured = 0, most_model = 0, most_rest = 0;
  // Rows in which the load does not jump from sole to sole [m].
  constexpr double kNear = 0.05;
  double near_measured = 0, near_rest = 0;
  long count = 0, near = 0;
  for (size_t i = 1; i < ends.size() && ends[i] <= t.back(); ++i) {
    const double middle = 0.5 * (ends[i - 1] + ends[i]);
    const size_t row =
        static_cast<size_t>(std::upper_bound(t.begin(), t.end(), middle) - t.begin());
    const Eigen::Vector2d off(off_x[i], off_y[i]);
    if (row == 0 || row >= t.size() || !off.allFinite()) continue;
    const double part = (middle - t[row - 1]) / (t[row] - t[row - 1]);
    const Eigen::Vector2d robots = (1 - part) * zmps[row - 1].zmp + part * zmps[row].zmp,
                          planned((1 - part) * x[row - 1] + part * x[row],
                                  (1 - part) * y[row - 1] + part * y[row]);
    const double yaw = yaws[left[i] >= right[i] ? 0 : 1][row];
    const Eigen::Vector2d seen = Eigen::Rotation2Dd(-yaw) * (robots - planned);
    if (!seen.allFinite()) continue;
    ++count;
    if (off.norm() < kNear) {
      near_measured += off.squaredNorm();
      near_rest += (off - seen).squaredNorm();
      ++near;
    }
    measured += off.squaredNorm();
    model += seen.squaredNorm();
    rest += (off - seen).squaredNorm();
    most_measured = std::max(most_measured, off.norm());
    most_model = std::max(most_model, seen.norm());
    most_rest = std::max(most_rest, (off - seen).norm());
  }
  const auto rms = [&](double sum) { return 1e3 * std::sqrt(sum / static_cast<double>(count)); };
  std::printf(
      "%-28s %-14s %7.1f %7.1f %9.1f %7.1f %9.1f %7.1f %6.0f %%; %3.0f %% of rows below 50 mm: "
      "%5.1f "
      "%5.1f %6.0f %%\n",
      run.c_str(), method.c_str(), rms(measured), 1e3 * most_measured, rms(model), 1e3 * most_model,
      rms(rest), 1e3 * most_rest, 100 * (1 - rest / measured),
      100.0 * static_cast<double>(near) / static_cast<double>(count),
      1e3 * std::sqrt(near_measured / static_cast<double>(near)),
      1e3 * std::sqrt(near_rest / static_cast<double>(near)),
      100 * (1 - near_rest / near_measured));
}

}  // namespace
}  // namespace halfstep

int main(int argc, char** argv) {
  const std::string part = argc > 1 ? argv[1] : "";
  if (part == "cost" && argc > 2) {
    std::printf("%-14s %-34s %12s %12s %6s\n", "config", "", "without", "with", "ratio");
    for (int i = 2; i < argc; ++i) halfstep::Cost(argv[i]);
  } else if (part == "replayed" && argc == 4) {
    halfstep::PrintReplayed(argv[2], argv[3]);
  } else if (part == "drift") {
    halfstep::Drift(argc > 2 ? std::atol(argv[2]) : 250000,
                    argc > 3 ? static_cast<unsigned>(std::atoi(argv[3])) : 1,
                    argc > 4 ? argv[4] : "hrp2");
  } else {
    std::fprintf(stderr,
                 "usage: robot_zmp_study cost CONFIG... | drift [INTERVALS [SEED [ROBOT]]] | "
                 "replayed RUN METHOD_FOLDER\n");
    return 2;
  }
}
