// Asks the project about nasty scenes and judges every answer by the oracle. Prints the table of
// tests/oracle/README.md; exit status 1 when an answer was false.
// Run: oracle_study [WALKS [SEED [KIND]]]

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/oracle/judge.h"
#include "tests/temporary_folder.h"

namespace halfstep::oracle {
namespace {

void PrintRow(const char* name, const Tally& t) {
  std::printf("| %-15s | %5ld | %4ld | %6ld | %6ld | %5ld | %6ld | %d | %d | %9.2g | %9.2g |\n",
              name, t.walks, t.refused, t.certified, t.violated, t.undecided, t.judged,
              static_cast<int>(t.false_certified), static_cast<int>(t.false_violated),
              t.least_clearance, t.least_slack);
}

int Run(long walks, unsigned seed, int only) {
  const TemporaryFolder folder;
  const Judge judge(HALFSTEP_SOURCE_DIR "/wpg/robots/hrp2.yaml");
  std::array<Tally, kNumSceneKinds> tallies;
  std::vector<std::string> falsehoods;
  size_t told = 0;
  const auto begin = std::chrono::steady_clock::now();
  for (long w = 0; w < walks; ++w) {
    const int kind = only >= 0 ? only : static_cast<int>(w % kNumSceneKinds);
    const unsigned its = seed * 1000000u + static_cast<unsigned>(w);
    tallies[static_cast<size_t>(kind)].Add(
        judge.JudgeOne(static_cast<SceneKind>(kind), its, folder.path().string(), &falsehoods));
    for (; told < falsehoods.size(); ++told) {
      std::printf("FALSE: %s\n", falsehoods[told].c_str());
      std::fflush(stdout);
    }
    if ((w + 1) % 100 == 0) {
      const std::chrono::duration<double> so_far = std::chrono::steady_clock::now() - begin;
      std::fprintf(stderr, "%ld walks, %zu falsehoods, %.2f s a walk\n", w + 1, falsehoods.size(),
                   so_far.count() / static_cast<double>(w + 1));
    }
  }
  std::printf(
      "| scene | walks | refused | certified | violated | undecided | sampled | "
      "false certified | false violated | least clearance over what is demanded [m] | "
      "least slack [scale] |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  Tally all;
  for (int kind = 0; kind < kNumSceneKinds; ++kind) {
    const Tally& tally = tallies[static_cast<size_t>(kind)];
    if (tally.walks == 0) continue;
    PrintRow(NameOf(static_cast<SceneKind>(kind)), tally);
    all.Add(tally);
  }
  PrintRow("all", all);
  std::printf("seed %u, %ld instants by the oracle\n", seed, all.instants);
  return falsehoods.empty() ? 0 : 1;
}

}  // namespace
}  // namespace halfstep::oracle

int main(int argc, char** argv) {
  const long walks = argc > 1 ? std::atol(argv[1]) : 2000;
  const unsigned seed = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1;
  return halfstep::oracle::Run(walks, seed, argc > 3 ? std::atoi(argv[3]) : -1);
}
