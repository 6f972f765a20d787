#include "smoothing/methods/search_rounds.h"

#include <algorithm>

namespace halfstep {
namespace {

constexpr double kSharpen = 1.5, kSoften = 0.75, kSharpest = 3000.0;
// Where every instant has rows of its own, from the first round on.
constexpr double kRowsSharpness = 200.0;
// Their reserve at first, of what sharpness asks for: proofs in most of a long walk succeed with
// it.
constexpr double kRowsReserve = 2.0;

}  // namespace

WatchOptions RowsFor(const opt::SolverTraits& traits, const FeasibilityTest& test, int instants,
                     const WatchOptions& given) {
  WatchOptions watch = given;
  watch.stop_branches = test.stop_branches();
  watch.row_per_instant = traits.many_rows;
  if (traits.many_rows) {
    watch.sharpness = std::max(watch.sharpness, kRowsSharpness);
    watch.instants = instants;
  }
  return watch;
}

opt::SolverOptions RoundOptions(const opt::SolverTraits& traits, ProgramKind kind, int iterations) {
  opt::SolverOptions options;
  options.max_iterations = iterations;
  options.optimality_tolerance = 1e-4;
  // Rows are nearly linear, and so is every cost but the roughness.
  if (kind != ProgramKind::kSmooth) options.solver_options = traits.nearly_linear;
  return options;
}

void ResetRows(double sharpness, double more, WatchedInstants* watched) {
  const bool by_instant = watched->row_per_instant();
  watched->SetSharpness(by_instant ? sharpness : sharpness / more);
  if (by_instant) watched->SetReserves(kRowsReserve * more);
}

void AdaptRows(bool tried, const std::vector<Margin>& refusals, WatchedInstants* watched) {
  if (watched->row_per_instant()) {
    watched->LearnReserves(tried, refusals);
    return;
  }
  const bool proved = tried && refusals.empty();
  watched->SetSharpness(std::min(kSharpest, (proved ? kSharpen : kSoften) * watched->sharpness()));
}

}  // namespace halfstep
