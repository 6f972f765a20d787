#include "tests/oracle/walk_truth.h"

#include <algorithm>
#include <cmath>

namespace halfstep::oracle {
namespace {

constexpr double kCoarse = 0.01, kFine = 5e-5;

Eigen::Isometry3d Upright(double x, double y, double z, double yaw) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  X.translation() = Eigen::Vector3d(x, y, z);
  return X;
}

void Lower(TrueMargin* least, const Bracket& value, double t, const std::string& subject) {
  least->lower = std::min(least->lower, value.lower);
  if (value.upper < least->value || std::isnan(value.upper)) {
    least->value = std::isnan(value.upper) ? -kNever : value.upper;
    least->t = t;
    least->subject = subject;
  }
}

}  // namespace

WalkTruth::WalkTruth(const PlainRobot& robot, const ClosedFormWalk& walk, const PlacedScene& scene,
                     const std::vector<std::vector<Eigen::Vector2d>>& no_step,
                     const Demands& demands)
    : robot_(robot), walk_(walk), scene_(scene), no_step_(no_step), demands_(demands) {
  for (int leg = 0; leg < 2; ++leg) {
    longest_[static_cast<size_t>(leg)] = robot.LongestReach(leg);
  }
  X_BUpper_ = robot.PlaceLinks({robot.Standing(0), robot.Standing(1)});
  for (const PlainRobot::Body& body : robot.bodies) {
    std::array<int, 2> of = {-1, -1};
    for (int leg = 0; leg < 2; ++leg) {
      for (int j = 0; j < 6; ++j) {
        const int joint = robot.legs[static_cast<size_t>(leg)].joints[static_cast<size_t>(j)];
        if (robot.links[static_cast<size_t>(body.link)].joint == joint) of = {leg, j};
      }
    }
    leg_link_.push_back(of);
  }
  AddFootStatements();
  AddGroundStatements();
  AddLegStatements();
  AddBodyStatements();
  AddObstacleStatements();
}

WalkTruth::Instant& WalkTruth::At(double t, const std::array<Vector6, 2>& guess) {
  const auto [found, fresh] = instants_.try_emplace(t);
  Instant& at = found->second;
  if (!fresh) return at;
  at.state = walk_.At(static_cast<Real>(t));
  const auto &x = at.state.value, &v = at.state.rate;
  // The CoM is com_x ahead of the waist's origin.
  const double c = std::cos(x.waist_yaw), s = std::sin(x.waist_yaw);
  at.X_WB = Upright(x.com.x() - c * robot_.com_x, x.com.y() - s * robot_.com_x, robot_.waist_height,
                    x.waist_yaw);
  const Eigen::Vector3d waist_velocity(v.com.x() + s * robot_.com_x * v.waist_yaw,
                                       v.com.y() - c * robot_.com_x * v.waist_yaw, 0);
  at.reaches = true;
  at.bodies.resize(robot_.bodies.size());
  at.centers.resize(robot_.bodies.size());
  at.placed.assign(robot_.bodies.size(), false);
  for (int leg = 0; leg < 2; ++leg) {
    const size_t i = static_cast<size_t>(leg);
    const Eigen::Vector4d &foot = x.feet[i], &rate = v.feet[i];
    at.X_WSole[i] = Upright(foot[0], foot[1], foot[2], foot[3]);
    at.q[i] = guess[i];
    const Eigen::Isometry3d X_BSole = at.X_WB.inverse() * at.X_WSole[i];
    at.reaches = robot_.SolveLeg(leg, X_BSole, &at.q[i]) && at.reaches;
    at.X_BLink[i] = robot_.PlaceLeg(leg, at.q[i]);
    const Eigen::Vector3d away = at.X_WSole[i].translation() - at.X_WB.translation();
    const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
    const Eigen::Matrix3d R = at.X_WB.linear().transpose();
    Vector6 twist;
    twist << R * (up * (rate[3] - v.waist_yaw)),
        R * (rate.head<3>() - waist_velocity - v.waist_yaw * up.cross(away));
    at.speed[i] = robot_.Jacobian(leg, at.X_BLink[i]).fullPivLu().solve(twist);
  }
  for (size_t b = 0; b < robot_.bodies.size(); ++b) {
    const auto [leg, j] = leg_link_[b];
    const Eigen::Isometry3d& X = leg < 0
                                     ? X_BUpper_[static_cast<size_t>(robot_.bodies[b].link)]
                                     : at.X_BLink[static_cast<size_t>(leg)][static_cast<size_t>(j)];
    at.centers[b] = at.X_WB * (X * robot_.bodies[b].center);
  }
  return at;
}

const ConvexSet& WalkTruth::BodyAt(Instant& at, size_t b) const {
  if (at.placed[b]) return at.bodies[b];
  const auto [leg, j] = leg_link_[b];
  const Eigen::Isometry3d X =
      at.X_WB * (leg < 0 ? X_BUpper_[static_cast<size_t>(robot_.bodies[b].link)]
                         : at.X_BLink[static_cast<size_t>(leg)][static_cast<size_t>(j)]);
  for (const Eigen::Vector3d& p : robot_.bodies[b].points) at.bodies[b].points.push_back(X * p);
  at.placed[b] = true;
  return at.bodies[b];
}

double WalkTruth::Far(const std::string& family) const { return Demanded(family) + 0.1; }

double WalkTruth::Demanded(const std::string& family) const {
  const auto found = demands_.margin.find(family);
  return found == demands_.margin.end() ? 0 : found->second;
}

void WalkTruth::AddBodyStatements() {
  for (const auto& [i, j] : robot_.watched) {
    const size_t a = static_cast<size_t>(i), b = static_cast<size_t>(j);
    const double radii = robot_.bodies[a].radius + robot_.bodies[b].radius;
    statements_.push_back(
        {"self_clearance", robot_.bodies[a].name + " - " + robot_.bodies[b].name, 4.0,
         [this, a, b, radii, far = Far("self_clearance")](Instant& at, const Stretch&) {
           if (!at.reaches) return Exactly(-kNever);
           const double apart = (at.centers[a] - at.centers[b]).norm() - radii;
           if (apart > far) return Exactly(apart);
           return DistanceOf(BodyAt(at, a), BodyAt(at, b));
         }});
  }
}

void WalkTruth::AddObstacleStatements() {
  for (size_t b = 0; b < robot_.bodies.size(); ++b) {
    for (size_t o = 0; o < scene_.size(); ++o) {
      statements_.push_back({"clearance", robot_.bodies[b].name + " - " + scene_.name(o), 3.0,
                             [this, b, o, far = Far("clearance")](Instant& at, const Stretch&) {
                               if (!at.reaches) return Exactly(-kNever);
                               const double radius = robot_.bodies[b].radius;
                               // Without the body's points first: a piece's ball is often far
                               // enough.
                               const double quick = scene_.BallDistance(o, at.centers[b], radius);
                               if (quick > far) return Exactly(quick);
                               return scene_.Distance(o, BodyAt(at, b), at.centers[b], radius, far);
                             }});
    }
  }
}

void WalkTruth::Sample(const Statement& statement, const Stretch& stretch, double a,
                       const Bracket& at_a, double b, const Bracket& at_b, TrueMargin* least) {
  const double lowest = 0.5 * (at_a.upper + at_b.upper - statement.rate * (b - a));
  if (!(lowest < Demanded(statement.family)) || b - a < 1.01 * kFine) return;
  const double middle = 0.5 * (a + b);
  const Instant& before = instants_.at(a);
  const Bracket value = statement.value(At(middle, before.q), stretch);
  Lower(least, value, middle, statement.subject);
  Sample(statement, stretch, a, at_a, middle, value, least);
  Sample(statement, stretch, middle, value, b, at_b, least);
}

std::map<std::string, TrueMargin> WalkTruth::Least() {
  std::map<std::string, TrueMargin> least;
  std::array<Vector6, 2> guess = {robot_.Standing(0), robot_.Standing(1)};
  for (const Stretch& stretch : walk_.stretches()) {
    const int n = std::max(1, static_cast<int>((stretch.end - stretch.begin) / kCoarse) + 1);
    std::vector<double> times;
    std::vector<Instant*> instants;
    for (int k = 0; k <= n; ++k) {
      times.push_back(k == n ? stretch.end : stretch.begin + (stretch.end - stretch.begin) * k / n);
      instants.push_back(&At(times.back(), guess));
      if (instants.back()->reaches) guess = instants.back()->q;
    }
    for (const Statement& statement : statements_) {
      TrueMargin& margin = least[statement.family];
      Bracket before;
      for (size_t k = 0; k < times.size(); ++k) {
        const Bracket here = statement.value(*instants[k], stretch);
        Lower(&margin, here, times[k], statement.subject);
        if (k > 0) Sample(statement, stretch, times[k - 1], before, times[k], here, &margin);
        before = here;
      }
    }
    // Being inside a mesh begins and ends at distance 0, which the sampling would see.
    Instant& first = *instants.front();
    for (size_t o = 0; o < scene_.size(); ++o) {
      for (size_t b = 0; b < robot_.bodies.size(); ++b) {
        if (!first.reaches || !scene_.MightSurround(o, first.centers[b])) continue;
        if (scene_.Around(o, BodyAt(first, b).points[0]).surely()) {
          Lower(&least["clearance"], Exactly(-1), times.front(),
                robot_.bodies[b].name + " inside " + scene_.name(o));
        }
      }
    }
  }
  return least;
}

TrueMargin WalkTruth::At(const std::string& family, double t, const std::string& subject) {
  // From the start to t in steps, so that Newton's method stays in its branch.
  std::array<Vector6, 2> guess = {robot_.Standing(0), robot_.Standing(1)};
  for (double s = 0; s < t; s += 3 * kCoarse) {
    const Instant& at = At(s, guess);
    if (at.reaches) guess = at.q;
  }
  Instant& at = At(t, guess);
  TrueMargin least;
  for (const Stretch& stretch : walk_.stretches()) {
    if (t < stretch.begin - 1e-11 || t > stretch.end + 1e-11) continue;
    for (const Statement& statement : statements_) {
      if (statement.family != family) continue;
      if (!subject.empty() && statement.subject != subject) continue;
      Lower(&least, statement.value(at, stretch), t, statement.subject);
    }
  }
  if (family == "clearance" && at.reaches) {
    for (size_t o = 0; o < scene_.size(); ++o) {
      for (size_t b = 0; b < robot_.bodies.size(); ++b) {
        if (!scene_.MightSurround(o, at.centers[b])) continue;
        const std::string name = robot_.bodies[b].name + " - " + scene_.name(o);
        if (!subject.empty() && name != subject) continue;
        if (scene_.Around(o, BodyAt(at, b).points[0]).maybe()) {
          Lower(&least, Exactly(0), t, name + " (inside)");
        }
      }
    }
  }
  return least;
}

}  // namespace halfstep::oracle
