#include "experiments/survey/robot_survey.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "experiments/survey/arm_posture.h"
#include "experiments/survey/found_frames.h"
#include "experiments/survey/self_gaps.h"
#include "experiments/survey/touching_neighbours.h"
#include "planner/collision/separation.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"
#include "wpg/robot/robot_bodies.h"
#include "wpg/robot/robot_legs.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kExcess = 2e-3;     // of bodies over their meshes' hulls, of HRP-2's size [m]
constexpr double kArmsApart = 0.03;  // arms and legs, in six steps [m]

class Surveyor {
 public:
  explicit Surveyor(const SurveyRequest& request) : request_(request) {}

  RobotSurvey Survey() {
    draft_.urdf_path = std::filesystem::absolute(request_.urdf).lexically_normal();
    const std::string stem = request_.urdf.stem().string();
    draft_.path = request_.out.empty()
                      ? draft_.urdf_path.parent_path() /
                            ((request_.name.empty() ? stem : request_.name) + ".yaml")
                      : std::filesystem::absolute(request_.out).lexically_normal();
    draft_.packages = request_.packages;
    draft_.urdf = ReadUrdf(draft_.urdf_path.string());
    const bool is_named = !draft_.urdf.name.empty() && NameMistake(draft_.urdf.name).empty();
    draft_.name = !request_.name.empty() ? request_.name : is_named ? draft_.urdf.name : stem;
    try {
      Find();
    } catch (const InputError& error) {
      return {draft_, error.complaints()};
    }
    return {draft_};
  }

 private:
  static double ScaleOf(const Leg& leg) { return StretchedLength(leg) / 0.6; }

  // Fills the draft, part after part. Throws InputError where the robot is not of the class.
  void Find() {
    draft_.legs = FindLegs(draft_.urdf, request_.legs);
    draft_.R_LinkB = FindWaistRotation(draft_.urdf, draft_.legs);
    draft_.urdf.TurnFrame(draft_.legs.waist, draft_.R_LinkB);
    AskForTheClass();
    FindBodies();
    const double apart = kArmsApart * ScaleOf(legs_[0]);
    Take(LowerArms(draft_.urdf, draft_.legs.waist, draft_.posture, bodies_, apart));
    const RobotModel model = StandApart(request_.stance, legs_, bodies_, &draft_);
    const SelfGaps gaps(model, WalkedPostures(model));
    draft_.excluded = NeighboursThatTouch(draft_.urdf, draft_.legs, draft_.posture, model, gaps);
    Take(KeepArmsOff(draft_.urdf, draft_.legs.waist, draft_.posture, model, gaps, apart));
  }

  void Take(const std::vector<ArmTurn>& turns) {
    for (const ArmTurn& turn : turns) {
      Nth(draft_.posture, turn.joint) = turn.angle;
      std::string& why = draft_.why_posture[turn.joint];
      why += (why.empty() ? "" : "; ") + turn.why;
    }
  }

  void AskForTheClass() {
    const UrdfTree& urdf = draft_.urdf;
    LegRequest leg;
    leg.waist = draft_.legs.waist;
    for (const UrdfJoint& joint : urdf.joints) {
      leg.lower.push_back(joint.lower);
      leg.upper.push_back(joint.upper);
      // As near to zero as the joint goes.
      draft_.posture.push_back(joint.kind == UrdfJoint::Kind::kRevolute
                                   ? std::clamp(0.0, joint.lower, joint.upper)
                                   : 0.0);
    }
    leg.posture.assign(urdf.joints.size(), 0.0);
    leg.torque.assign(urdf.joints.size(), std::numeric_limits<double>::infinity());
    leg.acceleration = leg.torque;
    Complaints complaints;
    for (size_t side = 0; side < 2; ++side) {
      leg.foot = draft_.legs.feet[side];
      const auto joints = FindLegJoints(urdf, leg.waist, leg.foot, &complaints);
      const auto built = joints ? LegGeometry(urdf, leg, *joints, &complaints) : std::nullopt;
      if (built) legs_[side] = *built;
    }
    complaints.ThrowIfAny();
  }

  void FindBodies() {
    BodyRequest request{.waist = draft_.legs.waist,
                        .leg_joints = draft_.legs.joints,
                        .posture = draft_.posture,
                        .packages = request_.packages,
                        .R_FootSole = {Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity()},
                        .hull_vertices = std::numeric_limits<int>::max()};
    Complaints complaints;
    bodies_ = BuildBodies(draft_.urdf, request, &complaints).bodies;
    complaints.ThrowIfAny();
    if (HasDae()) {
      request.dae_up_axis = true;
      std::vector<RobotBody> turned = BuildBodies(draft_.urdf, request, &complaints).bodies;
      if (FromJoints(turned) < 0.5 * FromJoints(bodies_)) {
        draft_.dae_up_axis = true;
        bodies_ = std::move(turned);
      }
    }
    try {
      draft_.soles = FindSoles(legs_, bodies_, request_.soles);
    } catch (const std::runtime_error& error) {
      throw InputError({draft_.urdf.file + ": " + error.what()});
    }
    for (size_t side = 0; side < 2; ++side) {
      legs_[side].X_BSole = legs_[side].joints[5].X_BLink * draft_.soles[side].X_FootSole;
      request.R_FootSole[side] = draft_.soles[side].X_FootSole.linear();
    }
    request.dae_up_axis = draft_.dae_up_axis;
    SimplifyHulls(std::move(request));
  }

  // As few vertices of a hull, from the default on, as keep bodies near to their meshes.
  void SimplifyHulls(BodyRequest request) {
    for (request.hull_vertices = draft_.hull_vertices; request.hull_vertices <= 1024;
         request.hull_vertices *= 2) {
      Complaints complaints;
      double excess = 0.0;
      for (const RobotBody& body : BuildBodies(draft_.urdf, request, &complaints).bodies) {
        excess = std::max(excess, body.excess);
      }
      if (draft_.excess == 0.0) draft_.excess = excess;
      draft_.hull_vertices = request.hull_vertices;
      if (excess <= kExcess * ScaleOf(legs_[0])) return;
    }
  }

  bool HasDae() const {
    return std::any_of(draft_.urdf.links.begin(), draft_.urdf.links.end(),
                       [](const UrdfLink& link) { return HasMesh(link, ".dae"); });
  }

  // How far the joints at the ends of the legs' links are from the links' bodies, all together [m].
  double FromJoints(const std::vector<RobotBody>& bodies) const {
    double sum = 0.0;
    for (const RobotBody& body : bodies) {
      if (body.leg < 0 || body.link > 4) continue;
      const Leg& leg = Nth(legs_, body.leg);
      const CollisionShape shape(body.shape), point(MakeSphere(1e-3));
      for (const int joint : {body.link, body.link + 1}) {
        Isometry3d X_BPoint = Isometry3d::Identity();
        X_BPoint.translation() = Nth(leg.joints, joint).point_B;
        sum += std::max(
            0.0, Separate(shape, Nth(leg.joints, body.link).X_BLink, point, X_BPoint).distance);
      }
    }
    return sum;
  }

  const SurveyRequest& request_;
  RobotDraft draft_;
  std::array<Leg, 2> legs_;
  std::vector<RobotBody> bodies_;
};

}  // namespace

RobotSurvey SurveyRobot(const SurveyRequest& request) { return Surveyor(request).Survey(); }

}  // namespace halfstep
