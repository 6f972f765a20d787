// What commands say of input that they refuse.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/commands/commands.h"
#include "tests/experiments/child_process.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

struct BadInput {
  std::string name;
  std::vector<std::string> arguments;
  std::string complaint;  // a part of it
};

std::string Fixture(const std::string& file) { return InSources("tests/fixtures/") + file; }

void PrintTo(const BadInput& input, std::ostream* out) { *out << input.name; }

class BadInputTest : public testing::TestWithParam<BadInput> {};

TEST_P(BadInputTest, ExitsWithTwoAndWritesNothing) {
  const TemporaryFolder place;
  const Outcome outcome = Halfstep(place.path(), GetParam().arguments);
  EXPECT_EQ(outcome.status, kBadInput);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr(GetParam().complaint));
  EXPECT_THAT(NamesIn(place.path()), IsEmpty());
}

const std::string kGood = ShippedConfig("fig3_two_half_steps");
const std::string kUrdf = InSources("wpg/robots/hrp2.urdf");

INSTANTIATE_TEST_SUITE_P(
    Command, BadInputTest,
    testing::ValuesIn(std::vector<BadInput>{
        {"NoCommand", {}, "(valid: init, run, "},
        {"UnknownCommand", {"walk"}, "walk"},
        {"NoConfig", {"run"}, "halfstep: run: CONFIG is missing: "},
        {"NoRun", {"verify"}, "verify: RUN is missing: run folder (`halfstep verify -h` explains)"},
        {"UnknownOption", {"run", kGood, "--outt", "a"}, "--outt"},
        {"TwoConfigs", {"run", kGood, kGood}, "fig3"},
        {"MissingFile",
         {"run", "nowhere.yaml"},
         "nowhere.yaml: no such file (valid: a path, or a name of bar_10cm"},
        {"FolderAsFile", {"run", "."}, "a folder"},
        {"UnknownKey", {"run", Fixture("config/unknown_key.yaml")}, ":5:1: colour: unknown key"},
        {"BadScene",
         {"run", kGood, "--set", "scene=" + Fixture("scene/misspelt_key.yaml")},
         "misspelt_key.yaml:5:5: obstacles[0].psoe: unknown key"},
        {"BadRobot",
         {"run", kGood, "--set", "robot=" + Fixture("robot/same_foot.yaml")},
         "same_foot.yaml:"},
        {"NoSuchRobot", {"run", kGood, "--set", "robot=asimo"}, "--set robot: no such robot"},
        {"SetWithoutValue", {"run", kGood, "--set", "seed"}, "not an assignment"},
        {"SetUnknownKey", {"run", kGood, "--set", "sede=1"}, "did you mean 'seed'?"},
        {"SetKeyOfAGroup",
         {"run", kGood, "--set", "methods=[dichotomy]"},
         "--set methods: belongs into a group (valid: smoothing.methods)"},
        {"SetTextForAList",
         {"run", kGood, "--set", "smoothing.methods=halfstep/sqp"},
         "not a list: 'halfstep/sqp' (valid: a list of texts, [halfstep/sqp])"},
        {"MethodWithoutItsFolder",
         {"run", kGood, "--set", "smoothing.methods=[sqp]"},
         "did you mean 'halfstep/sqp'?"},
        {"RobotInCapitals", {"run", kGood, "--set", "robot=HRP2"}, "did you mean 'hrp2'?"},
        {"RunWithoutSuchMethod",
         {"run", kGood, "--method", "dichotmy"},
         "--method 'dichotmy': no such method (did you mean 'dichotomy'?"},
        {"SetOutOfRange", {"run", kGood, "--set", "output.period_s=-1"}, "output.period_s: -1"},
        {"SetBrokenYaml", {"run", kGood, "--set", "seed=[1"}, "--set seed"},
        {"SetItemThatIsNot", {"run", kGood, "--set", "footsteps.1.x_m=0"}, "footsteps.1"},
        {"EmptyOut", {"run", kGood, "--out", ""}, "--out: no folder"},
        {"ListOfWhat", {"list", "shoes"}, "shoes"},
        {"MisspeltCommand", {"verfy", "a"}, "did you mean 'verify'?"},
        {"MisspeltOption",
         {"run", kGood, "--overwrit"},
         "halfstep: run: '--overwrit': no such option (did you mean '--overwrite'? valid: "},
        {"MisspeltOptionWithValue",
         {"run", kGood, "--ot=a"},
         "'--ot': no such option (did you mean '--out'? valid: "},
        {"OneWordTooMany", {"run", kGood, kGood}, "': one argument too many (`halfstep run -h`"},
        {"MisspeltChoice", {"list", "planers"}, "'planers' is none of the choices (did you mean "},
        {"MisspeltFormat", {"export", "a", "--format", "cvs"}, "did you mean 'csv'? valid: "},
        {"MisspeltMethod", {"smooth", kGood, "--method", "dichotmy"}, "did you mean 'dichotomy'?"},
        {"MisspeltRobot", {"run", kGood, "--set", "robot=hrp"}, "did you mean 'hrp2'? valid: "},
        {"MisspeltScene",
         {"run", kGood, "--set", "scene=../scenes/bar8cm.yaml"},
         "did you mean 'bar_8cm.yaml'? valid: "},
        {"DecimalCommaInSet",
         {"run", kGood, "--set", "output.period_s=0,05"},
         "not a number: '0,05' (a decimal point is needed: 0.05? valid: "},
        {"DecimalCommaInOption",
         {"export", "a", "--format", "csv", "--period", "0,01"},
         "--period: '0,01' is not a number (a decimal point is needed: 0.01?)"},
        {"DecimalCommaInRange",
         {"init", "a", "--goal", "1,5", "2"},
         "--goal: '1,5' is not a number (a decimal point is needed: 1.5?)"},
        {"UrdfAsRobot",
         {"init", "a", "--robot", kUrdf},
         "hrp2.urdf:1:1: is a URDF (valid: YAML; `halfstep robot "},
        {"UrdfAsRobotOfAConfig",
         {"run", kGood, "--set", "robot=" + kUrdf},
         "is a URDF (valid: YAML; `halfstep robot "},
        {"UrdfThatIsNotThere",
         {"init", "a", "--robot", "a.urdf"},
         "(valid: a robot file; `halfstep robot URDF` makes one of a URDF)"},
        {"UrdfAsConfig", {"run", kUrdf}, "is a URDF (valid: YAML; `halfstep robot "},
    }),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace halfstep
