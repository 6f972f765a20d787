#include "experiments/checker/prove_walk.h"

#include "experiments/checker/check_walk.h"

namespace halfstep::checker {
namespace {

verify::ProvedStatements Proved(const WalkRun& run) {
  verify::ProvedStatements proved{.statements = {}, .branches = run.branches.size()};
  for (const TrajectoryFinding& finding : CheckRun(run).findings) {
    verify::ProvedStatement one{.subject = finding.subject,
                                .proved = finding.proved,
                                .demanded = finding.demanded,
                                .least = finding.least,
                                .at = finding.at};
    for (int f = 0; f < verify::kOwn; ++f) {
      const auto family = static_cast<verify::Family>(f);
      if (KindOf(family) == finding.kind) one.family = family;
    }
    proved.statements.push_back(std::move(one));
  }
  return proved;
}

}  // namespace

verify::WalkProver ProverOfWalks() {
  return {.of_run = [](const verify::WalkToProve& of) { return Proved(RunOf(of)); },
          .of_episode = [](const verify::EpisodeToProve& of) { return Proved(RunOf(of)); }};
}

}  // namespace halfstep::checker
