// Makes certificates of drawn walks wrong and asks `halfstep check` about them; the oracle says
// which are false. Exit status 1 when one of these was proved. Run: forgery_study [FORGERIES [SEED
// [hrp2|bison|wren|all|unequal|offset [flat|levels]]]]

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "tests/checker/forged_certificates.h"
#include "tests/oracle/project_side.h"
#include "tests/oracle/unequal_legs.h"
#include "tests/temporary_folder.h"

namespace halfstep::checker {
namespace {

long Sum(const std::map<std::string, ForgeryTally::Count>& counts, long ForgeryTally::Count::*of) {
  long sum = 0;
  for (const auto& [name, count] : counts) sum += count.*of;
  return sum;
}

void Print(const char* what, const std::map<std::string, ForgeryTally::Count>& counts) {
  std::printf("%s: %ld false, %ld of them proved; %ld too nearly true to tell\n", what,
              Sum(counts, &ForgeryTally::Count::wrong), Sum(counts, &ForgeryTally::Count::proved),
              Sum(counts, &ForgeryTally::Count::close));
  for (const auto& [name, count] : counts) {
    std::printf("  %-18s %6ld, %ld; %ld\n", name.c_str(), count.wrong, count.proved, count.close);
  }
}

int Run(long forgeries, unsigned seed, const std::string& only, bool levels) {
  const std::vector<std::string> shipped = {"hrp2", "bison", "wren"};
  const bool drawn_legs = only == "unequal" || only == "offset";
  const std::vector<std::string> names =
      only == "all" || drawn_legs ? shipped : std::vector<std::string>{only};
  const TemporaryFolder folder;
  std::vector<std::unique_ptr<oracle::Judge>> judges;
  for (const std::string& name : names) {
    if (drawn_legs) break;
    judges.push_back(
        std::make_unique<oracle::Judge>(oracle::WriteJudgedRobot(name, folder.path().string())));
  }
  ForgeryTally all;
  std::vector<std::string> falsehoods;
  const auto made = [&] {
    return Sum(all.raised, &ForgeryTally::Count::wrong) +
           Sum(all.nudged, &ForgeryTally::Count::wrong);
  };
  size_t told = 0;
  for (unsigned w = 0; made() < forgeries; ++w) {
    const unsigned of_walk = seed * 1000000u + w;
    const TemporaryFolder own;
    std::unique_ptr<oracle::Judge> drawn;
    if (drawn_legs) {
      drawn = std::make_unique<oracle::Judge>(oracle::WriteUnequalRobot(
          names[w % names.size()], {.seed = of_walk, .offset = only == "offset"},
          own.path().string()));
    }
    const oracle::Judge& judge = drawn ? *drawn : *judges[w % judges.size()];
    const auto k = static_cast<unsigned>(w / names.size());
    const auto kind =
        levels ? oracle::LevelKind(k)
               : static_cast<oracle::SceneKind>(k % static_cast<unsigned>(oracle::kNumSceneKinds));
    all.Add(judge.Forge(kind, of_walk, 20, own.path().string(), &falsehoods));
    for (; told < falsehoods.size(); ++told) std::printf("FALSE: %s\n", falsehoods[told].c_str());
    if (w % 20 == 0) std::fprintf(stderr, "%u walks, %ld forgeries\n", w + 1, made());
    std::fflush(stdout);
  }
  std::printf("%ld walks, %ld proved as they are, %ld times refused in words\n", all.walks,
              all.proved, all.refused);
  std::printf("control: of %ld claims that are true by 1e-6, %ld are proved\n", all.controls,
              all.proved_controls);
  Print("raised", all.raised);
  Print("nudged", all.nudged);
  return falsehoods.empty() ? 0 : 1;
}

}  // namespace
}  // namespace halfstep::checker

int main(int argc, char** argv) {
  const long forgeries = argc > 1 ? std::atol(argv[1]) : 1000;
  const unsigned seed = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1;
  const std::string robot = argc > 3 ? argv[3] : "all", kinds = argc > 4 ? argv[4] : "flat";
  return halfstep::checker::Run(forgeries, seed, robot, kinds == "levels");
}
