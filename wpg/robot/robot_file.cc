#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "wpg/elementary.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"
#include "wpg/files/yaml_fields.h"
#include "wpg/geometry/rotation.h"
#include "wpg/nth.h"
#include "wpg/robot/link_anchors.h"
#include "wpg/robot/robot_bodies.h"
#include "wpg/robot/robot_fields.h"
#include "wpg/robot/robot_legs.h"
#include "wpg/robot/robot_model.h"
#include "wpg/robot/robot_warnings.h"
#include "wpg/robot/self_pairs.h"
#include "wpg/robot/sole_outline.h"
#include "wpg/robot/urdf_masses.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace fs = std::filesystem;

constexpr double kDegree = std::numbers::pi / 180;
// How far the standing posture may be from flat, parallel and mirrored feet ([m] and [rad]).
constexpr double kStanding = 1e-4;
// In how much the right leg may differ from the left one's mirror image without a word ([m], [rad],
// …). Nothing that is proved takes one leg for the other.
constexpr double kRounding = 1e-6;
// How far a body may reach from its link, in heights of the waist: in other units it would.
constexpr double kFarthestBody = 10.0;
constexpr double kBelowSole = 1e-6;  // a foot's bodies may reach this far below its sole [m]

Isometry3d SoleInFoot(const LegFile& leg) {
  Isometry3d X = Isometry3d::Identity();
  X.translation() = Vector3d(leg.sole_xyz[0], leg.sole_xyz[1], leg.sole_xyz[2]);
  X.linear() = RotationOf(leg.sole_rpy);
  return X;
}

// Makes the model of a file whose keys are all valid by themselves.
class Builder {
 public:
  Builder(const RobotFile& file, Fields& fields, Complaints* complaints)
      : file_(file), urdf_(*file.urdf), fields_(fields), complaints_(complaints) {}

  RobotModel Build(RobotParts parts) {
    model_.name = file_.name;
    model_.sole_size = {file_.sole_size[0], file_.sole_size[1]};
    for (size_t i = 0; i < urdf_.joints.size(); ++i) {
      const bool own = !file_.limits_deg[i].empty();
      leg_.lower.push_back(own ? DegreesToRadians(file_.limits_deg[i][0]) : urdf_.joints[i].lower);
      leg_.upper.push_back(own ? DegreesToRadians(file_.limits_deg[i][1]) : urdf_.joints[i].upper);
      leg_.posture.push_back(DegreesToRadians(file_.posture_deg[i]));
      const double torque = file_.effort_limits[i].value_or(0.0);
      leg_.torque.push_back(torque > 0.0 ? torque : std::numeric_limits<double>::infinity());
      leg_.acceleration.push_back(
          file_.acceleration_limits[i].value_or(std::numeric_limits<double>::infinity()));
    }
    CheckPostureInLimits();
    leg_.waist = urdf_.FindLink(file_.waist_link);
    if (!BuildLegs()) return model_;
    Warn();
    CompareLegs();
    Stand();
    Weigh();
    if (parts == RobotParts::kAll) AddBodies();
    return model_;
  }

 private:
  void CheckPostureInLimits() {
    std::string faults;
    for (size_t i = 0; i < urdf_.joints.size(); ++i) {
      if (urdf_.joints[i].kind != UrdfJoint::Kind::kRevolute) continue;
      if (leg_.posture[i] < leg_.lower[i] - 1e-9 || leg_.posture[i] > leg_.upper[i] + 1e-9) {
        faults += (faults.empty() ? "" : "; ") + urdf_.joints[i].name + ": " +
                  Formatted("%.9g", file_.posture_deg[i]) +
                  " is outside its limits (valid: " + ShortestDegrees(leg_.lower[i]) + " … " +
                  ShortestDegrees(leg_.upper[i]) + ")";
      }
    }
    if (!faults.empty()) fields_.Complain("standing_posture_deg", faults);
  }

  bool BuildLegs() {
    bool ok = true;
    for (size_t side = 0; side < 2; ++side) {
      leg_.foot = urdf_.FindLink(file_.legs[side].foot_link);
      leg_.X_FootSole = SoleInFoot(file_.legs[side]);
      const auto joints = FindLegJoints(urdf_, leg_.waist, leg_.foot, complaints_);
      const auto leg = joints ? BuildLeg(urdf_, leg_, *joints, complaints_) : std::nullopt;
      if (leg) {
        model_.legs[side] = *leg;
        body_.leg_joints[side] = *joints;
      }
      ok = ok && leg.has_value();
    }
    if (ok && body_.leg_joints[0][0] == body_.leg_joints[1][0]) {
      fields_.Complain("legs", "both feet hang on the same leg");
      ok = false;
    }
    return ok;
  }

  void CompareLegs() {
    std::string list;
    for (const std::string& each : MirrorDifferences(model_.legs[0], model_.legs[1], kRounding)) {
      list += (list.empty() ? "" : ", ") + each;
    }
    if (list.empty()) return;
    model_.legs_are_mirrored = false;
    model_.warnings.push_back(urdf_.file +
                              ": the right leg differs from the left one's mirror image: " + list +
                              "; each leg is taken as it is");
  }

  void Warn() {
    model_.warnings = urdf_.warnings;
    for (const std::string& warning : file_.warnings) {
      model_.warnings.push_back(file_.name + ": " + warning);
    }
    for (size_t side = 0; side < 2; ++side) {
      const UrdfJoint& first = Nth(urdf_.joints, body_.leg_joints[side][0]);
      Tell(OffsetWarnings(model_.legs[side], first, urdf_.file));
    }
    Tell(HeldJointWarnings(urdf_));
  }

  void Tell(const std::vector<std::string>& warnings) {
    model_.warnings.insert(model_.warnings.end(), warnings.begin(), warnings.end());
  }

  // Waist height and width of stance; complains about feet that do not stand side by side.
  void Stand() {
    const Isometry3d left = LegForwardKinematics(model_.legs[0], model_.legs[0].standing_q)[6];
    const Isometry3d right = LegForwardKinematics(model_.legs[1], model_.legs[1].standing_q)[6];
    for (const auto& [name, X] : {std::pair{"left", left}, std::pair{"right", right}}) {
      const double tilt = Hypot(X(0, 2), X(1, 2)), yaw = Atan2(X(1, 0), X(0, 0));
      if (tilt > kStanding || X(2, 2) < 0) {
        fields_.Complain("standing_posture_deg",
                         std::string("the ") + name + " sole is not horizontal: it tilts by " +
                             Formatted("%.4g", Atan2(tilt, X(2, 2)) / kDegree) + " deg");
      } else if (std::abs(yaw) > kStanding) {
        fields_.Complain("standing_posture_deg", std::string("the ") + name +
                                                     " sole does not point forward: yaw " +
                                                     Formatted("%.4g", yaw / kDegree) + " deg");
      }
    }
    const Vector3d l = left.translation(), r = right.translation();
    if (std::abs(l.z() - r.z()) > kStanding) {
      fields_.Complain("standing_posture_deg",
                       "the soles are not at the same height: they differ "
                       "by " +
                           Formatted("%.4g", 1e3 * (l.z() - r.z())) + " mm");
    }
    if (std::abs(l.x() - r.x()) > kStanding || std::abs(l.y() + r.y()) > kStanding) {
      fields_.Complain("standing_posture_deg",
                       "the soles do not stand side by side, as mirror "
                       "images of each other");
    }
    if (l.y() <= r.y()) fields_.Complain("legs", "the left sole is not on the left (y > 0)");
    model_.waist_height = -(l.z() + r.z()) / 2;
    model_.standing_width = l.y() - r.y();
    if (file_.lift) model_.largest_lift = *file_.lift;
    model_.support_point = file_.support_point;
    // The waist's frame may lie on the floor; the hips do not.
    height_ = model_.waist_height + std::max(0.0, model_.legs[0].joints[0].point_B.z());
    if (height_ <= 0) {
      fields_.Complain("waist_link", "the hips are not above the soles in the standing posture");
    }
  }

  void Weigh() {
    const std::vector<Isometry3d> X = urdf_.LinkPoses(leg_.posture);
    const Isometry3d X_BRoot = Nth(X, leg_.waist).inverse();
    Vector3d moment = Vector3d::Zero();
    for (size_t i = 0; i < urdf_.links.size(); ++i) {
      model_.mass += urdf_.links[i].mass;
      moment += urdf_.links[i].mass * (X_BRoot * X[i] * urdf_.links[i].com);
    }
    if (!(model_.mass > 0)) {
      fields_.Complain("urdf", "no link has a mass: the CoM cannot be found");
      return;
    }
    // No part of a humanoid reaches twice as far as its legs are high.
    model_.masses = AddUpMasses(
        urdf_, FindAnchors(urdf_, leg_.waist, body_.leg_joints, leg_.posture), 2 * height_);
    Tell(MassWarnings(urdf_));
    model_.com_x_B = moment.x() / model_.mass;
    model_.com_height = file_.com_height.value_or(model_.waist_height + moment.z() / model_.mass);
  }

  void AddBodies() {
    body_.waist = leg_.waist;
    body_.posture = leg_.posture;
    body_.packages = file_.packages;
    body_.mesh_parts = file_.mesh_parts;
    body_.hull_vertices = file_.hull_vertices;
    for (size_t side = 0; side < 2; ++side) {
      const Leg& leg = model_.legs[side];
      body_.R_FootSole[side] = leg.joints[5].X_BLink.linear().transpose() * leg.X_BSole.linear();
    }
    body_.dae_up_axis = file_.dae_up_axis == "applied";
    if (height_ > 0) body_.farthest = kFarthestBody * height_;
    LinkBodies all = BuildBodies(urdf_, body_, complaints_);
    SelfPairs pairs = BuildSelfPairs(urdf_, file_.excluded, all, body_.leg_joints, model_.legs);
    model_.self_pairs = std::move(pairs.watched);
    model_.unwatched_pairs = std::move(pairs.unwatched);
    model_.bodies = std::move(all.bodies);
    FindBareLinks(all.links);
    Tell(SimplifiedWarnings(urdf_, model_.bodies, file_.hull_vertices));
    model_.files = std::move(all.meshes);
    model_.sole_outline = SoleOutline(model_);
    CheckSoles();
  }

  // `with_bodies`: the links of the bodies.
  void FindBareLinks(const std::vector<int>& with_bodies) {
    for (size_t i = 0; i < urdf_.links.size(); ++i) {
      const UrdfLink& link = urdf_.links[i];
      if (!(link.mass > 0.0) || std::ranges::count(with_bodies, static_cast<int>(i)) > 0) continue;
      model_.bare_links.push_back({link.name, link.mass});
    }
    std::ranges::stable_sort(model_.bare_links, std::ranges::greater(), &BareLink::mass);
  }

  void CheckSoles() {
    std::string faults;
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const double depth = DepthBelowSole(model_, side);
      if (depth <= kBelowSole) continue;
      faults += (faults.empty() ? "the " : "; the ") + std::string(Name(side)) + " foot reaches " +
                Formatted("%.6g", 1e3 * depth) + " mm below its sole";
    }
    if (faults.empty()) return;
    fields_.Complain("legs", faults +
                                 " (valid: at most 0.001 mm; put sole_xyz on the lowest point "
                                 "of the foot's bodies)");
  }

  const RobotFile& file_;
  const UrdfTree& urdf_;
  Fields& fields_;
  Complaints* complaints_;
  LegRequest leg_;
  BodyRequest body_;
  RobotModel model_;
  double height_ = 0.0;  // of waist or hips, standing: the higher one
};

}  // namespace

Eigen::Matrix3d RotationOf(const std::vector<double>& rpy) {
  if (rpy.empty()) return Eigen::Matrix3d::Identity();
  return RollPitchYaw(rpy[0], rpy[1], rpy[2]);
}

RobotModel LoadRobot(const std::string& yaml_path) {
  const std::string text = ReadYamlFile(yaml_path);
  return BuildRobot(yaml_path, text, ReadRobotFile(yaml_path, text));
}

RobotFile ReadRobotFile(const std::string& yaml_path, const std::string& text,
                        const UrdfTree* urdf) {
  RobotFile file;
  if (urdf != nullptr) file.urdf = *urdf;
  ReadYamlText(text, yaml_path, fs::path(yaml_path).parent_path().string(), {},
               [&file](Fields& fields) { DeclareFields(fields, &file); });
  if (!file.waist_rpy.empty()) {
    file.urdf->TurnFrame(file.urdf->FindLink(file.waist_link), RotationOf(file.waist_rpy));
  }
  return file;
}

RobotModel BuildRobot(const std::string& yaml_path, const std::string& text, RobotFile file,
                      RobotParts parts) {
  const std::string directory = fs::path(yaml_path).parent_path().string();
  // Every key is valid by itself. This reading is for complaints about how they go together, at
  // their places.
  RobotModel model;
  Complaints of_urdf;
  ReadYamlText(text, yaml_path, directory, {}, [&](Fields& fields) {
    DeclareFields(fields, &file);
    model = Builder(file, fields, &of_urdf).Build(parts);
  });
  model.files.insert(model.files.begin(), {RecordOf(yaml_path, text), file.urdf->source});
  of_urdf.ThrowIfAny();
  return model;
}

}  // namespace halfstep
