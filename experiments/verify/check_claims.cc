#include "experiments/verify/check_claims.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "experiments/verify/check_rows.h"
#include "experiments/verify/floor_distances.h"
#include "wpg/input/text.h"

namespace halfstep::verify {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Instants this close to an interval's ends are not inside: the support may change there [s].
constexpr double kInside = 1e-9;
// Two evaluations of one margin differ by rounding [its unit].
constexpr double kRounding = 1e-8;

// What a row is about: a side, a leg's joint, a body and an obstacle, two bodies.
struct Subject {
  int first = -1, second = -1;
};

class Claims {
 public:
  Claims(const PlayedMotion& motion, const CertificateText& certificate, double tolerance,
         Distances* distances)
      : motion_(motion),
        robot_(motion.robot()),
        certificate_(certificate),
        tolerance_(tolerance),
        distances_(*distances) {
    for (int s = 0; s < 2; ++s) {
      const std::string side = s == 0 ? "left" : "right";
      for (Family f : {kFloor, kFootSpeed, kFootYawRate}) subjects_[f][side + " foot"] = {s, 0};
      subjects_[kReach][side + " leg"] = {s, 0};
      for (int j = 0; j < 6; ++j) {
        const std::string& name =
            robot_.legs[static_cast<size_t>(s)].joints[static_cast<size_t>(j)].name;
        subjects_[kJoint][name] = subjects_[kJointSpeed][name] = {s, j};
      }
    }
    for (Family f : {kFloor, kFootSpeed, kFootYawRate}) subjects_[f]["both feet"] = {};
    subjects_[kGround]["robot"] = {};
    for (int s = 0; s < 2; ++s) {
      const std::string foot = s == 0 ? "left foot" : "right foot";
      subjects_[kNoStep][foot] = {s, -1};
      for (size_t a = 0; a < distances_.scene().no_step.size(); ++a) {
        subjects_[kNoStep][foot + " - no_step[" + std::to_string(a) + "]"] = {s,
                                                                              static_cast<int>(a)};
      }
    }
    subjects_[kZmp]["both soles"] = subjects_[kZmp]["support sole"] = {};
    for (size_t b = 0; b < distances_.num_bodies(); ++b) {
      const int body = static_cast<int>(b);
      subjects_[kClearance][robot_.bodies[b].name] = {body, -1};
      subjects_[kGround][robot_.bodies[b].name] = {body, 0};
      for (size_t o = 0; o < distances_.num_obstacles(); ++o) {
        subjects_[kClearance][distances_.NameOfObstaclePair(b, o)] = {body, static_cast<int>(o)};
      }
    }
    for (const auto& [a, b] : robot_.self_pairs) {
      subjects_[kSelfClearance]
               [distances_.NameOfPair(static_cast<size_t>(a), static_cast<size_t>(b))] = {a, b};
    }
  }

  // What is wrong with a row; "": nothing.
  std::string Fault(const ClaimRow& row) {
    const auto found = subjects_[row.family].find(row.subject);
    if (found == subjects_[row.family].end()) return "nothing is called " + Quote(row.subject);
    Window(row);
    if (row.margin == kInfinity) {
      return row.family == kGround || row.family == kNoStep ? StandsUnwatched(row)
                                                            : MovesUnwatched(row);
    }
    if (row.family == kClearance || row.family == kSelfClearance) {
      return OfDistance(row, found->second);
    }
    if (row.family <= kFootYawRate && found->second.first < 0) return "no foot is named";
    if (row.family == kGround) {
      if (found->second.first < 0) return "no body is named";
      if (IsOnFoot(robot_.bodies[static_cast<size_t>(found->second.first)])) {
        return "a foot may touch the floor: it has no margin";
      }
    }
    if (row.family == kNoStep && found->second.second < 0) return "no area is named";
    return OfScalar(row, found->second);
  }

 private:
  // Rows of the trajectory strictly inside the interval: [first_, last_).
  void Window(const ClaimRow& row) {
    const auto& rows = motion_.rows();
    const auto at = [&rows](double t) {
      const auto before = [](const PlayedRow& r, double time) { return r.t < time; };
      return static_cast<size_t>(std::lower_bound(rows.begin(), rows.end(), t, before) -
                                 rows.begin());
    };
    first_ = at(row.begin + kInside);
    last_ = std::max(at(row.end - kInside), first_);
    mid_ = 0.5 * (row.begin + row.end);
  }

  bool Moves(Family family, size_t i, int side) const {
    return family == kFloor       ? MovesHorizontally(motion_, i, side)
           : family == kFootSpeed ? FootSpeed(motion_, i, side) > 1e-6
                                  : FootYawRate(motion_, i, side) > 1e-6;
  }

  // A margin without a value is one of a foot that stands, or that has no limit. A foot moves at an
  // instant inside when it moves between two rows inside, or in the pair of rows around the instant
  // and in both beside it.
  std::string MovesUnwatched(const ClaimRow& row) const {
    if (row.family == kFootSpeed && !certificate_.foot_speed) return "";
    if (row.family == kFootYawRate && !certificate_.foot_yaw_rate) return "";
    const size_t pairs = motion_.rows().size() - 1;
    for (size_t i = first_ == 0 ? 0 : first_ - 1; i < std::min(last_, pairs); ++i) {
      const bool inside = i >= first_ && i + 1 < last_;
      for (int side = 0; side < 2; ++side) {
        const auto around = [&](size_t k) { return k >= pairs || Moves(row.family, k, side); };
        if (Moves(row.family, i, side) &&
            (inside || ((i == 0 || around(i - 1)) && around(i + 1)))) {
          return Text("a foot moves at t = %.6g s", motion_.rows()[i].t);
        }
      }
    }
    return "";
  }

  // Bodies that are on no foot have a height; a foot that stands has a distance where there are
  // areas, and one always stands.
  std::string StandsUnwatched(const ClaimRow& row) const {
    if (row.family == kNoStep) {
      return distances_.scene().no_step.empty() ? "" : "a foot stands, and there are areas";
    }
    return std::all_of(robot_.bodies.begin(), robot_.bodies.end(), IsOnFoot)
               ? ""
               : "bodies have a height";
  }

  bool IsSpeed(Family family) const {
    return family == kFootSpeed || family == kFootYawRate || family == kJointSpeed;
  }

  // The margin at a row; speeds: between it and the next.
  double Scalar(Family family, Subject s, const PlayedRow& row, size_t i) const {
    switch (family) {
      case kFloor:
        return row.soles[static_cast<size_t>(s.first)][2];
      case kFootSpeed:
        return certificate_.foot_speed.value_or(kInfinity) - FootSpeed(motion_, i, s.first);
      case kFootYawRate:
        return certificate_.foot_yaw_rate.value_or(kInfinity) - FootYawRate(motion_, i, s.first);
      case kZmp:
        return ZmpMargin(row, robot_);
      case kReach:
        return ReachMargin(motion_, row, s.first);
      case kJoint:
        return JointMargin(robot_, row, s.first, s.second);
      case kJointSpeed:
        return JointSpeedMargin(motion_, i, s.first, s.second, certificate_.joint_speed_scale);
      case kGround:
        return LowestPoint(robot_.bodies[static_cast<size_t>(s.first)], motion_.PlaceRow(row));
      case kNoStep:
        return row.Stands(s.first)
                   ? FromArea(robot_, row.X_WS(s.first),
                              distances_.scene().no_step[static_cast<size_t>(s.second)])
                   : kInfinity;
      case kSelfClearance:
      case kClearance:
        break;  // OfDistance
    }
    return std::nan("");
  }

  std::string OfScalar(const ClaimRow& row, Subject subject) const {
    const auto& rows = motion_.rows();
    const bool speed = IsSpeed(row.family);
    const double least = row.margin - row.bound;
    // The mean speed between two rows inside is the speed at some instant between them (of a
    // foot's centre: at most).
    for (size_t i = first_; i + (speed ? 1 : 0) < last_; ++i) {
      const double rounding = speed ? kRounding + 1e-12 / (rows[i + 1].t - rows[i].t) : kRounding;
      const double value = Scalar(row.family, subject, rows[i], i);
      const bool above = row.family != kFootSpeed && value > row.margin + row.bound + rounding;
      if (value < least - rounding || above) {
        return Text("%s at t = %.6g s is %.9g, beyond %.9g ± %.9g", row.subject.c_str(), rows[i].t,
                    value, row.margin, row.bound);
      }
    }
    const auto [i, s] = motion_.Locate(mid_);
    if (speed) {
      // Accelerations: the speed at the midpoint lies between those of the pairs of rows around it,
      // give or take what they differ by.
      const size_t from = i == 0 ? 0 : i - 1, to = std::min(i + 1, rows.size() - 2);
      double lowest = kInfinity, highest = -kInfinity;
      for (size_t k = from; k <= to; ++k) {
        const double value = Scalar(row.family, subject, rows[k], k);
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
      }
      const double slack = 20 * tolerance_ + (highest - lowest);
      if (row.margin > highest + slack || row.margin < lowest - slack) {
        return Text("margin %.9g, but %.9g … %.9g by the rows around the midpoint", row.margin,
                    lowest, highest);
      }
      return "";
    }
    const PlayedRow middle = motion_.At(mid_);
    double value = Scalar(row.family, subject, middle, i);
    // Where the support changes within the pair of rows, either may be meant.
    const bool of_support = row.family == kZmp || row.family == kNoStep;
    if (of_support && rows[i].support != rows[i + 1].support) {
      PlayedRow other = middle;
      other.support = rows[i + 1].support;
      const double there = Scalar(row.family, subject, other, i);
      if (std::abs(there - row.margin) < std::abs(value - row.margin)) value = there;
    }
    if (!(std::abs(value - row.margin) <= tolerance_)) {
      return Text("margin %.9g, but %.9g by the trajectory", row.margin, value);
    }
    return "";
  }

  // Distance of a row's subject, or something at least `enough`.
  double Distance(const ClaimRow& row, Subject s, const Placement& at, double enough) {
    const size_t a = static_cast<size_t>(s.first), b = static_cast<size_t>(s.second);
    if (row.family == kSelfClearance) return distances_.OfPair(a, b, at, enough).distance;
    if (s.second >= 0) return distances_.FromObstacle(a, b, at, enough).distance;
    double least = kInfinity;
    for (size_t o = 0; o < distances_.num_obstacles(); ++o) {
      least = std::min(least, distances_.FromObstacle(a, o, at, enough).distance);
    }
    return least;
  }

  std::string OfDistance(const ClaimRow& row, Subject subject) {
    const Placement middle = motion_.Place(mid_);
    const double value = Distance(row, subject, middle, row.margin);
    if (!(value >= row.margin - tolerance_)) {
      return Text("margin %.9g, but %.9g by the trajectory", row.margin, value);
    }
    // Margins beyond a horizon are cut off, so a smaller one is no fault.
    if (first_ == last_) return "";
    for (size_t i : {first_, last_ - 1}) {
      const Placement at = motion_.PlaceRow(motion_.rows()[i]);
      const double least = row.margin - row.bound;
      const double there = Distance(row, subject, at, least);
      if (!(there >= least - kRounding - kMeshExcess)) {
        return Text("%.9g at t = %.6g s, below %.9g − %.9g", there, motion_.rows()[i].t, row.margin,
                    row.bound);
      }
      if (row.family != kClearance) continue;
      const double moved = Displacement(static_cast<size_t>(subject.first), middle, at);
      if (!(moved <= row.bound + tolerance_)) {
        return Text("the body moves %.9g until t = %.6g s, more than %.9g", moved,
                    motion_.rows()[i].t, row.bound);
      }
    }
    // Between two rows of the trajectory nothing is interpolated: both are within `bound` of the
    // midpoint.
    if (row.family == kClearance) {
      const double moved =
          Displacement(static_cast<size_t>(subject.first), motion_.PlaceRow(motion_.rows()[first_]),
                       motion_.PlaceRow(motion_.rows()[last_ - 1]));
      if (!(moved <= 2 * row.bound + kRounding)) {
        return Text("the body moves %.9g within the interval, more than twice %.9g", moved,
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

  // What triangles around a disc stand out, at most [m].
  static constexpr double kMeshExcess = 1.1e-4;

  const PlayedMotion& motion_;
  const RobotModel& robot_;
  const CertificateText& certificate_;
  const double tolerance_;
  Distances& distances_;
  std::array<std::map<std::string, Subject>, kNumFamilies> subjects_;
  size_t first_ = 0, last_ = 0;
  double mid_ = 0;
};

}  // namespace

void CheckClaims(const PlayedMotion& motion, const CertificateText& certificate,
                 const std::vector<ClaimRow>& rows, double tolerance, Distances* distances,
                 Findings* findings) {
  Claims claims(motion, certificate, tolerance, distances);
  long wrong = 0;
  for (const ClaimRow& row : rows) {
    const std::string fault = claims.Fault(row);
    if (fault.empty()) continue;
    ++wrong;
    findings->Disagree(Text("certificate.csv:%d: %s: ", row.line, kFamilyNames[row.family]) +
                       fault);
  }
  findings->Say("rows of the certificate against the trajectory: " + Count(std::ssize(rows)) +
                ", " + Count(wrong) + " wrong");
}

}  // namespace halfstep::verify
