// 05: an objective of one's own: seconds of the walk, and metres that the feet are lifted.
#include <halfstep/experiments/halfstep.h>

#include <cstdio>

#include "wpg/nth.h"

using namespace halfstep;

// The sum of the heights to which the feet are lifted [m].
class Lift : public WalkCost {
 public:
  std::string name() const override { return "lift"; }
  std::string meaning() const override { return "of the heights of the steps"; }
  std::string unit() const override { return "s/m"; }
  double Evaluate(const SuperposedWalk& walk, ParameterGradient* gradient) const override {
    double sum = 0.0;
    for (int step = 0; 2 * step < walk.num_half_steps(); ++step) {
      const double scale = Nth(walk.parameters().height_scales, step);
      const double height = walk.half_step(2 * step).via_height;  // scaled
      sum += height;
      if (gradient) gradient->push_back({{ParameterFamily::kHeightScale, step}, height / scale});
    }
    return sum;
  }
};

int main() {
  Methods methods = Methods::Standard();
  methods.AddCost(std::make_shared<Lift>());
  for (const char* weight : {"0", "5"}) {
    const ExperimentConfig config = LoadConfig((DataFolder() / "configs/bar_8cm.yaml").string(),
                                               {{"smoothing.optimizer.program", "smooth"},
                                                {"smoothing.optimizer.heights", "true"},
                                                {"smoothing.optimizer.weights.lift", weight},
                                                {"smoothing.optimizer.effort", "1"}},
                                               {methods});
    const WalkProblem problem = ProblemOf(Prepare(config));
    SmoothingMonitor monitor;
    const SmoothingResult result =
        methods.Find("halfstep/sqp").Smooth(problem, config.smoothing.options, monitor);
    const SuperposedWalk walk(problem.sequence(), result.parameters);
    std::printf("weight %s s/m: %.3f s, feet lifted by %.3f m in all\n", weight, walk.duration(),
                Lift().Evaluate(walk, nullptr));
  }
}
