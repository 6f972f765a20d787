// Asks the project about nasty walks and scenes and judges every answer by the oracle. Prints the
// tables of tests/oracle/README.md; exit status 1 when an answer was false.
// Run: oracle_study [WALKS [SEED [ROBOT|all|unequal|offset [KIND|flat|levels [FILE]]]]]
// unequal: each walk has a robot of its own whose legs differ (unequal_legs.h); offset: and their
// axes miss each other.
// FILE gets a line for each walk. Walks that it has are not judged again, and the tables are of all
// its lines: a study that was stopped goes on, and seeds add up.

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/oracle/judge.h"
#include "tests/oracle/project_side.h"
#include "tests/oracle/unequal_legs.h"
#include "tests/temporary_folder.h"

namespace halfstep::oracle {
namespace {

void PrintRow(const char* name, const Tally& t) {
  std::printf("| %-16s | %5ld | %4ld | %6ld | %6ld | %5ld | %6ld | %ld | %ld |\n", name, t.walks,
              t.refused, t.certified, t.violated, t.undecided, t.judged, t.false_certified,
              t.false_violated);
}

void PrintFamilies(const Tally& all) {
  std::printf(
      "| family | statements | pushed to its limit | least spare [unit] | falsified, found | "
      "largest disagreement [unit] | unit |\n|---|---|---|---|---|---|---|\n");
  for (const MarginFamily family : AllMarginFamilies()) {
    const std::string name(Name(family));
    const auto found = all.families.find(name);
    if (found == all.families.end()) continue;
    const FamilyTally& t = found->second;
    std::printf("| %-18s | %8ld | %5ld | %9.2g | %ld, %ld | %8.2g | %s |\n", name.c_str(),
                t.statements, t.pushed, t.least_spare, t.falsified, t.found, t.disagreement,
                std::string(Unit(family)).c_str());
    std::fprintf(stderr, "%s: %s\n", name.c_str(), t.where.c_str());
  }
  std::printf(
      "| in a tube | statements | widened to its limit | least spare [unit] | falsified, found | "
      "unit |\n|---|---|---|---|---|---|\n");
  for (const MarginFamily family : AllMarginFamilies()) {
    const auto found = all.tubes.find(std::string(Name(family)));
    if (found == all.tubes.end()) continue;
    const FamilyTally& t = found->second;
    std::printf("| %-18s | %8ld | %5ld | %9.2g | %ld, %ld | %s |\n", found->first.c_str(),
                t.statements, t.pushed, t.least_spare, t.falsified, t.found,
                std::string(Unit(family)).c_str());
  }
}

// What was judged, in all.
struct Sums {
  std::array<Tally, kNumSceneKinds + kNumLevelKinds> by_kind;
  std::map<std::string, Tally> by_robot;

  void Add(const std::string& robot, int kind, const Tally& tally) {
    by_kind.at(static_cast<size_t>(kind)).Add(tally);
    by_robot[robot].Add(tally);
  }
  void Print() const {
    std::printf(
        "| scene or robot | walks | refused | certified | violated | undecided | sampled | "
        "false certified | false violated |\n|---|---|---|---|---|---|---|---|---|\n");
    Tally all;
    for (size_t kind = 0; kind < by_kind.size(); ++kind) {
      if (by_kind[kind].walks == 0) continue;
      PrintRow(NameOf(static_cast<SceneKind>(kind)), by_kind[kind]);
      all.Add(by_kind[kind]);
    }
    for (const auto& [robot, tally] : by_robot) PrintRow(robot.c_str(), tally);
    PrintRow("all", all);
    PrintFamilies(all);
    for (const std::string& line : all.missed) std::printf("not found: %s\n", line.c_str());
    std::printf("%ld instants by the oracle, %ld walks without a certified answer\n", all.instants,
                all.idle);
  }
};

// Adds the file's lines "SEED WALK ROBOT KIND TALLY"; others are remarks. Returns their names.
std::set<std::string> ReadSums(const std::string& file, Sums* sums) {
  std::set<std::string> known;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    std::string seed, walk, robot, rest;
    int kind = 0;
    words >> seed >> walk >> robot >> kind;
    std::getline(words, rest);
    known.insert(seed + " " + walk + " " + robot + " " + std::to_string(kind));
    sums->Add(robot, kind, ToTally(rest));
  }
  return known;
}

int Run(long walks, unsigned seed, const std::string& only_robot, const std::string& kinds,
        const std::string& file) {
  std::vector<std::string> names = {"hrp2", "bison", "wren"};
  if (only_robot != "all") names = {only_robot};
  const TemporaryFolder folder;
  const bool offset = only_robot == "offset", unequal = offset || only_robot == "unequal";
  if (unequal) names = {"hrp2", "bison", "wren"};
  std::vector<std::unique_ptr<Judge>> judges;
  for (std::string& name : names) {
    if (unequal) {
      name += "-" + only_robot;
    } else {
      judges.push_back(std::make_unique<Judge>(WriteJudgedRobot(name, folder.path().string())));
    }
  }
  int first = 0, count = kNumSceneKinds;
  if (kinds == "levels") {
    first = kNumSceneKinds, count = kNumLevelKinds;
  } else if (kinds != "flat") {
    first = std::atoi(kinds.c_str()), count = 1;
  }
  Sums sums;
  const std::set<std::string> known = ReadSums(file, &sums);
  std::ofstream lines(file, std::ios::app);
  std::vector<std::string> falsehoods;
  size_t told = 0;
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&begin] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  for (long w = 0; w < walks; ++w) {
    const auto robot = static_cast<size_t>(w) % names.size();
    const int kind = first + static_cast<int>(w / static_cast<long>(names.size())) % count;
    const std::string name = std::to_string(seed) + " " + std::to_string(w) + " " + names[robot] +
                             " " + std::to_string(kind);
    if (known.contains(name)) continue;
    const unsigned of_walk = seed * 1000000u + static_cast<unsigned>(w);
    const TemporaryFolder own;
    std::unique_ptr<Judge> drawn;
    if (unequal) {
      const std::string shipped = names[robot].substr(0, names[robot].find('-'));
      drawn = std::make_unique<Judge>(
          WriteUnequalRobot(shipped, {.seed = of_walk, .offset = offset}, own.path().string()));
    }
    const Judge& judge = drawn ? *drawn : *judges[robot];
    const Tally tally =
        judge.JudgeOne(static_cast<SceneKind>(kind), of_walk, folder.path().string(), &falsehoods);
    sums.Add(names[robot], kind, tally);
    for (const std::string& line : tally.missed) lines << "# not found: " << line << "\n";
    for (; told < falsehoods.size(); ++told) {
      std::printf("FALSE: %s\n", falsehoods[told].c_str());
      std::fflush(stdout);
      lines << "# FALSE: " << falsehoods[told] << "\n";
    }
    lines << name << " " << ToLine(tally) << std::endl;
    if ((w + 1) % 100 == 0) {
      std::fprintf(stderr, "%ld walks, %zu falsehoods, %.2f s a walk\n", w + 1, falsehoods.size(),
                   seconds() / static_cast<double>(w + 1));
    }
  }
  sums.Print();
  std::printf("seed %u\n", seed);
  std::fprintf(stderr, "%.0f s\n", seconds());
  return falsehoods.empty() ? 0 : 1;
}

}  // namespace
}  // namespace halfstep::oracle

int main(int argc, char** argv) {
  const long walks = argc > 1 ? std::atol(argv[1]) : 2000;
  const unsigned seed = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1;
  const std::string robot = argc > 3 ? argv[3] : "all";
  return halfstep::oracle::Run(walks, seed, robot, argc > 4 ? argv[4] : "flat",
                               argc > 5 ? argv[5] : "");
}
