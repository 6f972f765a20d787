// What verify says of forged runs, all hashes recomputed. The whole study, with its table:
//   verify_tests --gtest_also_run_disabled_tests --gtest_filter=VerifyStudy.DISABLED_All

#include <gmock/gmock.h>

#include <cstdio>
#include <map>

#include "experiments/verify/verify_run.h"
#include "tests/verify/verify_study.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

// Whether the forged run is accepted.
bool IsAccepted(const StudyMutation& mutation) {
  TamperedRun run;
  mutation.forge(run);
  try {
    run.Rehash();
    const auto results = VerifyProved({.run = run.run().string(), .method = "dichotomy"});
    return results.front().verified;
  } catch (const InputError&) {
    return false;
  }
}

struct Tally {
  int tried = 0, refused = 0, accepted = 0;
  std::map<std::string, int> reasons;
};

// Tries every `stride`-th mutation; the only ones that may be accepted are harmless.
std::map<std::string, Tally> Try(size_t first, size_t stride) {
  const std::vector<StudyMutation> mutations = StudyMutations();
  std::map<std::string, Tally> table;
  for (size_t i = first; i < mutations.size(); i += stride) {
    const StudyMutation& mutation = mutations[i];
    SCOPED_TRACE(mutation.kind + ": " + mutation.name);
    Tally& tally = table[mutation.kind];
    ++tally.tried;
    bool accepted = false;
    EXPECT_NO_THROW(accepted = IsAccepted(mutation));
    if (!accepted) {
      ++tally.refused;
      continue;
    }
    ++tally.accepted;
    ++tally.reasons[mutation.harmless];
    EXPECT_FALSE(mutation.harmless.empty()) << "accepted, though the statement may be false";
  }
  return table;
}

TEST(VerifyStudy, FewOfAllForgeriesAreRefusedOrHarmless) {
  const auto table = Try(5, 29);
  EXPECT_GT(table.size(), 8u);
}

TEST(VerifyStudy, DISABLED_All) {
  Tally sum;
  std::printf(
      "| kind | tried | refused | accepted | why the statement is true |\n|---|---|---|---|---|\n");
  for (const auto& [kind, tally] : Try(0, 1)) {
    std::string why;
    for (const auto& [reason, count] : tally.reasons) {
      why += (why.empty() ? "" : "; ") + std::to_string(count) + ": " + reason;
    }
    std::printf("| %s | %d | %d | %d | %s |\n", kind.c_str(), tally.tried, tally.refused,
                tally.accepted, why.c_str());
    sum.tried += tally.tried;
    sum.refused += tally.refused;
    sum.accepted += tally.accepted;
  }
  std::printf("| all | %d | %d | %d | |\n", sum.tried, sum.refused, sum.accepted);
  EXPECT_GE(sum.tried, 400);
}

}  // namespace
}  // namespace halfstep
