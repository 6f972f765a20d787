#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/checker/frame.h"
#include "experiments/checker/proof_file.h"
#include "experiments/verify/json_text.h"
#include "wpg/robot/gravity.h"

namespace halfstep::checker {
namespace {

using verify::JsonMember;
constexpr double kRigid = 1e-12;  // rotations and axes are exact to this
constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// A list of numbers, `size` of them unless that is 0.
Eigen::VectorXd Numbers(const JsonMember& of, const nlohmann::json& list, Eigen::Index size) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(list.size()));
  if (!list.is_array() || (size > 0 && v.size() != size)) of.Fail("has a list of a wrong size");
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    const nlohmann::json& number = list[static_cast<size_t>(i)];
    if (!number.is_number()) of.Fail("has no number in a list of numbers");
    v[i] = number.get<double>();
  }
  return v;
}
Eigen::MatrixXd Columns(const JsonMember& of, const nlohmann::json& list, Eigen::Index rows) {
  Eigen::MatrixXd columns(rows, static_cast<Eigen::Index>(list.size()));
  Eigen::Index i = 0;
  for (const nlohmann::json& point : list) columns.col(i++) = Numbers(of, point, rows);
  return columns;
}
Eigen::MatrixXd ColumnsIn(const JsonMember& of, const std::string& key, Eigen::Index rows) {
  return Columns(of, of.List(key), rows);
}
Eigen::Vector3d PointIn(const JsonMember& of, const std::string& key) {
  return Numbers(of, of.List(key), 3);
}
double AtLeast(double least, const JsonMember& of, const std::string& key) {
  const double x = of.Number(key);
  if (!(x >= least)) of.Fail(key + " is less than it can be");
  return x;
}
std::string SideIn(const JsonMember& of, const std::string& key) {
  const std::string side = of.String(key);
  if (side != "left" && side != "right") of.Fail(key + " is neither left nor right");
  return side;
}
size_t IndexIn(const JsonMember& of, const std::string& key, size_t size) {
  const long index = of.Whole(key);
  if (index < 0 || index >= static_cast<long>(size)) of.Fail(key + " counts too far");
  return static_cast<size_t>(index);
}

Eigen::Isometry3d FrameFrom(const JsonMember& of, const std::string& key) {
  const JsonMember frame = of.Object(key);
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  const Eigen::MatrixXd R = ColumnsIn(frame, "R", 3).transpose();
  if (R.rows() != 3 || !((R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < kRigid) ||
      !(R.determinant() > 0.0)) {
    frame.Fail("R is no rotation");
  }
  X.linear() = R;
  X.translation() = PointIn(frame, "p_m");
  return X;
}

ConvexBody BodyFrom(const JsonMember& of) {
  ConvexBody body;
  body.vertices = ColumnsIn(of, "vertices_m", 3);
  body.disc_radius = AtLeast(0.0, of, "disc_radius_m");
  body.ball_radius = AtLeast(0.0, of, "ball_radius_m");
  body.center = PointIn(of, "center_m");
  body.radius = AtLeast(0.0, of, "radius_m");
  if (body.vertices.cols() == 0) of.Fail("has no vertices");
  for (Eigen::Index i = 0; i < body.vertices.cols(); ++i) {
    const Vector away = VectorOf(body.vertices.col(i)) - VectorOf(body.center);
    const Interval beside = Sqrt(Square(away[0]) + Square(away[1])) + Interval(body.disc_radius);
    const Interval far = Sqrt(Square(beside) + Square(away[2])) + Interval(body.ball_radius);
    if (!(far.hi <= body.radius)) of.Fail("is not within radius_m of center_m");
  }
  MapDirections(&body);
  return body;
}

BodyMass MassFrom(const JsonMember& of) {
  const Eigen::MatrixXd inertia = ColumnsIn(of, "inertia_kg_m2", 3);
  if (inertia.cols() != 3) of.Fail("inertia_kg_m2 is no matrix");
  return {AtLeast(0.0, of, "mass_kg"), PointIn(of, "com_m"), inertia.transpose()};
}

Leg LegFrom(const JsonMember& of) {
  Leg leg;
  leg.hip_B = PointIn(of, "hip_m");
  leg.ankle_B = PointIn(of, "ankle_m");
  leg.X_BSole = FrameFrom(of, "sole");
  leg.standing_q = Numbers(of, of.List("standing_rad"), 6);
  const std::vector<JsonMember> joints = of.Items("joints");
  if (joints.size() != 6) of.Fail("has not six joints");
  for (size_t j = 0; j < 6; ++j) {
    LegJoint& joint = leg.joints[j];
    joint.name = joints[j].String("name");
    joint.axis_B = PointIn(joints[j], "axis");
    if (!(std::abs(joint.axis_B.squaredNorm() - 1.0) < kRigid)) joints[j].Fail("axis is no unit");
    joint.point_B = j < 3 ? leg.hip_B : j == 3 ? PointIn(of, "knee_m") : leg.ankle_B;
    joint.lower = joints[j].Number("lower_rad");
    joint.upper = joints[j].Number("upper_rad");
    joint.max_speed = joints[j].Number("max_speed_rad_s");
    joint.max_acceleration = joints[j].NumberOrNull("max_acceleration_rad_s2").value_or(kNoLimit);
    joint.max_torque = joints[j].NumberOrNull("max_torque_n_m").value_or(kNoLimit);
    joint.X_BLink = FrameFrom(joints[j], "link");
  }
  return leg;
}

RobotModel RobotFrom(const JsonMember& of) {
  RobotModel robot;
  robot.name = of.String("name");
  robot.waist_height = of.Number("waist_height_m");
  robot.com_height = of.Number("com_height_m");
  robot.com_x_B = of.Number("com_ahead_m");
  robot.sole_size = Numbers(of, of.List("sole_size_m"), 2);
  robot.sole_outline = ColumnsIn(of, "sole_outline_m", 2);
  if (!(robot.sole_size.minCoeff() > 0.0) || robot.sole_outline.cols() == 0)
    of.Fail("has no soles");
  const JsonMember masses = of.Object("masses"), links = masses.Object("links");
  robot.masses.waist = MassFrom(masses.Object("waist"));
  robot.masses.fault = "";
  for (size_t side = 0; side < 2; ++side) {
    const char* const name = side == 0 ? "left" : "right";
    robot.legs[side] = LegFrom(of.Object("legs").Object(name));
    if (links.List(name).size() != 6) links.Fail("has not six links a leg");
    for (size_t i = 0; i < 6; ++i) robot.masses.links[side][i] = MassFrom(links.Items(name)[i]);
  }
  for (const JsonMember& body : of.Items("bodies")) {
    RobotBody& one = robot.bodies.emplace_back();
    one.name = body.String("name");
    one.shape = BodyFrom(body);
    if (!body.object().contains("leg")) body.Fail("leg is missing");
    if (body.object()["leg"].is_null()) continue;
    one.leg = SideIn(body, "leg") == "left" ? 0 : 1;
    one.link = static_cast<int>(IndexIn(body, "link", 6));
  }
  for (const nlohmann::json& pair : of.List("watched_pairs")) {
    const Eigen::Vector2d ab = Numbers(of, pair, 2);
    const auto size = static_cast<double>(robot.bodies.size());
    if (!(ab.minCoeff() >= 0.0 && ab.maxCoeff() < size) || ab != ab.array().floor().matrix()) {
      of.Fail("watched_pairs counts too far");
    }
    robot.self_pairs.push_back({static_cast<int>(ab[0]), static_cast<int>(ab[1])});
  }
  return robot;
}

Scene SceneFrom(const JsonMember& of) {
  Scene scene;
  scene.name = of.String("name");
  scene.friction = of.Number("friction");
  for (const JsonMember& item : of.Items("obstacles")) {
    Obstacle& obstacle = scene.obstacles.emplace_back();
    obstacle.name = item.String("name");
    obstacle.shape = BodyFrom(item);
    obstacle.X_WO = FrameFrom(item, "pose");
    ObstacleMotion& motion = obstacle.motion;
    motion.error = AtLeast(0.0, item, "error_m");
    motion.speed = AtLeast(0.0, item, "speed_m_s");
    motion.measured_at = item.Number("measured_at_s");
    motion.horizon = item.NumberOrNull("horizon_s").value_or(kNoLimit);
    double last = 0.0;
    for (const JsonMember& to : item.Items("waypoints")) {
      motion.waypoints.push_back(
          {to.Number("t_s"), PointIn(to, "position_m"), to.Number("yaw_rad")});
      if (!(motion.waypoints.back().t > std::exchange(last, motion.waypoints.back().t))) {
        to.Fail("t_s does not increase");
      }
    }
  }
  for (const nlohmann::json& area : of.List("no_step_m")) {
    scene.no_step.emplace_back(Columns(of, area, 2));
    if (area.empty()) of.Fail("no_step_m has an area without corners");
  }
  return scene;
}

void ReadMotion(const JsonMember& of, WalkRun* walk) {
  if (of.Number("gravity_m_s2") != kGravity) of.Fail("gravity_m_s2 is another (valid here: 9.81)");
  walk->crouch = of.Number("crouch_m");
  WalkTables& tables = walk->tables;
  tables.crouch = walk->crouch;
  tables.com_height = Interval(walk->robot.com_height) - Interval(walk->crouch);
  if (!(tables.com_height.lo > 0.0)) of.Fail("the pendulum has no length");
  std::vector<Pose2> moves;
  for (const JsonMember& item : of.Items("footsteps")) {
    verify::FootstepRow& row = tables.footsteps.emplace_back();
    row.footstep = std::max(0, static_cast<int>(tables.footsteps.size()) - 2);
    row.foot = SideIn(item, "foot");
    row.X_WF = {item.Number("x_m"), item.Number("y_m"), item.Number("yaw_rad")};
    row.via_height = item.Number("via_height_m");
    const Eigen::Vector3d moved = PointIn(item, "moved");
    moves.push_back({moved[0], moved[1], moved[2]});
  }
  if (moves.size() >= 2 && tables.footsteps[0].foot == tables.footsteps[1].foot) {
    of.Fail("footsteps begin with one foot twice");
  }
  for (const JsonMember& item : of.Items("half_steps")) {
    verify::HalfStepRow& row = tables.half_steps.emplace_back();
    row.kind = item.String("kind");
    row.support = SideIn(item, "support");
    row.duration = item.Number("duration_s");
    if (!(row.duration <= 60.0)) item.Fail("duration_s is more than 60 s");
    row.height_scale = item.Number("height_scale");
    row.support_point = item.Number("support_point_m");
    verify::FormColumns& form = row.form.emplace();
    for (const verify::FormColumn& column : verify::kFormColumns) {
      form.*column.value = item.Number(column.column);
    }
    const size_t footstep = (tables.half_steps.size() - 1) / 2 + 2;
    if (footstep < moves.size()) form.footstep = moves[footstep];
  }
  const size_t n = tables.half_steps.size();
  const bool overlapped = of.object().contains("overlaps_s");
  const char* const key = overlapped ? "overlaps_s" : "starts_s";
  const Eigen::VectorXd times = Numbers(of, of.List(key), 0);
  if (n == 0 || static_cast<size_t>(times.size()) != (overlapped ? n - 1 : n) ||
      times.lpNorm<Eigen::Infinity>() > 1e5 || (!overlapped && times[0] != 0.0)) {
    of.Fail(std::string(key) + " is not of these half-steps");
  }
  if (overlapped) walk->overlaps.emplace(times.begin(), times.end());
  for (size_t i = 0; i < n; ++i) {
    tables.starts.emplace_back(overlapped ? 0.0 : times[static_cast<Eigen::Index>(i)]);
    if (!overlapped || i == 0) continue;
    const Interval end = tables.starts[i - 1] + Interval(tables.half_steps[i - 1].duration);
    tables.starts[i] = end - Interval((*walk->overlaps)[i - 1]);
  }
}

void ReadStatement(const JsonMember& of, WalkRun* walk) {
  verify::CertificateText& certificate = walk->certificate;
  certificate.demanded.fill(verify::kNotDemanded);
  for (const JsonMember& item : of.Items("families")) {
    const auto at = std::ranges::find(verify::kFamilyNames, item.String("family"));
    const auto family = static_cast<size_t>(at - verify::kFamilyNames.begin());
    if (family >= verify::kFoothold || item.String("unit") != verify::kUnits[family] ||
        certificate.demanded[family] != verify::kNotDemanded) {
      item.Fail("is of no family that is known, in its unit, once");
    }
    certificate.demanded[family] = item.Number("demanded");
  }
  certificate.foot_speed = of.NumberOrNull("foot_speed_m_s");
  certificate.foot_yaw_rate = of.NumberOrNull("foot_yaw_rate_rad_s");
  certificate.joint_speed_scale = of.Number("joint_speed_scale");
  certificate.landing_speed = of.NumberOrNull("landing_speed_m_s");
  for (const nlohmann::json& sentence : of.List("not_covered")) {
    walk->not_covered.push_back(sentence.is_string() ? sentence.get<std::string>() : "?");
  }
}

ProofHints HintsFrom(const JsonMember& of) {
  ProofHints hints;
  hints.told = true;
  const Eigen::VectorXd times = Numbers(of, of.List("times_s"), 0);
  hints.times.assign(times.begin(), times.end());
  for (const JsonMember& item : of.Items("directions")) {
    const auto at = std::ranges::find(verify::kFamilyNames, item.String("family"));
    const int family = static_cast<int>(at - verify::kFamilyNames.begin());
    ProofHints::Directions& told =
        hints.directions[{family, IndexIn(item, "a", 1'000'000), IndexIn(item, "b", 1'000'000)}];
    for (const nlohmann::json& one : item.List("from")) {
      const Eigen::VectorXd from = Numbers(item, one, 4);
      if (std::abs(from.tail(3).norm() - 1.0) > 1e-6) item.Fail("a direction is no unit vector");
      if (!told.empty() && !(told.back().first <= from[0])) item.Fail("times are out of order");
      told.emplace_back(from[0], from.tail(3));
    }
  }
  return hints;
}

}  // namespace

ProofFile ReadProof(const std::string& path, const std::string& text) {
  const nlohmann::json json = verify::ParseJson(path, text);
  const JsonMember root(path, json, "");
  if (root.String("format") != "halfstep proof 1") root.Fail("is no proof of this format");
  ProofFile proof;
  const JsonMember walk = root.Object("walk");
  proof.run = walk.String("run");
  proof.method = walk.String("method");
  proof.walk.robot = RobotFrom(root.Object("robot"));
  proof.walk.scene = SceneFrom(root.Object("scene"));
  ReadMotion(root.Object("motion"), &proof.walk);
  ReadStatement(root.Object("statement"), &proof.walk);
  proof.hints = HintsFrom(root.Object("hints"));
  for (const JsonMember& file : root.Items("sources")) {
    proof.walk.files.push_back(
        {file.String("file"), "", static_cast<size_t>(file.Whole("bytes")), file.String("sha256")});
  }
  return proof;
}

}  // namespace halfstep::checker
