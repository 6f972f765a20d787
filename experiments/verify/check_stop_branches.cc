#include "experiments/verify/check_stop_branches.h"

#include <string_view>

#include "experiments/verify/check_played.h"

namespace halfstep::verify {
namespace {

// What an acceptance ends with when stop branches were demanded.
constexpr std::string_view kOfAll = "; so is every stop branch";
constexpr std::string_view kOfDown = "; so is every stop branch after a down half-step";

}  // namespace

void CheckStopBranches(const DescribedWalk& walk, const StopBranchDemand& demand,
                       const CertificateText& certificate, double tolerance, Distances* distances,
                       Findings* findings) {
  if (demand.branches == "none") return;
  int kept = 0, coarse = 0;
  for (int k = 0; k + 1 < walk.num_half_steps(); ++k) {
    if (demand.branches == "down" && walk.IsUp(k)) continue;
    Findings of_branch;
    CheckStopBranch(walk, k, walk.WindowOf(k + 1).first, demand.period, certificate, tolerance,
                    distances, &of_branch);
    const std::string stopped = Formatted("stopped after half-step %d: ", k + 1);
    findings->TakeReasons(of_branch, stopped);
    if (!of_branch.too_coarse().empty()) {
      findings->TooCoarse(stopped + of_branch.too_coarse());
      ++coarse;
    } else if (of_branch.disagreements() == 0) {
      ++kept;
    }
  }
  findings->Say(Formatted("stop branches: %d keep every margin to their end", kept) +
                (coarse == 0 ? "" : Formatted(", %d are too coarse to tell", coarse)));
}

void CheckDemandOfStopBranches(const std::string& branches, const std::string& acceptance,
                               Findings* findings) {
  const std::string demanded = acceptance.ends_with(kOfDown)  ? "down"
                               : acceptance.ends_with(kOfAll) ? "all"
                                                              : "none";
  if (demanded == branches) return;
  findings->Disagree("smoothing.stop_branches: config.yaml has " + branches +
                     ", but by manifest.json's acceptance it was " + demanded);
}

}  // namespace halfstep::verify
