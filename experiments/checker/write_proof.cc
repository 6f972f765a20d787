#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/checker/check_trajectory.h"
#include "experiments/checker/proof_file.h"
#include "wpg/files/input_error.h"
#include "wpg/nth.h"
#include "wpg/robot/gravity.h"

namespace halfstep::checker {
namespace {

using Json = nlohmann::ordered_json;
using verify::Family;

// What families say, for people; experiments/proof.md has the formulas.
constexpr std::array<const char*, verify::kNumFamilies> kSays = {
    "the swing sole is at least so high while it may move horizontally",
    "limit less speed of the swing sole's centre",
    "limit less yaw rate of the swing sole",
    "the plan's ZMP lies so far inside the hull of the soles that stand",
    "stretched leg less hip-ankle distance",
    "distance of leg joints from their limits",
    "joint_speed_scale times the limit, less the speed of leg joints",
    "distance of the watched pairs of bodies",
    "distance of bodies from obstacles, less how far these may be from where "
    "they are said to be",
    "height of bodies above the floor; a foot's may touch it",
    "distance of standing soles' outlines from the areas, which they may not "
    "touch",
    "the whole robot's ZMP lies so far inside the hull of the soles that stand",
    "limit less torque of leg joints",
    "friction coefficient less the one that two points of the soles need",
    "limit less acceleration of leg joints",
    "how long each half-step's ZMP goes from foot to foot",
    "v max(1, z / 1 cm) less how fast the swing sole sinks at the height z",
    "",
    ""};

Json ListOf(const Eigen::Ref<const Eigen::VectorXd>& v) {
  return std::vector<double>(v.begin(), v.end());
}
Json ColumnsOf(const Eigen::Ref<const Eigen::MatrixXd>& columns) {
  Json list = Json::array();
  for (Eigen::Index i = 0; i < columns.cols(); ++i) list.push_back(ListOf(columns.col(i)));
  return list;
}
Json FrameJson(const Eigen::Isometry3d& X) {
  return {{"R", ColumnsOf(X.linear().transpose())}, {"p_m", ListOf(X.translation())}};
}
Json BodyJson(const ConvexBody& body) {
  return {{"vertices_m", ColumnsOf(body.vertices)},
          {"disc_radius_m", body.disc_radius},
          {"ball_radius_m", body.ball_radius},
          {"center_m", ListOf(body.center)},
          {"radius_m", body.radius}};
}
Json MassJson(const BodyMass& body) {
  return {{"mass_kg", body.mass},
          {"com_m", ListOf(body.com)},
          {"inertia_kg_m2", ColumnsOf(body.inertia.transpose())}};
}
// A limit, null where there is none.
Json LimitJson(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }
Json LimitJson(const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); }

Json LegJson(const Leg& leg) {
  Json joints = Json::array();
  for (const LegJoint& joint : leg.joints) {
    joints.push_back({{"name", joint.name},
                      {"axis", ListOf(joint.axis_B)},
                      {"lower_rad", joint.lower},
                      {"upper_rad", joint.upper},
                      {"max_speed_rad_s", joint.max_speed},
                      {"max_acceleration_rad_s2", LimitJson(joint.max_acceleration)},
                      {"max_torque_n_m", LimitJson(joint.max_torque)},
                      {"link", FrameJson(joint.X_BLink)}});
  }
  return {{"hip_m", ListOf(leg.hip_B)},
          {"knee_m", ListOf(leg.joints[3].point_B)},
          {"ankle_m", ListOf(leg.ankle_B)},
          {"sole", FrameJson(leg.X_BSole)},
          {"standing_rad", ListOf(leg.standing_q)},
          {"joints", joints}};
}

Json RobotJson(const RobotModel& robot) {
  Json bodies = Json::array();
  for (const RobotBody& body : robot.bodies) {
    Json one = {{"name", body.name},
                {"leg", body.leg < 0 ? Json(nullptr) : Json(body.leg == 0 ? "left" : "right")},
                {"link", body.leg < 0 ? Json(nullptr) : Json(body.link)}};
    one.update(BodyJson(body.shape));
    bodies.push_back(one);
  }
  Json links = Json::object();
  for (size_t side = 0; side < 2; ++side) {
    Json& list = links[side == 0 ? "left" : "right"] = Json::array();
    for (const BodyMass& link : robot.masses.links[side]) list.push_back(MassJson(link));
  }
  return {{"name", robot.name},
          {"waist_height_m", robot.waist_height},
          {"com_height_m", robot.com_height},
          {"com_ahead_m", robot.com_x_B},
          {"sole_size_m", ListOf(robot.sole_size)},
          {"sole_outline_m", ColumnsOf(robot.sole_outline)},
          {"legs", {{"left", LegJson(robot.legs[0])}, {"right", LegJson(robot.legs[1])}}},
          {"bodies", bodies},
          {"watched_pairs", robot.self_pairs},
          {"masses", {{"waist", MassJson(robot.masses.waist)}, {"links", links}}}};
}

Json SceneJson(const Scene& scene) {
  Json obstacles = Json::array(), areas = Json::array();
  for (const Obstacle& obstacle : scene.obstacles) {
    const ObstacleMotion& motion = obstacle.motion;
    Json one = {{"name", obstacle.name}};
    one.update(BodyJson(BodyOfObstacle(obstacle)));
    Json waypoints = Json::array();
    for (const ObstacleMotion::Waypoint& to : motion.waypoints) {
      waypoints.push_back(
          {{"t_s", to.t}, {"position_m", ListOf(to.translation)}, {"yaw_rad", to.yaw}});
    }
    one.update({{"pose", FrameJson(obstacle.X_WO)},
                {"waypoints", waypoints},
                {"error_m", motion.error},
                {"speed_m_s", motion.speed},
                {"measured_at_s", motion.measured_at},
                {"horizon_s", LimitJson(motion.horizon)}});
    obstacles.push_back(one);
  }
  for (const Eigen::Matrix2Xd& area : scene.no_step) areas.push_back(ColumnsOf(area));
  return {{"name", scene.name},
          {"friction", scene.friction},
          {"obstacles", obstacles},
          {"no_step_m", areas}};
}

Json MotionJson(const WalkRun& walk) {
  const WalkTables& tables = walk.tables;
  Json footsteps = Json::array(), half_steps = Json::array();
  for (size_t i = 0; i < tables.footsteps.size(); ++i) {
    const verify::FootstepRow& row = tables.footsteps[i];
    Pose2 moved{};
    if (i >= 2) moved = tables.half_steps[2 * i - 3].form.value_or(tables.planned).footstep;
    footsteps.push_back({{"foot", row.foot},
                         {"x_m", row.X_WF.x},
                         {"y_m", row.X_WF.y},
                         {"yaw_rad", row.X_WF.yaw},
                         {"moved", {moved.x, moved.y, moved.yaw}},
                         {"via_height_m", row.via_height}});
  }
  for (const verify::HalfStepRow& row : tables.half_steps) {
    const verify::FormColumns form = row.form.value_or(tables.planned);
    half_steps.push_back({{"kind", row.kind},
                          {"support", row.support},
                          {"duration_s", row.duration},
                          {"height_scale", row.height_scale},
                          {"support_point_m", row.support_point}});
    for (const verify::FormColumn& column : verify::kFormColumns) {
      half_steps.back()[column.column] = form.*column.value;
    }
  }
  Json motion = {{"gravity_m_s2", kGravity}, {"crouch_m", walk.crouch}, {"footsteps", footsteps}};
  if (walk.overlaps) {
    motion["overlaps_s"] = *walk.overlaps;
  } else {
    for (const Interval& start : tables.starts) motion["starts_s"].push_back(start.Middle());
  }
  motion["half_steps"] = half_steps;
  return motion;
}

Json StatementJson(const WalkRun& walk, const std::vector<std::string>& not_covered) {
  const verify::CertificateText& certificate = walk.certificate;
  Json families = Json::array();
  for (size_t f = 0; f < verify::kNumFamilies; ++f) {
    if (certificate.demanded[f] == verify::kNotDemanded || kSays[f][0] == '\0') continue;
    families.push_back({{"family", verify::kFamilyNames[f]},
                        {"demanded", certificate.demanded[f]},
                        {"unit", verify::kUnits[f]},
                        {"margin", kSays[f]}});
  }
  return {{"words",
           "At every instant of the motion, from 0 to the end of its "
           "last half-step, every margin "
           "of every family is at least what is demanded; at most one "
           "foot is in the air."},
          {"families", families},
          {"foot_speed_m_s", LimitJson(certificate.foot_speed)},
          {"foot_yaw_rate_rad_s", LimitJson(certificate.foot_yaw_rate)},
          {"joint_speed_scale", certificate.joint_speed_scale},
          {"landing_speed_m_s", LimitJson(certificate.landing_speed)},
          {"not_covered", not_covered}};
}

Json HintsJson(const ProofHints& hints) {
  Json directions = Json::array();
  for (const auto& [statement, of] : hints.directions) {
    if (of.empty()) continue;
    const auto& [family, a, b] = statement;
    Json from = Json::array();
    for (const auto& [t, n] : of) from.push_back({t, n.x(), n.y(), n.z()});
    directions.push_back(
        {{"family", Nth(verify::kFamilyNames, family)}, {"a", a}, {"b", b}, {"from", from}});
  }
  return {{"times_s", hints.times}, {"directions", directions}};
}

}  // namespace

std::string ProofText(const ProofFile& proof, const std::vector<std::string>& not_covered) {
  const WalkRun& walk = proof.walk;
  const auto level = walk.scene.ground->OnlyLevel();
  if (!level || level->height != 0.0 || !walk.scene.ground->Solids().empty()) {
    throw InputError({"--proof: the scene has levels (valid here: a level floor at z = 0)"});
  }
  if (std::ranges::any_of(walk.tables.footsteps, [&](const verify::FootstepRow& row) {
        return row.crouch.value_or(walk.crouch) != walk.crouch;
      })) {
    throw InputError({"--proof: the waist changes its height (valid here: one `crouch_m`)"});
  }
  if (proof.hints.in_parts) {
    throw InputError({"--proof: a mesh is kept off by its triangles (valid here: by its hull)"});
  }
  if (walk.certificate.tube) {
    throw InputError({"--proof: the certificate is of a tube (valid here: of the walk alone)"});
  }
  for (const Leg& leg : walk.robot.legs) {
    if (leg.closed_form()) continue;
    throw InputError({"--proof: the robot's " + leg.offsets +
                      " (valid here: hip axes that meet, and ankle axes that do)"});
  }
  Json sources = Json::array();
  for (const InputFile& file : walk.files) {
    sources.push_back({{"file", file.name}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  }
  const Json whole = {{"format", "halfstep proof 1"},
                      {"walk", {{"run", proof.run}, {"method", proof.method}}},
                      {"statement", StatementJson(walk, not_covered)},
                      {"motion", MotionJson(walk)},
                      {"robot", RobotJson(walk.robot)},
                      {"scene", SceneJson(walk.scene)},
                      {"hints", HintsJson(proof.hints)},
                      {"sources", sources}};
  // A line for each member of a member.
  std::string text = "{";
  for (const auto& [key, value] : whole.items()) {
    text += (text.size() > 1 ? ",\n" : "\n") + Json(key).dump() + ": ";
    if (!value.is_object()) {
      text += value.dump();
      continue;
    }
    text += "{";
    bool first = true;
    for (const auto& [name, member] : value.items()) {
      text += (first ? "\n  " : ",\n  ") + Json(name).dump() + ": " + member.dump();
      first = false;
    }
    text += "}";
  }
  return text + "\n}\n";
}

}  // namespace halfstep::checker
