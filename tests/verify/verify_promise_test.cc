// An episode in which a crate does what was not declared: `halfstep live` says so by words and exit
// status, `halfstep verify` derives it by itself, and refuses a record that hides it.

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>

#include "experiments/run/exit_status.h"
#include "tests/live/small_files.h"
#include "tests/verify/verify_mutation.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;

// The small world with a crate of the height of a shin. It is carried against the walking robot.
void WriteEpisodeFiles(const fs::path& place) {
  WriteSmallWorld(place,
                  "script: [{at_s: 2, do: carry, obstacle: crate, xyz: [0.5, 0.1, 0.3], "
                  "speed_m_s: 0.8}, {at_s: 5, do: vanish, obstacle: crate}], ",
                  "crate", "[0.2, 0.2, 0.6]", "[0.5, 1.2, 0.3]");
}

struct Touched {
  Touched() {
    WriteEpisodeFiles(place.path());
    outcome = Halfstep(place.path(), {"live", "small.yaml", "--out", "one"});
    manifest = ReadText(place / "one/manifest.json");
  }
  // Verifies the folder with another manifest.
  Outcome With(const std::function<void(Json*)>& change) const {
    Json json = Json::parse(manifest);
    change(&json);
    WriteText(place / "one/manifest.json", json.dump(2) + "\n");
    Outcome changed = VerifiedHere({.run = (place / "one").string()});
    WriteText(place / "one/manifest.json", manifest);
    return changed;
  }
  const TemporaryFolder place;
  Outcome outcome;
  std::string manifest;
};

TEST(VerifyPromise, ATouchIsToldByEverythingAndNoRecordMayHideIt) {
  const Touched touched;
  EXPECT_EQ(touched.outcome.status, kFailed) << touched.outcome.err;
  EXPECT_THAT(touched.outcome.out,
              testing::AllOf(HasSubstr("the robot touched 'crate'"),
                             HasSubstr("its condition was not kept: 'crate'"),
                             HasSubstr("touched      'crate'"),
                             HasSubstr("obstacles[crate].motion.speed_m_s: 0.")));
  EXPECT_THAT(ReadText(touched.place / "one/events.csv"),
              testing::ContainsRegex("contradicted.*crate: .* m are allowed"));
  if (fs::exists(touched.place / "one/report.html")) {
    EXPECT_THAT(ReadText(touched.place / "one/report.html"),
                HasSubstr("the robot touched 'crate'"));
  }
  const Outcome verified = Halfstep(touched.place.path(), {"verify", "one"});
  EXPECT_EQ(verified.status, kSuccess) << verified.out << verified.err;
  EXPECT_THAT(verified.out,
              testing::ContainsRegex(
                  "verified .*, but not where its error and speed allow, .*'crate' \\(from "
                  ".*; the robot touched 'crate'"));

  const auto refused = [&](const std::string& reason, const std::function<void(Json*)>& change) {
    const Outcome outcome = touched.With(change);
    EXPECT_EQ(outcome.status, kNotVerified) << reason << outcome.out << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr(reason));
  };
  refused("it says nothing of 'crate', which did not keep r and v",
          [](Json* json) { (*json)["promise"]["broken"] = Json::array(); });
  refused("it does not say that the robot touches 'crate'", [](Json* json) {
    (*json)["promise"]["touched"] = Json::array();
    (*json)["promise"]["status"] = "not_kept";
  });
  refused("status: is 'kept', but it is touched",
          [](Json* json) { (*json)["promise"]["status"] = "kept"; });
  refused("judged_by is not script",
          [](Json* json) { (*json)["promise"]["judged_by"] = "measurements"; });
  for (const char* key : {"from_s", "beyond_m", "speed_m_s", "error_m"}) {
    refused(std::string("'crate': ") + key, [key](Json* json) {
      Json& value = (*json)["promise"]["broken"][0][key];
      value = value.get<double>() * 1.01;
    });
  }
  refused("'crate': covered_by", [](Json* json) {
    (*json)["promise"]["broken"][0]["covered_by"][0] = "obstacles[crate].motion.speed_m_s: 0.1";
  });
  refused("'crate': unproved_s",
          [](Json* json) { (*json)["promise"]["broken"][0]["unproved_s"] = Json::array(); });
  refused("the robot does not touch 'moon'", [](Json* json) {
    Json other = (*json)["promise"]["touched"][0];
    other["obstacle"] = "moon";
    (*json)["promise"]["touched"].push_back(other);
  });
  EXPECT_EQ(touched.With([](Json* json) { json->erase("promise"); }).status, kBadInput);
  // An event that is left out, with a hash that follows.
  const fs::path events = touched.place / "one/events.csv";
  const std::string text = ReadText(events);
  const size_t at = text.find("contradicted"), begin = text.rfind('\n', at),
               end = text.find('\n', at);
  WriteText(events, text.substr(0, begin) + text.substr(end));
  refused("rows `contradicted` of world", [&](Json* json) {
    const std::string bytes = ReadText(events);
    (*json)["files"]["events.csv"] = {{"bytes", bytes.size()}, {"sha256", Sha256(bytes)}};
  });
}

}  // namespace
}  // namespace halfstep
