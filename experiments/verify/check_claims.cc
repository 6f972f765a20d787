#include "experiments/verify/check_claims.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "experiments/verify/check_rows.h"
#include "experiments/verify/claim_subjects.h"
#include "experiments/verify/double_support.h"
#include "experiments/verify/floor_distances.h"
#include "experiments/verify/joint_accelerations.h"
#include "experiments/verify/level_tops.h"
#include "experiments/verify/recent_instants.h"
#include "experiments/verify/tolerances.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep::verify {
namespace {

class Claims {
 public:
  Claims(const DescribedWalk& walk, const CertificateText& certificate, Distances* distances)
      : walk_(walk),
        robot_(walk.robot()),
        certificate_(certificate),
        distances_(*distances),
        near_(robot_),
        subjects_(robot_, *distances),
        levels_(distances->scene()),
        recent_(walk) {}

  // What is wrong with a row; "": nothing.
  std::string Fault(const ClaimRow& row) {
    if (row.family == kOwn) return "";  // not examined, as CheckArithmetic says
    const std::optional<ClaimSubject> found = subjects_.Find(row.family, row.subject);
    if (!found) return "nothing is called " + Quote(row.subject);
    const ClaimSubject subject = *found;
    if (NamesSoles(row.family) && !BearsAsNamed(row)) {
      return Quote(row.subject) + " does not bear the robot there";
    }
    if (row.family == kDoubleSupport) return FaultOfShift(walk_, row, subject.first);
    if (row.margin == kNoLimit) {
      if (MayBeLeftOut(row.family)) {
        if (certificate_.demanded[row.family] == kNotDemanded) return "";
        return IsOfDynamics(row.family) ? "the robot has a ZMP" : "the robot has limits";
      }
      if (row.family == kGround || row.family == kNoStep) return FaultOfNothing(row);
      if (row.family == kFoothold) return "a foot stands, and it does so on a level";
      const std::string fault = FaultOfUnwatched(row);
      return fault.empty() && subject.first >= 0 && IsOfSwingFoot(row.family)
                 ? "a foot is named, and none has a margin"
                 : fault;
    }
    if (row.family == kClearance || row.family == kSelfClearance) {
      return FaultOfDistance(row, subject);
    }
    if (IsOfSwingFoot(row.family) && subject.first < 0) return "no foot is named";
    if (row.family == kGround) {
      if (subject.first < 0) return "no body is named";
      if (verify::IsOnFoot(Nth(robot_.bodies, subject.first))) {
        return "a foot may touch the floor: it has no margin";
      }
    }
    if (row.family == kNoStep && subject.second < 0) return "no area is named";
    if (row.family == kFoothold && levels_.even()) return "the ground has one level";
    if (row.family == kFloor && subject.second >= 0) return FaultOfSolid(row, subject);
    return FaultOfScalar(row, subject);
  }

 private:
  // Ends and quarters of an interval, the midpoint first.
  std::array<double, 5> Instants(const ClaimRow& row) const {
    const double inside = std::min(near_.inside, 0.25 * (row.end - row.begin));
    const double middle = 0.5 * (row.begin + row.end), quarter = 0.25 * (row.end - row.begin);
    return {middle, row.begin + inside, middle - quarter, middle + quarter, row.end - inside};
  }

  static bool NamesSoles(Family family) {
    return family == kZmp || family == kZmpRobot || family == kFriction;
  }
  // Whether what bears the robot at the row's middle, or a little beside it, is what it names.
  bool BearsAsNamed(const ClaimRow& row) const {
    const double middle = 0.5 * (row.begin + row.end);
    const bool both = row.subject == "both soles";
    return std::ranges::any_of(
        std::array{middle - near_.inside, middle, middle + near_.inside},
        [&](double t) { return (walk_.SupportAt(t) == Support::kBoth) == both; });
  }

  // Whether a foot moves horizontally from a little before t to a little after it: a row may be
  // shorter than what the two walks' ends of the motion are rounded by.
  bool MovesAround(double t, int side) const {
    return walk_.MovesHorizontally(t - near_.inside, side) &&
           walk_.MovesHorizontally(t + near_.inside, side);
  }

  // A margin without a value is one of a foot that stands, or that has no limit.
  std::string FaultOfUnwatched(const ClaimRow& row) const {
    if (row.family == kFootSpeed && !certificate_.foot_speed) return "";
    if (row.family == kFootYawRate && !certificate_.foot_yaw_rate) return "";
    for (const double t : Instants(row)) {
      for (int side = 0; side < 2; ++side) {
        const bool moves = row.family == kFloor
                               ? MovesAround(t, side)
                               : walk_.At(t).first.segment<4>(SoleX(side)).norm() > near_.claim;
        if (moves) return Formatted("a foot moves at t = %.6g s", t);
      }
    }
    return "";
  }

  // Bodies that are on no foot have a height; a foot that stands has a distance where there are
  // areas, and one always stands.
  std::string FaultOfNothing(const ClaimRow& row) const {
    if (row.family == kNoStep) {
      return distances_.scene().no_step.empty() ? "" : "a foot stands, and there are areas";
    }
    return std::isinf(walk_.floor().Above(0)) ||  // there is no floor
                   std::all_of(robot_.bodies.begin(), robot_.bodies.end(), IsOnFoot)
               ? ""
               : "bodies have a height";
  }

  // Margin of a row's subject at an instant; nan: the family has none of this kind.
  double Scalar(Family family, ClaimSubject s, double t) {
    const int foot = SoleX(s.first);
    switch (family) {
      case kFloor:
        return walk_.floor().Above(walk_.At(t).value[foot + 2]);
      case kFootSpeed:
        return certificate_.foot_speed.value_or(kNoLimit) -
               walk_.At(t).first.segment<3>(foot).norm();
      case kFootYawRate:
        return certificate_.foot_yaw_rate.value_or(kNoLimit) -
               std::abs(walk_.At(t).first[foot + 3]);
      case kLandingSpeed: {
        const WalkInstant at = walk_.At(t);
        return LandingLimit(certificate_.landing_speed.value_or(kNoLimit),
                            at.value[foot + 2] - walk_.LandingHeight(t, s.first)) +
               at.first[foot + 2];
      }
      case kZmp:
        return ZmpMargin(recent_.Row(t), robot_);
      case kZmpRobot:
        return recent_.Dynamics(t).zmp;
      case kTorque:
        return recent_.Dynamics(t).TorqueMargin(robot_, static_cast<size_t>(s.first),
                                                static_cast<size_t>(s.second));
      case kJointAcceleration:
        return JointAccelerationMargin(walk_, t, static_cast<size_t>(s.first),
                                       static_cast<size_t>(s.second));
      case kFriction:
        return distances_.scene().friction - recent_.Dynamics(t).friction;
      case kReach:
        return ReachMargin(robot_, recent_.Row(t), s.first);
      case kJoint:
        return JointMargin(robot_, recent_.Row(t), s.first, s.second);
      case kJointSpeed: {
        const auto side = static_cast<size_t>(s.first), joint = static_cast<size_t>(s.second);
        return certificate_.joint_speed_scale * robot_.legs[side].joints[joint].max_speed -
               std::abs(recent_.JointSpeeds(t)[side][s.second]);
      }
      case kGround:
        return walk_.floor().Above(
            LowestPoint(Nth(robot_.bodies, s.first), PlaceRobot(robot_, recent_.Row(t))));
      case kNoStep: {
        const PlayedRow& row = recent_.Row(t);
        return row.Stands(s.first)
                   ? FromArea(robot_, row.X_WS(s.first), Nth(distances_.scene().no_step, s.second))
                   : kNoLimit;
      }
      case kFoothold:
        return LeastInside(recent_.Row(t));
      case kSelfClearance:
      case kClearance:
      case kDoubleSupport:
      case kOwn:
        break;
    }
    return std::nan("");
  }

  // How far inside its level the sole lies that does so least of those that stand [m].
  double LeastInside(const PlayedRow& row) const {
    double least = kNoLimit;
    for (const int side : {0, 1}) {
      if (!row.Stands(side)) continue;
      const double z = Nth(row.soles, side)[2];
      least = std::min(least, levels_.Inside(robot_, row.X_WS(side), z));
    }
    return least;
  }

  // Of a foot's distance from a solid of the ground: that is at least as stated.
  std::string FaultOfSolid(const ClaimRow& row, ClaimSubject subject) {
    const std::array<double, 5> instants = Instants(row);
    for (const double t : {instants[0], instants[1], instants[4]}) {
      const Eigen::Vector4d sole = walk_.At(t).value.segment<4>(SoleX(subject.first));
      const double least = t == instants[0] ? row.margin : row.margin - row.bound;
      const double there =
          distances_.SoleFromSolid(subject.first, sole, static_cast<size_t>(subject.second));
      if (!(there >= least - near_.distance)) {
        return Formatted("%s at t = %.6g s is %.9g, below %.9g − %.9g", row.subject.c_str(), t,
                         there, row.margin, t == instants[0] ? 0.0 : row.bound);
      }
    }
    return "";
  }

  // Whether the program's margin may be less than the height: distances from solids of the ground
  // are cut off.
  bool MayBeCutOff(const ClaimRow& row) const {
    return row.family == kFloor && !distances_.scene().ground->Solids().empty();
  }

  std::string FaultOfScalar(const ClaimRow& row, ClaimSubject subject) {
    const double rounding = row.family == kJointSpeed          ? near_.joint_speed
                            : row.family == kZmpRobot          ? near_.momentum
                            : row.family == kTorque            ? near_.torque
                            : row.family == kFriction          ? near_.friction
                            : row.family == kJointAcceleration ? near_.acceleration
                                                               : near_.claim;
    const std::array<double, 5> instants = Instants(row);
    const double middle = Scalar(row.family, subject, instants[0]);
    if (!(std::abs(middle - row.margin) <= rounding) &&
        !(MayBeCutOff(row) && middle >= row.margin)) {
      return Formatted("margin %.9g, but %.9g by the walk", row.margin, middle);
    }
    for (size_t k = 1; k < instants.size(); ++k) {
      const double value = Scalar(row.family, subject, instants[k]);
      // What matters is how far it falls.
      if (!(value >= row.margin - row.bound - rounding)) {
        return Formatted("%s at t = %.6g s is %.9g, beyond %.9g − %.9g", row.subject.c_str(),
                         instants[k], value, row.margin, row.bound);
      }
    }
    return "";
  }

  // Distance of a row's subject, or something at least `enough`.
  double Distance(const ClaimRow& row, ClaimSubject s, const Placement& at, double t,
                  double enough) {
    const size_t a = static_cast<size_t>(s.first), b = static_cast<size_t>(s.second);
    if (row.family == kSelfClearance) return distances_.OfPair(a, b, at, enough).distance;
    if (s.second >= 0) return distances_.FromObstacle(a, b, at, t, enough).distance;
    return distances_.FromAll(a, at, t, enough);
  }

  // Margins beyond a cap are cut off, so a smaller one than the distance is no fault.
  std::string FaultOfDistance(const ClaimRow& row, ClaimSubject subject) {
    const std::array<double, 5> instants = Instants(row);
    const Placement middle = PlaceRobot(robot_, recent_.Row(instants[0]));
    const double value = Distance(row, subject, middle, instants[0], row.margin);
    if (!(value >= row.margin - near_.distance)) {
      return Formatted("margin %.9g, but %.9g by the walk", row.margin, value);
    }
    for (const double t : {instants[1], instants[4]}) {
      const Placement at = PlaceRobot(robot_, recent_.Row(t));
      const double least = row.margin - row.bound;
      const double there = Distance(row, subject, at, t, least);
      if (!(there >= least - near_.distance)) {
        return Formatted("%.9g at t = %.6g s, below %.9g − %.9g", there, t, row.margin, row.bound);
      }
      if (row.family != kClearance) continue;
      double moved = Displacement(static_cast<size_t>(subject.first), middle, at);
      if (subject.second >= 0) {
        moved += distances_.ObstacleChange(static_cast<size_t>(subject.second), instants[0], t);
      }
      if (!(moved <= row.bound + near_.claim)) {
        return Formatted("body and obstacle move %.9g until t = %.6g s, more than %.9g", moved, t,
                         row.bound);
      }
    }
    return "";
  }

  // How far the body's vertices are apart, at most [m].
  double Displacement(size_t body, const Placement& a, const Placement& b) const {
    const RobotBody& of = robot_.bodies[body];
    const Eigen::Isometry3d X_a = a.OfBody(of), X_b = b.OfBody(of);
    double most = 0;
    for (Eigen::Index i = 0; i < of.shape.vertices.cols(); ++i) {
      const Eigen::Vector3d v = of.shape.vertices.col(i);
      most = std::max(most, (X_a * v - X_b * v).norm());
    }
    return most;
  }

  const DescribedWalk& walk_;
  const RobotModel& robot_;
  const CertificateText& certificate_;
  Distances& distances_;
  const Tolerances near_;
  const ClaimSubjects subjects_;
  const LevelTops levels_;
  RecentInstants recent_;
};

}  // namespace

void CheckClaims(const DescribedWalk& walk, const CertificateText& certificate,
                 const std::vector<ClaimRow>& rows, Distances* distances, Findings* findings) {
  Claims claims(walk, certificate, distances);
  long wrong = 0;
  for (const ClaimRow& row : rows) {
    const std::string fault = claims.Fault(row);
    if (fault.empty()) continue;
    ++wrong;
    findings->Disagree(Formatted("certificate.csv:%d: %s: ", row.line, kFamilyNames[row.family]) +
                       fault);
  }
  findings->Say("rows of the certificate against the walk: " + Count(std::ssize(rows)) + ", " +
                Count(wrong) + " wrong");
}

}  // namespace halfstep::verify
