// Trajectories of files, and what `halfstep check` says of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "experiments/checker/trajectory.h"
#include "experiments/run/exit_status.h"
#include "tests/checker/three_joint_arm.h"
#include "tests/experiments/child_process.h"
#include "tests/refusal_of.h"
#include "tests/temporary_folder.h"

namespace halfstep::checker {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const JointNames kNames{.moving = {"shoulder", "elbow", "wrist"}, .others = {"gripper"}};

Trajectory Read(const std::string& name, const std::string& text,
                const std::optional<Interpolation>& interpolation = {}) {
  const TemporaryFolder place;
  return ReadTrajectory(WriteText(place / name, text), interpolation, kNames);
}
std::string Refused(const std::string& name, const std::string& text,
                    const std::optional<Interpolation>& interpolation = {}) {
  return RefusalOf([&] { Read(name, text, interpolation); });
}

TEST(Trajectory, OfCsvHasItsJointsInAnyOrder) {
  const Trajectory read = Read(
      "a.csv",
      "t_s,q_elbow_rad,shoulder,com_x_m,elbow_vel,v_shoulder_rad_s\n0,1,2,9,3,4\n1,5,6,9,7,8\n");
  EXPECT_THAT(read.joints, ElementsAre("elbow", "shoulder"));
  EXPECT_THAT(read.unread, ElementsAre("com_x_m"));
  EXPECT_EQ(read.interpolation, Interpolation::kCubic);
  EXPECT_EQ(read.q(1, 0), 2.0);
  EXPECT_EQ(read.v(0, 1), 7.0);
  EXPECT_EQ(Read("a.csv", "t,wrist\n0,1\n1,2\n").interpolation, Interpolation::kLinear);
}

TEST(Trajectory, OfRosIsRead) {
  const Trajectory read = Read("a.yaml", R"(header: {frame_id: ""}
joint_names: [wrist, elbow]
points:
- {positions: [1, 2], velocities: [], time_from_start: {sec: 0, nanosec: 500000000}}
- {positions: [3, 4], velocities: [], time_from_start: {secs: 2, nsecs: 0}}
)");
  EXPECT_THAT(read.times, ElementsAre(0.5, 2.0));
  EXPECT_EQ(read.q(1, 1), 4.0);
}

// Roll, pitch and yaw are the same poses as quaternions, whose sign says nothing.
TEST(Trajectory, MayTellTheRootsPoses) {
  const Trajectory turns =
      Read("a.csv",
           "t,wrist,base_x_m,base_y_m,base_z_m,base_qw,base_qx,base_qy,base_qz\n"
           "0,1,1,2,3,1,0,0,0\n1,1,1,2,3,-0.8,0,0,-0.6\n");
  const Trajectory angles = Read("a.csv",
                                 "t,wrist,root_x,root_y,root_z,root_roll,root_pitch,root_yaw_rad\n"
                                 "0,1,1,2,3,0,0,0\n1,1,1,2,3,0,0,1.2870022175865687\n");
  EXPECT_LT((turns.base - angles.base).norm(), 1e-12);
  EXPECT_NEAR(turns.base(3, 1), 0.8, 1e-15);
  EXPECT_TRUE(turns.unread.empty());
  EXPECT_THAT(Refused("a.csv", "t,wrist,base_x,base_y,base_z\n0,1,0,0,0\n1,1,0,0,0\n"),
              HasSubstr("base_qw: is missing"));
  EXPECT_THAT(Refused("a.npz", ""), HasSubstr("hs.check"));
}

TEST(Trajectory, MayTellTheRootsVelocities) {
  const std::string poses = "t,wrist,base_x,base_y,base_z,base_qw,base_qx,base_qy,base_qz,";
  const auto text = [&](const std::string& names) {
    std::string numbers;
    for (int i = 1; i <= 1 + std::ranges::count(names, ','); ++i) {
      numbers += "," + std::to_string(i);
    }
    return poses + names + "\n0,1,1,2,3,1,0,0,0" + numbers + "\n1,1,1,2,3,1,0,0,0" + numbers + "\n";
  };
  const Trajectory read =
      Read("a.csv", text("base_wz_rad_s,base_vx_m_s,base_vy,root_vz,base_wx_rad_s,base_wy_rad_s"));
  EXPECT_EQ(read.base_v.col(1), (Eigen::VectorXd(6) << 2, 3, 4, 5, 6, 1).finished());
  EXPECT_TRUE(read.unread.empty());
  EXPECT_THAT(Refused("a.csv", text("base_vx,base_vz,base_wx,base_wy,base_wz")),
              HasSubstr("base_vy: is missing"));
  EXPECT_THAT(Refused("a.csv", text("base_vx,root_vx")), HasSubstr("base_vx: is told twice"));
  EXPECT_THAT(Refused("a.csv", "t,wrist,base_vx\n0,1,0\n1,1,0\n"), HasSubstr("base_x: is missing"));
  EXPECT_THAT(Refused("a.csv", poses + "base_vx\n0,1,1,2,3,1,0,0,0,fast\n"),
              HasSubstr("a.csv:2: base_vx"));
}

TEST(Trajectory, MistakesAreTold) {
  EXPECT_THAT(Refused("a.txt", ""), HasSubstr("is no trajectory (valid: .csv"));
  EXPECT_THAT(Refused("a.csv", "x,wrist\n0,1\n1,1\n"),
              HasSubstr("a.csv:1: the first column is no time, but 'x'"));
  EXPECT_THAT(Refused("a.csv", "t,wrist\n0,1\n"), HasSubstr("fewer than two knots"));
  EXPECT_THAT(Refused("a.csv", "t,wrist\n0,1\n0,1\n"), HasSubstr("knot 2: time 0 s"));
  EXPECT_THAT(Refused("a.csv", "t,wirst\n0,1\n1,1\n"),
              HasSubstr("names no joint of the robot (valid: shoulder, elbow, wrist)"));
  EXPECT_THAT(Refused("a.csv", "t,wrist,gripper\n0,1,0\n1,1,0\n"),
              HasSubstr("gripper: is no joint that turns or slides"));
  EXPECT_THAT(Refused("a.csv", "t,wrist,elbow,elbow_vel\n0,1,0,0\n1,1,0,0\n"),
              HasSubstr("wrist: has no velocity, as other joints have"));
  EXPECT_THAT(Refused("a.csv", "t,wrist\n0,1\n1,1\n", Interpolation::kCubic),
              HasSubstr("--interpolation cubic: the file has no velocities (valid: linear)"));
  EXPECT_THAT(Refused("a.yaml",
                      "joint_names: [wrist]\npoints:\n- {positions: [1, 2], "
                      "time_from_start: 0}\n"),
              HasSubstr("positions: 2 numbers (valid: one for each of the 1 joints)"));
}

// Columns without names, as many programs write them.
TEST(Trajectory, WithoutNamesOfColumnsIsTold) {
  const std::string three = Refused("a.csv", "0.5,1e-3,-2\n1,1,1\n");
  EXPECT_THAT(three, HasSubstr("a.csv:1: begins with 3 numbers in place of the columns' names: one "
                               "for each of the robot's 3 joints, without a time (valid: a first "
                               "line like t_s,shoulder,…: a time, joints, and where"));
  EXPECT_THAT(three, HasSubstr("; joints: shoulder, elbow, wrist)"));
  EXPECT_THAT(Refused("a.csv", "0,0,0,0\n"), HasSubstr("robot's 3 joints, and a time (valid"));
  EXPECT_THAT(Refused("a.csv", "0,0,0,0,0,0,1,0,0,0\n"),
              HasSubstr("3 joints and 7 for the root's pose, without a time (valid"));
  EXPECT_THAT(Refused("a.csv", "0,0\n"), HasSubstr("in place of the columns' names (valid"));
  EXPECT_THAT(Refused("a.csv", "t_s;wrist\n0;1\n"),
              HasSubstr("a.csv:1: is one column, 't_s;wrist' (valid: commas between columns)"));
  EXPECT_THAT(Refused("a.csv", "0.5 1e-3 -2\n"), HasSubstr("commas between columns"));
}

TEST(CheckCommand, SaysWhatIsProvedAndWhatIsNot) {
  const TemporaryFolder place;
  WriteText(place / "arm.urdf", ArmText());
  WriteText(place / "arm.csv", "t_s,shoulder\n0,-1\n2,1\n");
  WriteText(place / "ball.yaml",
            "obstacles:\n  - {name: ball, sphere: {radius_m: 0.05}, pose: {xyz: [0.9, 0, 0]}}\n");
  const Outcome free = Halfstep(place.path(), {"check", "arm.csv", "--robot", "arm.urdf"});
  EXPECT_EQ(free.status, kSuccess) << free.err;
  EXPECT_THAT(free.out,
              AllOf(HasSubstr("joint limits         proved for all t: 1, each by 1.5 rad"),
                    HasSubstr("joints that stay at 0, for they are not told: elbow, wrist"),
                    HasSubstr("there is no --scene")));
  const Outcome touched =
      Halfstep(place.path(), {"check", "arm.csv", "--robot", "arm.urdf", "--scene", "ball.yaml"});
  EXPECT_EQ(touched.status, kFailed);
  EXPECT_THAT(touched.out,
              AllOf(HasSubstr("clearance            not proved: 1 of 3"),
                    HasSubstr("hand - ball at 1.0000 s"), HasSubstr("no knot shows it")));
  EXPECT_EQ(Halfstep(place.path(), {"check", "arm.csv", "--robot", "armm"}).status, kBadInput);
}

// What it says of pairs that meet at knots can be pasted.
TEST(CheckCommand, TellsHowToIgnorePairs) {
  const TemporaryFolder place;
  WriteText(place / "arm.urdf", ArmText());
  WriteText(place / "arm.csv", "t_s,shoulder\r\n0,-1\r\n2,1\r\n");
  std::vector<std::string> words = {"check",    "arm.csv",          "--robot",
                                    "arm.urdf", "--self-clearance", "1"};
  const Outcome missed = Halfstep(place.path(), words);
  EXPECT_EQ(missed.status, kFailed) << missed.err;
  const std::string begin = "  if these links meet by design: ";
  const size_t at = missed.out.find(begin);
  ASSERT_NE(at, std::string::npos) << missed.out;
  const size_t from = at + begin.size();
  std::istringstream options(missed.out.substr(from, missed.out.find('\n', from) - from));
  for (std::string word; options >> word;) words.push_back(word);
  EXPECT_GT(words.size(), 6u);
  EXPECT_EQ(Halfstep(place.path(), words).status, kSuccess);
}

TEST(CheckCommand, AsksForTheFloorAndForContacts) {
  const TemporaryFolder place;
  WriteText(place / "arm.urdf", ArmText());
  WriteText(place / "arm.csv",
            "t,wrist,base_x,base_y,base_z,base_qw,base_qx,base_qy,base_qz\n"
            "0,0,0,0,0.5,1,0,0,0\n1,0,0,0,0.5,1,0,0,0\n2,0,0,0,0,1,0,0,0\n");
  const auto check = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"check", "arm.csv", "--robot", "arm.urdf"};
    words.insert(words.end(), more.begin(), more.end());
    return Halfstep(place.path(), words);
  };
  const Outcome stands = check({"--ground", "0.06", "--contact", "hand:0..1"});
  EXPECT_EQ(stands.status, kSuccess) << stands.out << stands.err;
  EXPECT_THAT(stands.out, AllOf(HasSubstr("1 joints and the root, 3 knots"),
                                HasSubstr("contact, distance    proved for all t: 1")));
  const Outcome sinks = check({"--ground", "0.01", "--contact", "hand"});
  EXPECT_EQ(sinks.status, kFailed);
  EXPECT_THAT(sinks.out,
              AllOf(HasSubstr("base at 1.9375 s: -18.75 mm, -10 demanded; proved is 50 mm"),
                    HasSubstr("hand from 0 to 2 s"), HasSubstr("proved is 500 mm")));
  EXPECT_THAT(check({"--contact", "hand:0-1"}).err, HasSubstr("(valid: LINK or LINK:FROM..TO"));
}

TEST(CheckCommand, AsksForZmpAndFriction) {
  const TemporaryFolder place;
  WriteText(place / "box.urdf",
            "<robot name='box'><link name='box'><inertial><mass value='5'/><inertia ixx='0.1' "
            "iyy='0.1' izz='0.1' ixy='0' ixz='0' iyz='0'/></inertial><collision><geometry><box "
            "size='0.2 0.2 0.6'/></geometry></collision></link><link name='lid'/><joint "
            "name='hinge' type='revolute'><parent link='box'/><child link='lid'/><axis xyz='0 0 "
            "1'/><limit lower='-1' upper='1' velocity='1' effort='1'/></joint></robot>");
  WriteText(place / "box.csv",
            "t,hinge,hinge_vel,base_x,base_y,base_z,base_qw,base_qx,base_qy,base_qz,base_vx,"
            "base_vy,base_vz,base_wx,base_wy,base_wz\n0,0,0,0,0,0.3,1,0,0,0,0,0,0,0,0,0\n"
            "1,0,0,1e-4,0,0.3,1,0,0,0,0,0,0,0,0,0\n");
  const auto check = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"check", "box.csv", "--robot", "box.urdf"};
    words.insert(words.end(), more.begin(), more.end());
    return Halfstep(place.path(), words);
  };
  const Outcome stands = check({"--contact", "box", "--zmp", "0.09", "--friction", "0.1"});
  EXPECT_EQ(stands.status, kSuccess) << stands.out << stands.err;
  EXPECT_THAT(stands.out,
              AllOf(HasSubstr("cubic between knots, the root cubic"),
                    HasSubstr("zmp of the robot     proved for all t: 1, each by 9"),
                    HasSubstr("friction             proved for all t: 1, each by 0.0")));
  const Outcome slips = check({"--contact", "box", "--friction", "1e-9"});
  EXPECT_EQ(slips.status, kFailed);
  EXPECT_THAT(slips.out, AllOf(HasSubstr("friction             not proved: 1 of 1"),
                               HasSubstr("as the limit")));
  EXPECT_THAT(check({"--zmp", "0"}).err, HasSubstr("--zmp: no contact is claimed"));
  EXPECT_THAT(check({"--contact", "box", "--zmp", "-1"}).err, HasSubstr("--zmp"));
}

// A robot file says where meshes are.
TEST(CheckCommand, TakesShippedRobotsByTheirNames) {
  const TemporaryFolder place;
  WriteText(place / "knee.csv", "t_s,RLEG_JOINT3\n0,0.5\n2,1\n");
  const Outcome knee =
      Halfstep(place.path(), {"check", "knee.csv", "--robot", "hrp2", "--scene", "bar_8cm"});
  EXPECT_THAT(knee.out, AllOf(HasSubstr("joint speeds         proved for all t: 1"),
                              HasSubstr("clearance            proved for all t: 22")));
  EXPECT_EQ(knee.err, "");
}

// A hand that rests where it keeps exactly what is asked is not looked at for ever.
TEST(CheckCommand, WhatRestsAtItsLimitEnds) {
  const TemporaryFolder place;
  WriteText(place / "arm.urdf", ArmText());
  WriteText(place / "arm.csv", "t_s,shoulder\n0,0\n1000,0\n");
  WriteText(place / "ball.yaml",
            "obstacles:\n  - {name: ball, sphere: {radius_m: 0.05}, pose: {xyz: [0.9, 0, 0.2]}}\n");
  const Outcome at = Halfstep(place.path(), {"check", "arm.csv", "--robot", "arm.urdf", "--scene",
                                             "ball.yaml", "--clearance", "0.11", "--json"});
  EXPECT_NE(at.status, kBadInput) << at.err;
  EXPECT_THAT(at.out, HasSubstr("\"stopped\": false"));
}

}  // namespace
}  // namespace halfstep::checker
