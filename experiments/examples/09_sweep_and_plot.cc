// 09: the same walk at several demands, as a table that gnuplot draws:
//   09_sweep_and_plot > sweep.dat
//   gnuplot -p -e "plot 'sweep.dat' using 1:2 with linespoints"
#include <halfstep/experiments/halfstep.h>

#include <cstdio>

using namespace halfstep;

int main() {
  const Experiment experiment =
      Prepare(LoadConfig((DataFolder() / "configs/bar_8cm.yaml").string(), {}));
  const MarginEvaluator evaluator(experiment.robot, experiment.scene,
                                  experiment.config.smoothing.limits);
  std::printf("# demanded clearance [m], duration [s]\n");
  for (double clearance = 0.0; clearance <= 0.02; clearance += 0.005) {
    MarginLimits limits = evaluator.limits();
    limits.demanded_of(MarginFamily::kClearance) = clearance;
    // The robot and the scene, which take long to prepare, are shared.
    const auto test = std::make_shared<CertifiedFeasibility>(evaluator.WithLimits(limits),
                                                             CertificationOptions{});
    SmoothingMonitor monitor;
    const SmoothingResult result = Dichotomy({experiment.sequence, test}, {}, monitor);
    if (result.feasible) std::printf("%.3f %.4f\n", clearance, result.cost);
  }
}
