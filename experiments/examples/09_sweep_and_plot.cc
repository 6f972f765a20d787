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
  std::printf("# demanded distance of the ZMP inside the support [m], duration [s]\n");
  for (const double demanded : {0.01, 0.03, 0.04, 0.045, 0.05, 0.055}) {
    MarginLimits limits = evaluator.limits();
    limits.demanded_of(MarginFamily::kZmp) = demanded;
    // The robot and the scene, which take long to prepare, are shared.
    const auto test = std::make_shared<CertifiedFeasibility>(evaluator.WithLimits(limits),
                                                             CertificationOptions{});
    SmoothingMonitor monitor;
    const SmoothingResult result = Dichotomy({experiment.sequence, test}, {}, monitor);
    if (result.feasible) std::printf("%.3f %.4f\n", demanded, result.cost);
  }
}
