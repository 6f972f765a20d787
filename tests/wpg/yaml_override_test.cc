#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/wpg/yaml_test_config.h"

namespace halfstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using yaml_test::ComplaintsAbout;
using yaml_test::Config;
using yaml_test::Read;

TEST(YamlOverrides, ReplaceAndInsert) {
  const Config config =
      Read("margins: {clearance_m: 0.1}\nsteps: [{x_m: 0}, {x_m: 0}]\nxyz: [1, 2, 3]",
           {{"margins.clearance_m", "0.3"},
            {"goal.x_m", "2"},
            {"steps.1.x_m", "0.5"},
            {"xyz.2", "9"},
            {"methods", "[nlopt]"},
            {"margins.clearance_m", "0.4"}});
  EXPECT_EQ(config.clearance, 0.4);
  EXPECT_TRUE(config.has_goal);
  EXPECT_EQ(config.goal_x, 2.0);
  EXPECT_EQ(config.steps[1].x, 0.5);
  EXPECT_THAT(config.xyz, ElementsAre(1.0, 2.0, 9.0));
  EXPECT_THAT(config.methods, ElementsAre("nlopt"));
}

TEST(YamlOverrides, AreCheckedAsTheFileIs) {
  const std::string text = "name: walk\nsteps: [{x_m: 0}]";
  const auto complaints = [&text](const std::string& key, const std::string& value) {
    return ComplaintsAbout(text, {{key, value}});
  };
  EXPECT_THAT(complaints("margins.clearance_m", "abc"),
              ElementsAre("--set margins.clearance_m: not a number: 'abc' (valid: 0 … 0.5 m)"));
  EXPECT_THAT(complaints("margins", "{clearance_m: 1}"),
              ElementsAre("--set margins: margins.clearance_m: 1 is out of range (valid: 0 … "
                          "0.5 m)"));
  EXPECT_THAT(complaints("margins.clearance", "0.1"),
              ElementsAre("--set margins.clearance: unknown key (did you mean 'clearance_m'? "
                          "valid: clearance_m, lean_deg)"));
  EXPECT_THAT(complaints("mragins.clearance_m", "0.1"),
              ElementsAre(HasSubstr("--set mragins.clearance_m: mragins: unknown key (did you "
                                    "mean 'margins'?")));
  EXPECT_THAT(complaints("", "1"),
              ElementsAre("--set '': an empty key (valid: dotted keys, as smoothing.method)"));
  EXPECT_THAT(complaints("margins..x", "1"),
              ElementsAre("--set margins..x: an empty key (valid: dotted keys, as "
                          "smoothing.method)"));
  EXPECT_THAT(complaints("name.x", "1"),
              ElementsAre("--set name.x: name is 'walk', not a map or a list"));
  EXPECT_THAT(complaints("steps.1.x_m", "1"),
              ElementsAre("--set steps.1.x_m: steps has no item '1' (valid: 0 … 0)"));
  EXPECT_THAT(complaints("steps.first", "1"),
              ElementsAre("--set steps.first: steps has no item 'first' (valid: 0 … 0)"));
  EXPECT_THAT(complaints("steps.0.x_m", "3"),
              ElementsAre("--set steps.0.x_m: steps[0].x_m: a step of more than 1 m"));
  EXPECT_THAT(complaints("name", "[a"), ElementsAre(HasSubstr("--set name: broken YAML: ")));
  EXPECT_THAT(complaints("name", ""), ElementsAre("--set name: not text: nothing (valid: text)"));
}

}  // namespace
}  // namespace halfstep
