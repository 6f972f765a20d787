#include "experiments/verify/tube_raise.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep::verify {
namespace {

using Eigen::Vector3d;

// The families that hold anywhere in a tube.
constexpr std::array kInTube = {kFloor,     kJoint,  kJointSpeed, kSelfClearance,
                                kClearance, kGround, kNoStep,     kZmpRobot};

// A walking robot as one line of points at q = 0 in B: the left sole, the left leg's axes from the
// ankle up, the right leg's from the hip down, the right sole. Points i and i + 1 are fixed to one
// link, the waist at i = 6; whatever is fixed to that link is said to be in gap i.
struct Line {
  static constexpr int kWaist = 6;

  explicit Line(const RobotModel& robot) {
    points[0] = robot.legs[0].X_BSole.translation();
    points[13] = robot.legs[1].X_BSole.translation();
    for (int j = 0; j < 6; ++j) {
      Nth(points, 6 - j) = robot.legs[0].AxisPoint(static_cast<size_t>(j));
      Nth(points, 7 + j) = robot.legs[1].AxisPoint(static_cast<size_t>(j));
    }
  }

  static int GapOf(const RobotBody& body) {
    if (body.leg < 0) return kWaist;
    return body.leg == 0 ? 5 - body.link : 7 + body.link;
  }

  std::array<Vector3d, 14> points;
};

// A body on the line, and how far its points may be from those of the line.
class OnLine {
 public:
  OnLine(const RobotModel& robot, const Line& line, const RobotBody& body)
      : gap_(Line::GapOf(body)) {
    const Eigen::Isometry3d X_BBody =
        body.leg < 0 ? Eigen::Isometry3d::Identity()
                     : Nth(Nth(robot.legs, body.leg).joints, body.link).X_BLink;
    const Eigen::Matrix3Xd vertices = X_BBody * Eigen::Matrix3Xd(body.shape.vertices);
    const auto farthest = [&](const Vector3d& from) {
      return std::sqrt((vertices.colwise() - from).colwise().squaredNorm().maxCoeff()) +
             body.shape.disc_radius + body.shape.ball_radius;
    };
    Nth(far_, gap_) = farthest(Nth(line.points, gap_));
    Nth(far_, gap_ + 1) = farthest(Nth(line.points, gap_ + 1));
    for (int i = gap_; i > 0; --i) {
      Nth(far_, i - 1) = Nth(far_, i) + (Nth(line.points, i) - Nth(line.points, i - 1)).norm();
    }
    for (int i = gap_ + 1; i < 13; ++i) {
      Nth(far_, i + 1) = Nth(far_, i) + (Nth(line.points, i) - Nth(line.points, i + 1)).norm();
    }
    of_waist_ = gap_ == Line::kWaist ? farthest(Vector3d::Zero())
                                     : Nth(far_, hip()) + Nth(line.points, hip()).norm();
  }

  int gap() const { return gap_; }
  double far(int point) const { return Nth(far_, point); }

  // How far it may be from its place.
  double Way(const Tube& tube) const {
    double waist = tube.waist + tube.waist_turn * of_waist_;
    if (gap_ < Line::kWaist) waist += tube.joint * Sum(gap_ + 1, Line::kWaist);
    if (gap_ > Line::kWaist) waist += tube.joint * Sum(Line::kWaist + 1, gap_);
    const double left = tube.foot + tube.foot_turn * far(0) + tube.joint * Sum(1, gap_);
    const double right = tube.foot + tube.foot_turn * far(13) + tube.joint * Sum(gap_ + 1, 12);
    if (gap_ < Line::kWaist) return std::min(waist, left);
    if (gap_ > Line::kWaist) return std::min(waist, right);
    return std::min({waist, left, right});
  }

 private:
  int hip() const { return gap_ < Line::kWaist ? Line::kWaist : Line::kWaist + 1; }
  double Sum(int first, int last) const {
    return std::accumulate(far_.begin() + first, far_.begin() + last + 1, 0.0);
  }

  int gap_;
  std::array<double, 14> far_{};
  double of_waist_ = 0.0;
};

// How much nearer two bodies may come, by what is between them or as each by itself.
double Nearer(const OnLine& a, const OnLine& b, const Tube& tube) {
  const auto [first, last] = std::minmax({a.gap(), b.gap()});
  double between = 0.0;
  for (int i = first + 1; i <= last; ++i) between += tube.joint * std::min(a.far(i), b.far(i));
  return std::min(between, a.Way(tube) + b.Way(tube));
}

}  // namespace

BodyWays::BodyWays(const Tube& tube, const RobotModel& robot) {
  const Line line(robot);
  std::vector<OnLine> on_line;
  for (const RobotBody& body : robot.bodies) {
    on_line.emplace_back(robot, line, body);
    bodies.push_back(on_line.back().Way(tube));
  }
  const auto count = static_cast<Eigen::Index>(on_line.size());
  nearer.setZero(count, count);
  for (Eigen::Index a = 0; a < count; ++a) {
    for (Eigen::Index b = 0; b < count; ++b) {
      nearer(a, b) = Nearer(Nth(on_line, a), Nth(on_line, b), tube);
    }
  }
}

std::array<double, kNumFamilies> FallInTube(const Tube& tube, const RobotModel& robot) {
  const BodyWays ways(tube, robot);
  std::array<double, kNumFamilies> fall{};
  for (size_t b = 0; b < robot.bodies.size(); ++b) {
    if (robot.bodies[b].link != 5) fall[kGround] = std::max(fall[kGround], ways.bodies[b]);
  }
  const double sole = tube.foot + tube.foot_turn * robot.sole_outline.colwise().norm().maxCoeff();
  fall[kFloor] = fall[kNoStep] = sole;
  fall[kZmpRobot] = tube.zmp + sole;
  fall[kJoint] = tube.joint;
  fall[kJointSpeed] = tube.joint_speed;
  return fall;
}

MarginLimits WithTube(const SmoothingConfig& config, const RobotModel& robot) {
  static_assert(kNumFamilies == kNumMarginFamilies);
  MarginLimits limits = config.limits;
  limits.raised = FallInTube(limits.tube, robot);
  return limits;
}

void CheckTube(const CertificateText& certificate, const SmoothingConfig& config,
               const RobotModel& robot, Findings* findings) {
  if (!certificate.tube) {
    if (config.limits.tube == Tube{}) return;  // of the walk alone
    return findings->Disagree("config.yaml has a tube, the certificate has none");
  }
  const auto& [tube, raised, of_body, of_pair] = *certificate.tube;
  if (tube != config.limits.tube) {
    findings->Disagree("the tube of the certificate is not that of config.yaml");
  }
  constexpr double kRounding = 1e-9;
  const std::array<double, kNumFamilies> fall = FallInTube(tube, robot);
  bool named = raised.size() == kInTube.size();
  for (const auto& [name, by] : raised) {
    const auto found = std::ranges::find(kFamilyNames, name);
    const auto family = static_cast<Family>(found - kFamilyNames.begin());
    if (found == kFamilyNames.end() || std::ranges::find(kInTube, family) == kInTube.end()) {
      named = false;
    } else if (!(std::abs(by - fall[family]) <= kRounding)) {
      findings->Disagree(
          Formatted("%s: the certificate says that the tube raises it by %.9g, but "
                    "it needs %.9g",
                    kFamilyNames[family], by, fall[family]));
    }
  }
  if (!named) findings->Disagree("tube: other families are raised than those that hold in it");
  const BodyWays ways(tube, robot);
  const double body = *std::ranges::max_element(ways.bodies);
  double pair = 0.0;
  for (const auto& [a, b] : robot.self_pairs) pair = std::max(pair, ways.nearer(a, b));
  if (!(std::abs(of_body - body) <= kRounding && std::abs(of_pair - pair) <= kRounding)) {
    findings->Disagree(
        Formatted("tube: the certificate says that it takes %.9g and %.9g m from "
                  "clearances, but it takes %.9g and %.9g",
                  of_body, of_pair, body, pair));
  }
  findings->Say(
      Formatted("tube: takes up to %.6g m from the clearance of a body, %.6g from that of "
                "a pair; floor falls by %.6g, zmp_robot by %.6g at most",
                body, pair, fall[kFloor], fall[kZmpRobot]));
}

}  // namespace halfstep::verify
