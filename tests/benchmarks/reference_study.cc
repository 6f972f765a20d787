// What the references find: uniform scan, coordinate ascent, dynamic programming. Not a test.
// Run: reference_study CONFIG METHOD VARIABLES
//      METHOD: uniform, coordinate, reference; VARIABLES: o, oh, ot or oht (overlaps, heights,
//      durations)
//      reference_study run CONFIG …: the command halfstep, with the methods `coordinate` and
//      `reference`

#include <cstdio>
#include <string>

#include "experiments/commands/run_experiment.h"
#include "experiments/config/experiment.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/overlap_optimizer.h"
#include "smoothing/methods/uniform_scan.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/benchmarks/coordinate_ascent.h"
#include "tests/benchmarks/reference_search.h"
#include "tests/benchmarks/reference_smoothers.h"
#include "tests/places.h"
#include "tests/smoothing/smoothed.h"

namespace halfstep {
namespace {

SmoothingResult Smooth(const HalfStepSequence& sequence, const FeasibilityTest& test,
                       const std::string& method, bool heights, bool durations) {
  if (method == "dichotomy") return Smoothed(Dichotomy, ProblemOf(sequence, test), {});
  const UniformScanOptions scan{.heights = heights, .durations = durations};
  if (method == "uniform") return Smoothed(UniformScan, ProblemOf(sequence, test), scan);
  const ParameterChoice choice{.heights = heights, .durations = durations};
  const CoordinateAscentOptions ascent{.parameters = choice};
  if (method == "coordinate") return Smoothed(CoordinateAscent, ProblemOf(sequence, test), ascent);
  ReferenceOptions options{.parameters = choice};
  if (heights || durations) {
    options.starts.push_back(Smoothed(UniformScan, ProblemOf(sequence, test), scan).parameters);
    options.starts.push_back(
        Smoothed(CoordinateAscent, ProblemOf(sequence, test), ascent).parameters);
    OptimizerOptions optimizer;
    optimizer.program.parameters = choice;
    options.starts.push_back(
        Smoothed(OptimizeOverlaps, ProblemOf(sequence, test), optimizer).parameters);
  }
  return Smoothed(ReferenceSearch, ProblemOf(sequence, test), options);
}

void Study(const std::string& config, const std::string& method, const std::string& variables) {
  const Experiment e =
      Prepare(LoadConfig(InSources("experiments/configs/") + config + ".yaml", {}));
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, {});
  const SmoothingResult result =
      Smooth(e.sequence, test, method, variables.find('h') != std::string::npos,
             variables.find('t') != std::string::npos);
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  const SuperposedWalk walk(e.sequence, result.parameters);
  const bool certified =
      test.Check(walk, {0.0, walk.duration()}, &scratch).verdict == Verdict::kFeasible;
  std::printf("%-20s %-11s %-4s D %.4f s, %s, %s, %.1f s, %ld instants, %s\n", config.c_str(),
              method.c_str(), variables.c_str(), walk.duration(),
              certified ? "certified" : "NOT CERTIFIED", std::string(Name(result.ending)).c_str(),
              result.wall, result.work.evaluated(), result.message.c_str());
}

}  // namespace
}  // namespace halfstep

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "run") {
    halfstep::Methods methods = halfstep::Methods::Standard();
    halfstep::AddReferenceSmoothers(&methods);
    return halfstep::RunExperiment(argc, argv, {methods});
  }
  if (argc != 4) {
    std::fprintf(stderr, "usage: reference_study CONFIG METHOD VARIABLES | run CONFIG...\n");
    return 2;
  }
  halfstep::Study(argv[1], argv[2], argv[3]);
}
