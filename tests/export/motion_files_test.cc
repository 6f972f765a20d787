// Motions for those who learn or track them, as NumPy, Python and MuJoCo read them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#if __has_include(<mujoco/mujoco.h>) && defined(HALFSTEP_TESTS_HAVE_MUJOCO)
#include <mujoco/mujoco.h>
#define HALFSTEP_READS_BY_MUJOCO
#endif

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include "experiments/commands/commands.h"
#include "experiments/export/body_motion.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/parsed_csv.h"
#include "tests/export/python_reader.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

const std::string kRobots = InSources("wpg/robots/");

/// The arrays of an archive as NumPy read them.
struct NumpyMotion {
  explicit NumpyMotion(const fs::path& folder) : folder_(folder) {
    joints = Names("joint_names");
    bodies = Names("body_names");
    q = Numbers("joint_pos");
    speeds = Numbers("joint_vel");
    places = Numbers("body_pos_w");
    rotations = Numbers("body_quat_w");
    velocities = Numbers("body_lin_vel_w");
    turns = Numbers("body_ang_vel_w");
    frames = q.size() / joints.size();
  }
  Eigen::Vector3d Place(size_t frame, size_t body) const { return At(places, frame, body); }
  Eigen::Vector3d Velocity(size_t frame, size_t body) const { return At(velocities, frame, body); }
  Eigen::Vector3d Turn(size_t frame, size_t body) const { return At(turns, frame, body); }
  Eigen::Quaterniond Rotation(size_t frame, size_t body) const {
    const double* r = &rotations[4 * (frame * bodies.size() + body)];
    return {r[0], r[1], r[2], r[3]};
  }
  size_t Body(const std::string& name) const {
    return static_cast<size_t>(std::ranges::find(bodies, name) - bodies.begin());
  }

  std::vector<std::string> joints, bodies;
  std::vector<double> q, speeds, places, rotations, velocities, turns;
  size_t frames = 0;

 private:
  Eigen::Vector3d At(const std::vector<double>& of, size_t frame, size_t body) const {
    return Eigen::Map<const Eigen::Vector3d>(&of[3 * (frame * bodies.size() + body)]);
  }
  std::vector<std::string> Names(const std::string& name) const {
    std::istringstream in(ReadText(folder_ / name));
    std::vector<std::string> names;
    for (std::string line; std::getline(in, line);) names.push_back(line);
    return names;
  }
  std::vector<double> Numbers(const std::string& name) const {
    const std::string bytes = ReadText(folder_ / name);
    std::vector<double> numbers(bytes.size() / sizeof(double));
    std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return numbers;
  }
  fs::path folder_;
};

/// A folder with a short walk of a robot, "run": a curve with a turn.
class MotionFiles : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!PythonHas("numpy")) GTEST_SKIP() << "NumPy is not installed";
    const double length = GetParam() == "wren" ? 0.25 : 1.0;
    std::ostringstream config;
    config << "robot: " << GetParam() << "\nscene: none\nfootsteps:\n";
    const double width = BodyMotion(kRobots + GetParam() + ".yaml").robot().standing_width;
    config << "  - {foot: left, x_m: " << 0.1 * length << ", y_m: " << 0.5 * width
           << ", yaw_deg: 8}\n  - {foot: right, x_m: " << 0.15 * length << ", y_m: " << -0.5 * width
           << ", yaw_deg: 12}\n";
    WriteText(place_ / "walk.yaml", config.str());
    const Outcome outcome =
        Halfstep(place_.path(), {"run", "walk.yaml", "--out", "run", "--quiet"});
    ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  }
  void Export(const std::string& format, const std::string& out, const std::string& fps,
              const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"export",  "run",      "--method", "dichotomy",
                                      "--quiet", "--format", format,     "--out",
                                      out,       "--fps",    fps};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = Halfstep(place_.path(), words);
    ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  }
  NumpyMotion Mjlab(const std::string& fps, const std::vector<std::string>& more = {}) {
    Export("mjlab", "mjlab" + fps, fps, more);
    const std::string folder = "arrays" + fps;
    fs::create_directory(place_ / folder);
    EXPECT_EQ(ReadByPython(place_, "arrays mjlab" + fps + "/dichotomy.npz " + folder), "");
    return NumpyMotion(place_ / folder);
  }

  TemporaryFolder place_;
};

TEST_P(MotionFiles, ArraysHoldTheWalkOfTheRun) {
  const NumpyMotion motion = Mjlab("50");
  const ParsedCsv walk(ReadText(place_ / "run/dichotomy/trajectory.csv"));
  const BodyMotion bodies(kRobots + GetParam() + ".yaml");
  const size_t waist = motion.Body(Nth(bodies.tree().urdf.links, bodies.tree().waist).name);
  ASSERT_LT(waist, motion.bodies.size());
  EXPECT_EQ(motion.bodies.size(), motion.joints.size() + 1);
  const double end = walk.Number(walk.size() - 1, "t_s");
  EXPECT_EQ(motion.frames, static_cast<size_t>(std::ceil(50 * end - 1e-7)) + 1);
  for (size_t frame = 0; 4 * frame < walk.size(); ++frame) {
    const size_t row = 4 * frame;  // every 5 ms
    const Eigen::Vector3d p(walk.Number(row, "waist_x_m"), walk.Number(row, "waist_y_m"),
                            walk.Number(row, "waist_z_m"));
    ASSERT_LT((motion.Place(frame, waist) - p).norm(), 1e-12);
    const Eigen::Vector3d v = motion.Velocity(frame, waist);
    ASSERT_LT(std::abs(v.z()) + motion.Turn(frame, waist).head<2>().norm(), 1e-12);
    for (size_t j = 0; j < motion.joints.size(); ++j) {
      const std::string column = "q_" + motion.joints[j] + "_rad";
      if (std::ranges::find(walk.header(), column) == walk.header().end()) {
        ASSERT_EQ(motion.speeds[frame * motion.joints.size() + j], 0.0);
      } else {
        ASSERT_NEAR(motion.q[frame * motion.joints.size() + j], walk.Number(row, column), 1e-12);
      }
    }
  }
}

// Every link that can move: values and slopes are of one motion. Differences of twice as many
// frames are off by a quarter.
TEST_P(MotionFiles, VelocitiesAreTheSlopesOfPlaces) {
  const auto off = [](const NumpyMotion& motion, double fps) {
    double sum = 0.0, of_joints = 0.0;
    for (size_t frame = 1; frame + 1 < motion.frames; ++frame) {
      for (size_t body = 0; body < motion.bodies.size(); ++body) {
        const Eigen::Vector3d slope =
            0.5 * fps * (motion.Place(frame + 1, body) - motion.Place(frame - 1, body));
        sum += (motion.Velocity(frame, body) - slope).norm();
        const Eigen::Quaterniond turned =
            motion.Rotation(frame + 1, body) * motion.Rotation(frame - 1, body).conjugate();
        sum += (motion.Turn(frame, body) - fps * turned.vec()).norm();
      }
      for (size_t j = 0; j < motion.joints.size(); ++j) {
        const auto q = [&](size_t k) { return motion.q[k * motion.joints.size() + j]; };
        of_joints += std::abs(motion.speeds[frame * motion.joints.size() + j] -
                              0.5 * fps * (q(frame + 1) - q(frame - 1)));
      }
    }
    const double count = static_cast<double>(motion.frames - 2);
    return std::pair(sum / count, of_joints / count);
  };
  const auto [coarse, coarse_joints] = off(Mjlab("100"), 100);
  const auto [fine, fine_joints] = off(Mjlab("200"), 200);
  EXPECT_LT(fine, 0.3 * coarse);
  EXPECT_LT(fine_joints, 0.3 * coarse_joints);
  EXPECT_GT(fine, 0.0);
  EXPECT_LT(fine_joints, 0.05 * 12);
}

TEST_P(MotionFiles, StandingSolesAreStillAndTheOtherIsAboveTheFloor) {
  const NumpyMotion motion = Mjlab("100");
  const BodyMotion bodies(kRobots + GetParam() + ".yaml");
  const ParsedCsv walk(ReadText(place_ / "run/dichotomy/trajectory.csv"));
  int still = 0, above = 0;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Leg& leg = Nth(bodies.robot().legs, Index(side));
    const Eigen::Isometry3d X_LinkSole = leg.joints[5].X_BLink.inverse() * leg.X_BSole;
    const size_t foot =
        motion.Body(Nth(bodies.tree().urdf.links, Nth(bodies.tree().feet, Index(side))).name);
    ASSERT_LT(foot, motion.bodies.size());
    for (size_t frame = 0; 2 * frame < walk.size(); ++frame) {
      const std::string support = walk.Text(2 * frame, "support");
      const Eigen::Vector3d sole =
          motion.Place(frame, foot) + motion.Rotation(frame, foot) * X_LinkSole.translation();
      const Eigen::Vector3d up = motion.Rotation(frame, foot) * X_LinkSole.linear().col(2);
      EXPECT_LT((up - Eigen::Vector3d::UnitZ()).norm(), 1e-12);  // soles are flat
      if (support == "both" || support == Name(side)) {
        EXPECT_LE(motion.Velocity(frame, foot).norm(), 1e-12) << frame;
        EXPECT_LE(motion.Turn(frame, foot).norm(), 1e-12) << frame;
        EXPECT_NEAR(sole.z(), 0.0, 1e-12);
        ++still;
      } else {
        EXPECT_GE(sole.z(), -1e-12);
        above += sole.z() > 0.005 ? 1 : 0;
        if (motion.Velocity(frame, foot).head<2>().norm() > 1e-3) {
          EXPECT_GT(sole.z(), 0.001);
        }
      }
    }
  }
  EXPECT_GT(still, 100);
  EXPECT_GT(above, 20);
}

TEST_P(MotionFiles, LafanAndJsonAreTheSameMotion) {
  Mjlab("30");
  Export("lafan1", "lafan", "30");
  EXPECT_EQ(ReadByPython(place_, "lafan1 lafan/dichotomy.csv mjlab30/dichotomy.npz"), "");
  Export("json", "json", "30");
  EXPECT_EQ(ReadByPython(place_, "json json/dichotomy.json mjlab30/dichotomy.npz"), "");
  // In an order of one's own.
  const std::vector<std::string> joints = NumpyMotion(place_ / "arrays30").joints;
  std::vector<std::string> turned = {"--joints"};
  turned.insert(turned.end(), joints.rbegin(), joints.rend());
  Export("lafan1", "turned", "30", turned);
  const std::string a = ReadText(place_ / "lafan/dichotomy.csv"),
                    b = ReadText(place_ / "turned/dichotomy.csv");
  EXPECT_NE(a, b);
  EXPECT_EQ(a.substr(0, a.find('\n')).size(), b.substr(0, b.find('\n')).size());
}

#ifdef HALFSTEP_READS_BY_MUJOCO

// The URDF for MuJoCo: without shapes, and with a root that floats.
std::string FloatingUrdf(std::string text, const std::string& root) {
  for (const std::string element : {"visual", "collision"}) {
    for (size_t at = 0; (at = text.find("<" + element, at)) != std::string::npos;) {
      const std::string close = "</" + element + ">";
      text.erase(at, text.find(close, at) + close.size() - at);
    }
  }
  const size_t end = text.find("</robot>");
  return text.substr(0, end) +
         "<mujoco><compiler balanceinertia='true' boundmass='1e-4' boundinertia='1e-6'/></mujoco>"
         "<link name='beneath'/><joint name='floating' type='floating'><parent link='beneath'/>"
         "<child link='" +
         root + "'/></joint></robot>\n";
}

// MuJoCo reads the robot's own URDF: the same bodies and joints in the same order, the same places,
// and the same velocities by its own kinematics.
TEST_P(MotionFiles, MujocoFindsTheSameBodies) {
  const NumpyMotion motion = Mjlab("50");
  const std::string urdf =
      WriteText(place_ / "floating.urdf",
                FloatingUrdf(ReadText(kRobots + GetParam() + ".urdf"), motion.bodies.front()));
  char error[500] = "";
  mjModel* const model = mj_loadXML(urdf.c_str(), nullptr, error, sizeof error);
  ASSERT_NE(model, nullptr) << error;
  mjData* const data = mj_makeData(model);
  ASSERT_EQ(static_cast<size_t>(model->nbody), motion.bodies.size() + 1);
  ASSERT_EQ(static_cast<size_t>(model->njnt), motion.joints.size() + 1);
  for (size_t body = 0; body < motion.bodies.size(); ++body) {
    EXPECT_EQ(mj_id2name(model, mjOBJ_BODY, static_cast<int>(body) + 1), motion.bodies[body]);
  }
  for (size_t j = 0; j < motion.joints.size(); ++j) {
    EXPECT_EQ(mj_id2name(model, mjOBJ_JOINT, static_cast<int>(j) + 1), motion.joints[j]);
  }
  double place = 0.0, rotation = 0.0, velocity = 0.0, turn = 0.0, fastest = 0.0;
  for (size_t frame = 0; frame < motion.frames; ++frame) {
    const Eigen::Quaterniond r = motion.Rotation(frame, 0);
    Eigen::Map<Eigen::Vector3d>(data->qpos) = motion.Place(frame, 0);
    Eigen::Map<Eigen::Vector4d>(data->qpos + 3) = Eigen::Vector4d(r.w(), r.x(), r.y(), r.z());
    Eigen::Map<Eigen::Vector3d>(data->qvel) = motion.Velocity(frame, 0);
    Eigen::Map<Eigen::Vector3d>(data->qvel + 3) = r.conjugate() * motion.Turn(frame, 0);
    for (size_t j = 0; j < motion.joints.size(); ++j) {
      data->qpos[7 + j] = motion.q[frame * motion.joints.size() + j];
      data->qvel[6 + j] = motion.speeds[frame * motion.joints.size() + j];
    }
    mj_kinematics(model, data);
    mj_comPos(model, data);
    mj_comVel(model, data);
    for (size_t body = 0; body < motion.bodies.size(); ++body) {
      const Eigen::Map<const Eigen::Vector3d> p(data->xpos + 3 * (body + 1));
      const Eigen::Map<const Eigen::Vector4d> x(data->xquat + 4 * (body + 1));
      const Eigen::Quaterniond q = motion.Rotation(frame, body);
      const Eigen::Vector4d y(q.w(), q.x(), q.y(), q.z());
      double v[6];
      mj_objectVelocity(model, data, mjOBJ_XBODY, static_cast<int>(body) + 1, v, 0);
      place = std::max(place, (motion.Place(frame, body) - p).norm());
      rotation = std::max(rotation, std::min((x - y).norm(), (x + y).norm()));
      turn = std::max(turn, (motion.Turn(frame, body) - Eigen::Vector3d(v[0], v[1], v[2])).norm());
      velocity = std::max(
          velocity, (motion.Velocity(frame, body) - Eigen::Vector3d(v[3], v[4], v[5])).norm());
      fastest = std::max(fastest, motion.Velocity(frame, body).norm());
    }
  }
  EXPECT_LT(place, 1e-9);
  EXPECT_LT(rotation, 1e-9);
  EXPECT_LT(velocity, 1e-9);
  EXPECT_LT(turn, 1e-9);
  EXPECT_GT(fastest, 0.05);
  mj_deleteData(data);
  mj_deleteModel(model);
}

#endif  // HALFSTEP_READS_BY_MUJOCO

TEST_P(MotionFiles, AllLinksAreThereOnDemand) {
  const BodyMotion bodies(kRobots + GetParam() + ".yaml");
  EXPECT_EQ(bodies.Order(true).links.size(), bodies.tree().urdf.links.size());
  EXPECT_EQ(bodies.Order(true).joints, bodies.Order(false).joints);
  EXPECT_EQ(Mjlab("10", {"--all-links"}).bodies.size(), bodies.tree().urdf.links.size());
}

INSTANTIATE_TEST_SUITE_P(Robots, MotionFiles, testing::Values("hrp2", "wren"),
                         [](const auto& name) { return name.param; });

TEST(MotionFilesRefusal, SaysWhatIsWrong) {
  const TemporaryFolder place;
  const auto refusal = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"export", "run", "--quiet", "--format"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = Halfstep(place.path(), words);
    EXPECT_EQ(outcome.status, kBadInput);
    return outcome.err;
  };
  EXPECT_THAT(refusal({"mjlab", "--period", "0.01"}),
              HasSubstr("--period: not of --format mjlab (valid: csv, npz, hrpsys, "));
  EXPECT_THAT(refusal({"csv", "--fps", "50"}),
              HasSubstr("--fps: not of --format csv (valid: mjlab, lafan1, json)"));
  EXPECT_THAT(refusal({"lafan1", "--all-links"}),
              HasSubstr("--all-links: not of --format lafan1 (valid: mjlab, json)"));
  EXPECT_THAT(refusal({"json", "--joints", "*"}), HasSubstr("--joints: not of --format json"));
  EXPECT_THAT(refusal({"mjlab", "--fps", "0"}), HasSubstr("--fps"));
}

}  // namespace
}  // namespace halfstep
