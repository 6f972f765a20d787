#include "experiments/verify/check_stop_branches.h"

#include <string_view>

namespace halfstep::verify {
namespace {

// What an acceptance ends with when stop branches were demanded.
constexpr std::string_view kOfAll = "; so is every stop branch";
constexpr std::string_view kOfDown = "; so is every stop branch after a down half-step";

}  // namespace

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
