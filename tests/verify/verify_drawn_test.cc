// Forgeries that are drawn, over runs of three robots and over episodes, all hashes recomputed. A
// few in ctest; the whole study, with its table:
//   verify_tests --gtest_also_run_disabled_tests --gtest_filter=DrawnForgeries.DISABLED_All

#include <gmock/gmock.h>

#include <cstdio>
#include <map>
#include <memory>

#include "experiments/verify/not_examined.h"
#include "experiments/verify/verify_run.h"
#include "tests/verify/drawn_forgeries.h"
#include "tests/verify/tampered_episode.h"
#include "tests/verify/verify_mutation.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

struct Verdict {
  bool accepted = false;
  std::string why;  ///< the first reason, or why it may be accepted; "": it may not
};

// Words without numbers and places, so that reasons of one kind are one.
std::string Kind(const std::string& reason) {
  std::string kind;
  for (const char c : reason.substr(0, reason.find("; smallest"))) {
    if (c >= '0' && c <= '9') {
      if (kind.empty() || kind.back() != '#') kind += '#';
    } else if (kind.empty() || kind.back() != '#' || (c != '.' && c != '-')) {
      kind += c == '|' ? '/' : c;
    }
  }
  return kind.substr(0, 70);
}

Verdict Ask(const verify::VerifyOptions& options) {
  try {
    const verify::MethodVerification result = VerifyProved(options).front();
    if (result.verified) return {true, ""};
    if (!result.readable) return {false, "cannot be read: " + Kind(result.complaints.front())};
    return {false, Kind(result.reasons.empty() ? result.too_coarse : result.reasons.front())};
  } catch (const InputError& error) {
    return {false, "cannot be read: " + Kind(error.complaints().front())};
  }
}

// One forgery of a run or an episode, drawn.
template <typename Tampered>
Verdict TryOne(const Tampered& tampered, const fs::path& folder, const std::string& method,
               std::mt19937* random, NamedValue* value) {
  const bool run = !method.empty();
  const auto list = run ? verify::NotExaminedOfRun() : verify::NotExaminedOfEpisode();
  const std::vector<NamedValue> values = ValuesOf(folder, method);
  // Files first: the trajectory has as many columns as all others.
  std::vector<std::string> files;
  for (const NamedValue& one : values) {
    if (files.empty() || files.back() != one.file) files.push_back(one.file);
  }
  std::string what;
  while (what.empty()) {
    const std::string file = files[(*random)() % files.size()];
    do {
      *value = values[(*random)() % values.size()];
    } while (value->file != file);
    what = Forge(folder, *value, random);
  }
  tampered.Rehash();
  verify::VerifyOptions options{.run = folder.string()};
  if (run) options.method = method;
  Verdict verdict = Ask(options);
  if (!verdict.accepted) return verdict;
  const verify::NotExamined* entry = verify::FindNotExamined(list, value->file, value->name);
  if (entry != nullptr) verdict.why = std::string(entry->why);
  if (run && (value->pointer.starts_with("/methods/0/") ||
              (value->file == "summary.csv" && what.starts_with("row 1:")))) {
    verdict.why = "verify is asked about the other method";
  }
  EXPECT_FALSE(verdict.why.empty()) << value->file << " " << value->name << ": " << what;
  return verdict;
}

struct Tally {
  int tried = 0, refused = 0;
  std::map<std::string, int> refused_by, accepted;
};

std::string Counted(const std::map<std::string, int>& counts, size_t most) {
  std::vector<std::pair<int, std::string>> sorted;
  for (const auto& [text, count] : counts) sorted.emplace_back(-count, text);
  std::sort(sorted.begin(), sorted.end());
  std::string text;
  for (size_t i = 0; i < std::min(most, sorted.size()); ++i) {
    text += (i == 0 ? "" : "; ") + std::to_string(-sorted[i].first) + ": " + sorted[i].second;
  }
  return text + (sorted.size() > most ? "; …" : "");
}

std::map<std::string, Tally> Draw(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::map<std::string, Tally> table;
  const std::vector<TamperedWalk> walks = {{},
                                           {.config = "wren_six_steps", .robot = "wren"},
                                           {.config = "bison_six_steps", .robot = "bison"}};
  for (int i = 0; i < count; ++i) {
    const size_t of = random() % (walks.size() + 2);  // episodes twice as often as one robot
    NamedValue value;
    Verdict verdict;
    if (of < walks.size()) {
      const TamperedRun run(walks[of]);
      verdict = TryOne(run, run.run(), "dichotomy", &random, &value);
    } else {
      const TamperedEpisode episode;
      verdict = TryOne(episode, episode.folder(), "", &random, &value);
    }
    std::string file = value.file;
    if (file.starts_with("walks/")) file = "walks/NNN/" + file.substr(file.rfind('/') + 1);
    const std::string what = of < walks.size() ? "run of " + walks[of].robot : "episode";
    Tally& tally = table[what + ": " + file];
    ++tally.tried;
    tally.refused += !verdict.accepted;
    ++(verdict.accepted ? tally.accepted : tally.refused_by)[verdict.why];
  }
  return table;
}

TEST(DrawnForgeries, AFewAreRefusedOrOnTheList) { EXPECT_GT(Draw(12, 3).size(), 4u); }

TEST(DrawnForgeries, DISABLED_All) {
  int tried = 0, refused = 0;
  std::printf(
      "| of | tried | refused | by, most often | accepted, and why |\n|---|---|---|---|---|\n");
  for (const auto& [kind, tally] : Draw(400, 1)) {
    std::printf("| %s | %d | %d | %s | %s |\n", kind.c_str(), tally.tried, tally.refused,
                Counted(tally.refused_by, 2).c_str(), Counted(tally.accepted, 9).c_str());
    tried += tally.tried;
    refused += tally.refused;
  }
  std::printf("| all | %d | %d | | %d |\n", tried, refused, tried - refused);
  EXPECT_GE(tried, 300);
}

}  // namespace
}  // namespace halfstep
