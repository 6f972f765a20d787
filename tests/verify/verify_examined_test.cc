// Whatever stands in a run's or an episode's folder is computed again by verify, or it is on
// verify's own list of what it does not examine: every column of every table and every key of every
// JSON.

#include <gmock/gmock.h>

#include <map>

#include "experiments/verify/not_examined.h"
#include "experiments/verify/verification_json.h"
#include "experiments/verify/verify_run.h"
#include "tests/verify/drawn_forgeries.h"
#include "tests/verify/tampered_episode.h"
#include "tests/verify/verify_mutation.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

bool IsVerified(const verify::VerifyOptions& options) {
  try {
    return VerifyProved(options).front().verified;
  } catch (const InputError&) {
    return false;
  }
}

// Puts back the files that differ from what they were.
void Restore(const fs::path& before, const fs::path& folder) {
  for (const std::string& file : FilesBelow(before)) {
    const std::string bytes = ReadText(before / file);
    if (ReadText(folder / file) != bytes) WriteText(folder / file, bytes);
  }
}

// The columns and keys of a folder by file and name: the items of a list have the same keys.
std::map<std::string, std::vector<NamedValue>> ByName(const std::vector<NamedValue>& values) {
  std::map<std::string, std::vector<NamedValue>> named;
  for (const NamedValue& value : values) named[value.file + value.name].push_back(value);
  return named;
}

// Forges a value of each name that is not on the list, by itself, and puts it back; the accepted
// ones. Of the items of a list one is drawn, as of the rows of a table.
template <typename Tampered>
std::string Accepted(const Tampered& tampered, const fs::path& folder, const std::string& method,
                     std::span<const verify::NotExamined> list, int* tried) {
  std::string accepted;
  verify::VerifyOptions options{.run = folder.string()};
  if (!method.empty()) options.method = method;
  EXPECT_TRUE(IsVerified(options)) << "before anything is forged";
  const TemporaryFolder before;
  fs::copy(folder, before.path(), fs::copy_options::recursive);
  std::vector<NamedValue> values = ValuesOf(folder, method);
  std::erase_if(values, [&](const NamedValue& value) {
    // Of raw verify is not asked.
    return (!method.empty() && value.pointer.starts_with("/methods/0/")) ||
           verify::FindNotExamined(list, value.file, value.name) != nullptr;
  });
  for (const auto& [of, alike] : ByName(values)) {
    // Its own numbers: an entry more on the list does not change how all others are forged.
    std::seed_seq seed(of.begin(), of.end());
    std::mt19937 random(seed);
    const NamedValue& value = alike[random() % alike.size()];
    std::string what = Forge(folder, value, &random);
    // Of raw verify is not asked, and its row is the first.
    while (value.file == "summary.csv" && what.starts_with("row 1:")) {
      Restore(before.path(), folder);
      what = Forge(folder, value, &random);
    }
    if (what.empty()) continue;
    ++*tried;
    tampered.Rehash();
    if (IsVerified(options)) accepted += value.file + " " + value.name + ": " + what + "\n";
    Restore(before.path(), folder);
  }
  return accepted;
}

TEST(EveryValue, OfARunIsComputedAgainOrOnTheList) {
  TamperedRun run({.overrides = {"output.period_s=0.025"}});  // few rows, little time
  // Rows of methods that verify is not asked about.
  TamperedRun::EditCsv(run.run() / "summary.csv",
                       [](TamperedRun::Table& table) { ASSERT_EQ(table.size(), 3u); });
  int tried = 0;
  EXPECT_EQ(Accepted(run, run.run(), "dichotomy", verify::NotExaminedOfRun(), &tried), "");
  EXPECT_GT(tried, 90);
}

TEST(EveryValue, OfAnEpisodeIsComputedAgainOrOnTheList) {
  const TamperedEpisode episode;
  int tried = 0;
  EXPECT_EQ(Accepted(episode, episode.folder(), "", verify::NotExaminedOfEpisode(), &tried), "");
  EXPECT_GT(tried, 60);
}

// What stands beside what is verified passes for verified.
TEST(Examined, AKeyThatVerifyDoesNotKnowIsRefused) {
  for (const char* pointer : {"/friction_of_any_floor", "/demanded/friction_of_any_floor",
                              "/limits/friction_of_any_floor"}) {
    TamperedRun run;
    run.EditJson([&](Json& json) { json[Json::json_pointer(pointer)] = 0.1; });
    run.Rehash();
    const auto results = VerifyProved({.run = run.run().string(), .method = "dichotomy"});
    EXPECT_THAT(
        results.front().reasons,
        testing::Contains(HasSubstr("friction_of_any_floor' is no key that is known here")));
  }
}

// `footsteps: false`, `zmp_shifts: false` and their like under a walk that moves them.
TEST(Examined, FormsMoveOnlyWhereTheConfigLetsThem) {
  TamperedRun run(
      {.overrides = {"smoothing.methods=[halfstep/sqp]", "smoothing.optimizer.footsteps=true",
                     "smoothing.optimizer.effort=3"}});
  const auto verified = [&] {
    return VerifyProved({.run = run.run().string(), .method = "halfstep/sqp"}).front();
  };
  EXPECT_TRUE(verified().verified) << verify::Describe(verified());
  TamperedRun::Replace(run.run() / "config.yaml", "    zmp_shifts: true", "    zmp_shifts: false");
  run.Rehash();
  EXPECT_THAT(verified().reasons,
              testing::Contains(HasSubstr("does not let it move (smoothing.optimizer.zmp_shifts: "
                                          "false)")));
}

TEST(Examined, TheListIsToldByTheCommand) {
  const TamperedRun run;
  const Outcome verbose = Halfstep(run.run(), {"verify", ".", "--verbose"});
  EXPECT_THAT(verbose.out, HasSubstr("\nNot examined:\n"));
  EXPECT_THAT(verbose.out, HasSubstr("METHOD/overlaps.csv: price_s: how it went"));
  const Outcome outcome = Halfstep(run.run(), {"verify", ".", "--json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json["methods"].size(), 2u);
  EXPECT_EQ(json["methods"][0]["verified"], true);
  EXPECT_EQ(json["not_examined"].size(), verify::NotExaminedOfRun().size());
}

}  // namespace
}  // namespace halfstep
