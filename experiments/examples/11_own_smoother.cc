// 11: a smoother of one's own. What it proposes is proved before it counts.
#include <halfstep/experiments/halfstep.h>

#include <cstdio>

#include "wpg/nth.h"

using namespace halfstep;

struct ScaleOptions {
  double tolerance = 0.01;  // of the part
};

void DeclareFields(Fields& fields, ScaleOptions* options) {
  fields.Number("tolerance", &options->tolerance,
                {.meaning = "the bisection of the part ends below this", .min = 1e-6, .max = 1});
}

// `smoothing.own.mine/scale` in configs, with the keys that are declared above.
const OptionGroup<ScaleOptions> kScaleGroup{"mine/scale", "of the method `mine/scale`"};

// All overlaps at once, as parts of their natural bounds: bisects the part that is feasible.
class ScaleAll : public Smoother {
 public:
  std::string name() const override { return "mine/scale"; }
  std::string meaning() const override { return "all overlaps together, bisected"; }
  std::vector<DeclaredGroup> groups() const override { return {kScaleGroup}; }
  SmoothingResult Smooth(const WalkProblem& problem, const MethodOptions& options,
                         SmoothingMonitor& monitor) const override {
    if (!monitor.BeginFeasibly(problem, problem.Start())) return monitor.Refusal();
    const double tolerance = options.Get(kScaleGroup).tolerance;
    double low = 0.0, high = 1.0;
    while (high - low > tolerance && !monitor.stopped()) {
      const double part = 0.5 * (low + high);
      HomotopyParameters candidate = problem.Start();
      for (int i = 0; i < problem.sequence().num_junctions(); ++i) {
        Nth(candidate.overlaps, i) = part * NaturalOverlapBound(candidate, i);
      }
      (monitor.Propose(candidate) ? low : high) = part;
    }
    return monitor.FinishAgainstStart(
        monitor.stopped() ? monitor.StopEnding() : opt::Ending::kConverged,
        std::to_string(100 * low) + " % of every overlap", "; nothing shorter was proved");
  }
};

int main(int argc, char** argv) {
  Methods methods = Methods::Standard();
  methods.Add(std::make_shared<ScaleAll>());
  if (argc > 1) return RunExperiment(argc, argv, {methods});  // configs may name mine/scale now
  const WalkProblem problem =
      ProblemOf(Prepare(LoadConfig((DataFolder() / "configs/bar_8cm.yaml").string(), {})));
  for (const char* method : {"mine/scale", "dichotomy"}) {
    SmoothingMonitor monitor;
    const SmoothingResult result = methods.Find(method).Smooth(problem, {}, monitor);
    std::printf("%-10s %s, %.3f s: %s\n", method, result.accepted ? "proved" : "not proved",
                result.cost, result.message.c_str());
  }
}
