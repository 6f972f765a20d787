// Configs, scenes and episodes by the names of shipped ones, in any working directory.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "experiments/commands/commands.h"
#include "experiments/config/data_folder.h"
#include "experiments/config/experiment.h"
#include "tests/experiments/child_process.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(ShippedNames, AreConfigsOfTheCommandLine) {
  const TemporaryFolder place;
  const Outcome run = Halfstep(place.path(), {"run", "fig3_two_half_steps", "--out", "run",
                                              "--quiet", "--set", "smoothing.methods=[]"});
  EXPECT_EQ(run.status, kSuccess) << run.err;
  EXPECT_THAT(ReadText(place / "run/config.yaml"), HasSubstr("name: fig3_two_half_steps\n"));
}

TEST(ShippedNames, AreScenesOfConfigs) {
  const TemporaryFolder place;
  const std::string config =
      "robot: hrp2\nscene: bar_8cm\nfootsteps: [{foot: left, x_m: 0.1, y_m: 0.085}]\n";
  const ExperimentConfig read = LoadConfig(WriteText(place / "config.yaml", config), {});
  EXPECT_EQ(LoadPlace(read).scene.name, "bar_8cm");

  // A file that is there comes first.
  WriteText(place / "bar_8cm", "name: mine\n");
  EXPECT_EQ(LoadPlace(read).scene.name, "mine");
}

TEST(ShippedNames, FilesThatAreThereComeFirst) {
  const TemporaryFolder place;
  WriteText(place / "bar_8cm", "robot: 3\n");
  const Outcome run = Halfstep(place.path(), {"run", "bar_8cm"});
  EXPECT_EQ(run.status, kBadInput);
  EXPECT_THAT(run.err, HasSubstr("bar_8cm:1:8: robot"));
}

TEST(ShippedNames, UnknownOnesHaveASuggestion) {
  const TemporaryFolder place;
  for (const std::string command : {"run", "plan", "smooth"}) {
    const Outcome run = Halfstep(place.path(), {command, "bar_8c"});
    EXPECT_EQ(run.status, kBadInput);
    EXPECT_THAT(run.err, AllOf(HasSubstr("bar_8c: no such file (did you mean 'bar_8cm'?"),
                               HasSubstr("valid: a path, or ")));
  }
  EXPECT_THAT(Halfstep(place.path(), {"live", "live_ba"}).err, HasSubstr("'live_bar'"));
  EXPECT_THAT(Halfstep(place.path(), {"sweep", "fig3_step"}).err, HasSubstr("fig3_step_length"));
  EXPECT_EQ(NamesIn(place.path()).size(), 0U);  // nothing was written
}

TEST(ShippedNames, ThoseOfAnotherCommandAreToldWithIt) {
  const TemporaryFolder place;
  EXPECT_THAT(Halfstep(place.path(), {"run", "live_bar"}).err,
              HasSubstr("live_bar: no such file (it is an episode: `halfstep live live_bar`; "));
  EXPECT_THAT(Halfstep(place.path(), {"live", "bar_8cm"}).err,
              HasSubstr("(it is a config: `halfstep run bar_8cm`; "));
}

TEST(ShippedNames, AFileThatIsMissingHasANearOne) {
  const TemporaryFolder place;
  WriteText(place / "my_walk.yaml", "");
  EXPECT_THAT(Halfstep(place.path(), {"run", "my_wlak.yaml"}).err,
              HasSubstr("my_wlak.yaml: no such file (did you mean 'my_walk.yaml'? valid: a path"));
  EXPECT_THAT(Halfstep(place.path(), {"run", "my_walk"}).err,
              HasSubstr("my_walk: no such file (did you mean 'my_walk.yaml'? valid: a path"));
  std::filesystem::create_directories(place / "runs/my_walk");
  WriteText(place / "runs/my_walk/manifest.json", "{}");
  for (const std::string command : {"verify", "report", "certify", "check", "compare"}) {
    EXPECT_THAT(Halfstep(place.path(), {command, "my_walk"}).err,
                HasSubstr(" (did you mean 'runs/my_walk'? valid: "))
        << command;
  }
}

}  // namespace
}  // namespace halfstep
