// Which limbs of a URDF are taken for its legs, and why some are refused.

#include "experiments/survey/found_legs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/survey/robot_survey.h"
#include "tests/places.h"
#include "tests/refusal_of.h"
#include "tests/replaced.h"
#include "tests/temporary_folder.h"
#include "wpg/files/input_error.h"
#include "wpg/robot/urdf_file.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const fs::path kDrawnRobots = InSources("wpg/robots");

// One joint of a limb: where it is, seen from the one before, and about which axis it turns.
struct Turn {
  std::string name, xyz, axis;
  std::string more = {};  // elements of the joint
};

// A limb on a link, without bodies.
std::string Limb(const std::string& prefix, const std::string& on, const std::vector<Turn>& turns) {
  std::string text, parent = on;
  for (const Turn& turn : turns) {
    const std::string name = prefix + turn.name, link = name + "_link";
    text += "<link name='" + link + "'/><joint name='" + name + "' type='revolute'><parent link='" +
            parent + "'/><child link='" + link + "'/><origin xyz='" + turn.xyz + "'/><axis xyz='" +
            turn.axis + "'/><limit lower='-2' upper='2' velocity='5' effort='50'/>" + turn.more +
            "</joint>\n";
    parent = link;
  }
  return text;
}

std::string RobotOf(const std::string& limbs) {
  return "<robot name='drawn'><link name='pelvis'/>" + limbs + "</robot>";
}

// Legs that are folded at zero: the ankles are no lower than the knees.
std::vector<Turn> FoldedLeg(const std::string& y) {
  return {{"a", "0 " + y + " 0", "0 0 1"}, {"b", "0 0 0", "1 0 0"},   {"c", "0 0 0", "0 1 0"},
          {"d", "0 0 -0.4", "0 1 0"},      {"e", "0.4 0 0", "0 1 0"}, {"f", "0 0 0", "1 0 0"}};
}

std::vector<Turn> Arm(const std::string& y) {
  return {{"u", "0 " + y + " 0.4", "0 1 0"}, {"v", "0 0 -0.1", "1 0 0"},
          {"w", "0 0 -0.2", "0 0 1"},        {"x", "0 0 -0.2", "0 1 0"},
          {"y", "0 0 -0.2", "0 0 1"},        {"z", "0 0 -0.3", "1 0 0"}};
}

std::string RefusalOfLegs(const std::string& urdf) {
  const UrdfTree tree = ParseUrdf("robot.urdf", urdf);
  return RefusalOf([&] { (void)FindLegs(tree, {}); });
}

std::vector<std::string> FirstLeg(const std::string& urdf) {
  const UrdfTree tree = ParseUrdf("robot.urdf", urdf);
  const FoundLegs legs = FindLegs(tree, {});
  std::vector<std::string> names;
  for (const int joint : legs.joints[0]) {
    names.push_back(tree.joints[static_cast<size_t>(joint)].name);
  }
  return names;
}

TEST(FoundLegs, AreNotArmsThatHangLowerThanFoldedLegs) {
  const std::string arms = Limb("l", "pelvis", Arm("0.3")) + Limb("r", "pelvis", Arm("-0.3"));
  const std::string legs =
      Limb("l", "pelvis", FoldedLeg("0.1")) + Limb("r", "pelvis", FoldedLeg("-0.1"));
  for (const std::string& urdf : {RobotOf(arms + legs), RobotOf(legs + arms)}) {
    EXPECT_THAT(FirstLeg(urdf), ElementsAre("la", "lb", "lc", "ld", "le", "lf"));
  }
}

TEST(FoundLegs, AreNotThereWhereOnlyArmsAre) {
  const auto named = [](const std::string& y) {
    std::vector<Turn> arm = Arm(y);
    const char* const kNames[] = {"_shoulder_p", "_shoulder_r", "_shoulder_y",
                                  "_elbow",      "_wrist_y",    "_wrist_r"};
    for (size_t i = 0; i < arm.size(); ++i) arm[i].name = kNames[i];
    return arm;
  };
  EXPECT_THAT(
      RefusalOfLegs(
          RobotOf(Limb("left", "pelvis", named("0.3")) + Limb("right", "pelvis", named("-0.3")))),
      HasSubstr("are arms by their names (left_shoulder_p, left_shoulder_r, left_shoulder_y, "
                "left_elbow, left_wrist_y, left_wrist_r): there are no two legs"));
}

TEST(FoundLegs, MayHaveToes) {
  const auto with_toes = [](const std::string& y) {
    std::vector<Turn> leg = FoldedLeg(y);
    leg.push_back({"toes", "0.1 0 -0.05", "0 1 0"});
    return leg;
  };
  const UrdfTree tree = ParseUrdf("robot.urdf", RobotOf(Limb("l", "pelvis", with_toes("0.1")) +
                                                        Limb("r", "pelvis", with_toes("-0.1"))));
  const FoundLegs legs = FindLegs(tree, {});
  EXPECT_THAT(legs.beyond, ElementsAre("ltoes", "rtoes"));
  EXPECT_EQ(tree.links[static_cast<size_t>(legs.feet[0])].name, "lf_link");
}

TEST(FoundLegs, OfTwoKneesAreRefusedByTheirNames) {
  for (const bool mimics : {true, false}) {
    const auto knees = [mimics](const std::string& side, const std::string& y) {
      std::vector<Turn> leg = FoldedLeg(y);
      leg.insert(leg.begin() + 4,
                 {"d2", "0.05 0 0", "0 1 0", mimics ? "<mimic joint='" + side + "d'/>" : ""});
      return Limb(side, "pelvis", leg);
    };
    EXPECT_THAT(RefusalOfLegs(RobotOf(knees("l", "0.1") + knees("r", "-0.1"))),
                AllOf(HasSubstr("a leg of it has 7 moving joints (la, lb, lc, ld, ld2, le, lf): "
                                "the knee is two joints, "),
                      HasSubstr(mimics ? "ld2 mimics ld (valid: 6"
                                       : "ld and ld2 turn about parallel axes (valid: 6")));
  }
}

TEST(FoundLegs, ThatDifferAreToldByTheirJoints) {
  std::vector<Turn> shorter = FoldedLeg("-0.1");
  shorter.pop_back();
  EXPECT_THAT(
      RefusalOfLegs(RobotOf(Limb("l", "pelvis", FoldedLeg("0.1")) + Limb("r", "pelvis", shorter))),
      HasSubstr("one of its legs has 6 moving joints (la, lb, lc, ld, le, lf), the other one 5 "
                "moving joints (ra, rb, rc, rd, re): they are no mirror images (valid: 6 each)"));
}

TEST(FoundLegs, OfFewJointsAreNamed) {
  std::vector<Turn> left = FoldedLeg("0.1"), right = FoldedLeg("-0.1");
  left.resize(4), right.resize(4);
  EXPECT_THAT(RefusalOfLegs(RobotOf(Limb("l", "pelvis", left) + Limb("r", "pelvis", right))),
              HasSubstr("a leg of it has 4 moving joints (la, lb, lc, ld), so the foot cannot be "
                        "put everywhere (valid: 6)"));
}

// A shipped robot whose knees are two joints, its meshes nowhere: none is read.
TEST(FoundLegs, AreRefusedBeforeAnyMeshIsRead) {
  const TemporaryFolder place;
  std::string urdf = ReadText(kDrawnRobots / "wren.urdf");
  for (const std::string side : {"left", "right"}) {
    urdf = Replaced(urdf, "<parent link=\"" + side + "_knee_link\"",
                    "<parent link=\"" + side + "_calf\"");
    urdf = Replaced(
        urdf, "</robot>",
        Limb("", side + "_knee_link",
             {{side + "_knee_2", "0 0 -0.01", "0 1 0", "<mimic joint='" + side + "_knee'/>"}}) +
            "</robot>");
    urdf = Replaced(urdf, side + "_knee_2_link'/><joint", side + "_calf'/><joint");
    urdf =
        Replaced(urdf, "<child link='" + side + "_knee_2_link'", "<child link='" + side + "_calf'");
  }
  const RobotSurvey survey = SurveyRobot({.urdf = WriteText(place / "wren.urdf", urdf)});
  ASSERT_EQ(survey.refused.size(), 1u);
  EXPECT_THAT(survey.refused.front(),
              AllOf(HasSubstr("the knee is two joints, left_knee_2 mimics left_knee"),
                    Not(HasSubstr("package"))));
}

// Else the leg would seem to have a joint less.
TEST(FoundLegs, CountAJointWhoseLimitsAreMissing) {
  const TemporaryFolder place;
  std::string urdf =
      RobotOf(Limb("l", "pelvis", FoldedLeg("0.1")) + Limb("r", "pelvis", FoldedLeg("-0.1")));
  urdf = Replaced(urdf, "<limit lower='-2' upper='2' velocity='5' effort='50'/>", "");
  const RobotSurvey survey = SurveyRobot({.urdf = WriteText(place / "robot.urdf", urdf)});
  ASSERT_EQ(survey.refused.size(), 1u);
  EXPECT_THAT(survey.refused.front(), HasSubstr("la: has no <limit>"));
}

TEST(RobotSurvey, TakesTheNameOfTheRobotAndTheFilesNameOfTheFile) {
  const TemporaryFolder place;
  const std::string urdf = RobotOf("");  // which is refused later
  const auto draft_of = [&](const std::string& text, const std::string& name) {
    return SurveyRobot({.urdf = WriteText(place / "v1.urdf", text), .name = name}).draft;
  };
  EXPECT_EQ(draft_of(urdf, "").name, "drawn");
  EXPECT_EQ(draft_of(urdf, "").path.filename(), "v1.yaml");
  EXPECT_EQ(draft_of(urdf, "mine").name, "mine");
  EXPECT_EQ(draft_of(urdf, "mine").path.filename(), "mine.yaml");
  // A name that nothing in a table may have.
  EXPECT_EQ(draft_of(Replaced(urdf, "name='drawn'", "name='=1+1'"), "").name, "v1");
}

}  // namespace
}  // namespace halfstep
