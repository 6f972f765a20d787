#include "experiments/survey/robot_survey.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "experiments/config/experiment.h"
#include "experiments/config/scaled_defaults.h"
#include "experiments/survey/arm_posture.h"
#include "experiments/survey/self_gaps.h"
#include "experiments/survey/touching_neighbours.h"
#include "planner/collision/separation.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/robot/robot_bodies.h"
#include "wpg/robot/robot_legs.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kFeetApart = 0.05;  // bodies of the feet, standing [m]
constexpr double kLift = 0.12;       // of the swing foot, at least, of the leg's length
constexpr double kExcess = 2e-3;     // of bodies over their meshes' hulls, of HRP-2's size [m]
constexpr double kArmsApart = 0.03;  // arms and legs, in six steps [m]

class Surveyor {
 public:
  explicit Surveyor(const SurveyRequest& request) : request_(request) {}

  RobotDraft Survey() {
    draft_.urdf_path = std::filesystem::absolute(request_.urdf).lexically_normal();
    draft_.name = request_.name.empty() ? request_.urdf.stem().string() : request_.name;
    draft_.packages = request_.packages;
    draft_.urdf = ReadUrdf(draft_.urdf_path.string());
    draft_.legs = FindLegs(draft_.urdf, request_.legs);
    draft_.R_LinkB = FindWaistRotation(draft_.urdf, draft_.legs);
    draft_.urdf.TurnFrame(draft_.legs.waist, draft_.R_LinkB);
    AskForTheClass();
    FindBodies();
    const RobotModel model = StandApart();
    const SelfGaps gaps(model, WalkedPostures(model));
    draft_.excluded = NeighboursThatTouch(draft_.urdf, draft_.legs, draft_.posture, model, gaps);
    const double scale = ScaleOf(model.legs[0]);
    for (const ArmTurn& turn : KeepArmsOff(draft_.urdf, draft_.legs.waist, draft_.posture, model,
                                           gaps, kArmsApart * scale)) {
      draft_.posture[static_cast<size_t>(turn.joint)] = turn.angle;
      draft_.why_posture[turn.joint] = turn.why;
    }
    return draft_;
  }

 private:
  static double ScaleOf(const Leg& leg) { return StretchedLength(leg) / 0.6; }

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
    Complaints complaints;
    for (size_t side = 0; side < 2; ++side) {
      leg.foot = draft_.legs.feet[side];
      const auto joints = FindLegJoints(urdf, leg.waist, leg.foot, &complaints);
      const auto built = joints ? LegGeometry(urdf, leg, *joints, &complaints) : std::nullopt;
      if (built) legs_[side] = *built;
    }
    complaints.ThrowIfAny();
    if (const std::string fault = MirrorFault(legs_[0], legs_[1], 1e-4); !fault.empty()) {
      throw InputError({urdf.file + ": " + fault});
    }
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
      draft_.soles = FindSoles(legs_, bodies_);
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
    for (const UrdfLink& link : draft_.urdf.links) {
      for (const UrdfCollision& collision : link.collisions) {
        if (collision.kind == UrdfCollision::Kind::kMesh && collision.mesh.ends_with(".dae")) {
          return true;
        }
      }
    }
    return false;
  }

  // How far the joints at the ends of the legs' links are from the links' bodies, all together [m].
  double FromJoints(const std::vector<RobotBody>& bodies) const {
    double sum = 0.0;
    for (const RobotBody& body : bodies) {
      if (body.leg < 0 || body.link > 4) continue;
      const Leg& leg = legs_[static_cast<size_t>(body.leg)];
      const auto i = static_cast<size_t>(body.link);
      const CollisionShape shape(body.shape), point(MakeSphere(1e-3));
      for (const size_t joint : {i, i + 1}) {
        Isometry3d X_BPoint = Isometry3d::Identity();
        X_BPoint.translation() = leg.joints[joint].point_B;
        sum += std::max(0.0, Separate(shape, leg.joints[i].X_BLink, point, X_BPoint).distance);
      }
    }
    return sum;
  }

  // The CoM ahead of the waist in the present posture [m].
  double ComAhead() const {
    const std::vector<Isometry3d> X = draft_.urdf.LinkPoses(draft_.posture);
    const Isometry3d X_BRoot = X[static_cast<size_t>(draft_.legs.waist)].inverse();
    double mass = 0.0, moment = 0.0;
    for (size_t i = 0; i < X.size(); ++i) {
      mass += draft_.urdf.links[i].mass;
      moment += draft_.urdf.links[i].mass * (X_BRoot * X[i] * draft_.urdf.links[i].com).x();
    }
    return mass > 0 ? moment / mass : 0.0;
  }

  static std::vector<Posture> WalkedPostures(const RobotModel& model) {
    return SampledPostures(model, SixSteps(model, DefaultHalfStep(model)));
  }

  // Stands as narrow as the feet allow, and then wider while the legs come too near to each other
  // in six steps.
  RobotModel StandApart() {
    StandingRequest& standing = draft_.standing;
    standing.width = request_.width;
    draft_.why_width = "as asked for";
    if (request_.width == 0.0) {
      const double apart = kFeetApart * ScaleOf(legs_[0]);
      standing.width = NarrowestStance(legs_, draft_.soles, bodies_, apart);
      draft_.why_width = standing.width > NarrowestStance(legs_, draft_.soles, {}, 0.0) + 1e-9
                             ? Formatted("so the feet are %.0f mm apart", 1e3 * apart)
                             : "as with straight legs";
    }
    Bend();
    Stand();
    RobotModel model = ModelOf(draft_);
    const double narrowest = standing.width, before = LegsApart(model);
    double best = before;
    for (int wider = 1; request_.width == 0.0 && best < kTouchByDesign && wider <= 5; ++wider) {
      RobotDraft other = draft_;
      std::swap(draft_, other);
      standing.width = narrowest * (1 + 0.1 * wider);
      draft_.why_width = Formatted("%.3f m apart the legs come within %.1f mm in six steps",
                                   narrowest, 1e3 * before);
      Stand();
      RobotModel wide = ModelOf(draft_);
      if (const double apart = LegsApart(wide); apart > best) {
        best = apart;
        model = std::move(wide);
      } else {
        std::swap(draft_, other);
      }
    }
    return model;
  }

  // Bends the knees less while the joints' limits keep the swing foot low.
  void Bend() {
    StandingRequest& standing = draft_.standing;
    if (request_.bend > 0.0) {
      standing.bend = request_.bend;
      return;
    }
    double best = 0.0, highest = -1.0;
    for (const double bend : {0.9, 0.92, 0.94, 0.96, 0.98}) {
      standing.bend = bend;
      if (!TryToStand().empty()) continue;
      const RobotMeasures measures = MeasuresOf(ModelOf(draft_, RobotParts::kLegs));
      if (measures.lift > highest) {
        highest = measures.lift;
        best = bend;
      }
      if (highest >= kLift * measures.leg_length) break;
    }
    standing.bend = best > 0.0 ? best : 0.9;
    draft_.why_bend =
        best > 0.9 ? "with more bend the joints' limits keep the swing foot lower" : "";
  }

  // How near the legs come to each other in six steps [m].
  static double LegsApart(const RobotModel& model) {
    double least = kTouchByDesign;
    const SelfGaps gaps(model, WalkedPostures(model));
    for (const SelfGap& gap : gaps.Nearer(kTouchByDesign)) {
      if (AreOfBothLegs(model, gap)) least = std::min(least, gap.least);
    }
    return least;
  }

  void Stand() {
    if (const std::string fault = TryToStand(); !fault.empty()) {
      throw InputError({draft_.urdf.file + ": " + fault});
    }
  }

  // Finds the legs' angles; "" or why there are none.
  std::string TryToStand() {
    StandingRequest& standing = draft_.standing;
    // The CoM moves with the legs: a few rounds are enough.
    for (int round = 0; round < 4; ++round) {
      standing.x = ComAhead();
      for (const Side side : {Side::kLeft, Side::kRight}) {
        const auto i = static_cast<size_t>(Index(side));
        const auto q = FindStanding(legs_[i], side, standing);
        if (!q) {
          return Formatted(
              "the %s foot cannot stand level below the CoM, %.3f m from the other, hip and ankle "
              "%.0f %% of the stretched leg apart, within the joints' limits (valid: another "
              "--bend "
              "or --width)",
              i == 0 ? "left" : "right", standing.width, 100 * standing.bend);
        }
        for (size_t k = 0; k < 6; ++k) {
          draft_.posture[static_cast<size_t>(draft_.legs.joints[i][k])] =
              (*q)[static_cast<Eigen::Index>(k)];
        }
      }
    }
    return "";
  }

  const SurveyRequest& request_;
  RobotDraft draft_;
  std::array<Leg, 2> legs_;
  std::vector<RobotBody> bodies_;
};

}  // namespace

RobotDraft SurveyRobot(const SurveyRequest& request) { return Surveyor(request).Survey(); }

HalfStep DefaultHalfStep(const RobotModel& robot) {
  ExperimentConfig config;
  ScaleDefaults(MeasuresOf(robot), &config);
  return PrototypeOf(config);
}

}  // namespace halfstep
