#include "tests/oracle/walk_truth.h"

#include <algorithm>
#include <cmath>

namespace halfstep::oracle {
namespace {

constexpr double kCoarse = 0.01, kFine = 2e-4;

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
  AddFootholdStatements();
  AddGroundStatements();
  AddLegStatements();
  AddBodyStatements();
  AddObstacleStatements();
  AddSolidStatements();
  AddDynamicStatements();
  Demand(demands);
}

WalkTruth::Instant& WalkTruth::At(double t, const std::array<Vector6, 2>& guess) {
  const auto [found, fresh] = instants_.try_emplace(t);
  Instant& at = found->second;
  if (!fresh) return at;
  at.t = t;
  at.state = walk_.At(static_cast<Real>(t));
  const auto &x = at.state.value, &v = at.state.rate;
  // The CoM is com_x ahead of the waist's origin.
  const double c = std::cos(x.waist_yaw), s = std::sin(x.waist_yaw);
  at.X_WB = Upright(x.com.x() - c * robot_.com_x, x.com.y() - s * robot_.com_x,
                    robot_.waist_height + x.waist_z, x.waist_yaw);
  const Eigen::Vector3d waist_velocity(v.com.x() + s * robot_.com_x * v.waist_yaw,
                                       v.com.y() - c * robot_.com_x * v.waist_yaw, v.waist_z);
  at.reaches = true;
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
  PlaceBodies(&at);
  return at;
}

void WalkTruth::PlaceBodies(Instant* at) const {
  at->bodies.assign(robot_.bodies.size(), {});
  at->centers.resize(robot_.bodies.size());
  at->placed.assign(robot_.bodies.size(), false);
  for (size_t b = 0; b < robot_.bodies.size(); ++b) {
    at->centers[b] = at->X_WB * (LinkOf(*at, b) * robot_.bodies[b].center);
  }
}

const Eigen::Isometry3d& WalkTruth::LinkOf(const Instant& at, size_t b) const {
  const auto [leg, j] = leg_link_[b];
  return leg < 0 ? X_BUpper_[static_cast<size_t>(robot_.bodies[b].link)]
                 : at.X_BLink[static_cast<size_t>(leg)][static_cast<size_t>(j)];
}

const ConvexSet& WalkTruth::BodyAt(Instant& at, size_t b) const {
  if (at.placed[b]) return at.bodies[b];
  const Eigen::Isometry3d X = at.X_WB * LinkOf(at, b);
  for (const Eigen::Vector3d& p : robot_.bodies[b].points) at.bodies[b].points.push_back(X * p);
  at.placed[b] = true;
  return at.bodies[b];
}

void WalkTruth::Demand(const Demands& demands) {
  demands_.margin = demands.margin;
  for (auto& [family, far] : far_) far = Demanded(family) + 0.03;
}

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
         [this, a, b, radii, &far = far_["self_clearance"]](Instant& at, const Stretch&) {
           if (!at.reaches) return Exactly(-kNever);
           const double apart = (at.centers[a] - at.centers[b]).norm() - radii;
           if (apart > far) return Exactly(apart);
           return DistanceOf(BodyAt(at, a), BodyAt(at, b));
         }});
  }
}

ConvexSet WalkTruth::SeenAtStart(size_t obstacle, double t, const ConvexSet& body) const {
  ConvexSet seen = body;
  for (Eigen::Vector3d& p : seen.points) p = scene_.AtStart(obstacle, t, p);
  return seen;
}

int WalkTruth::CountOf(const std::string& family) const {
  return static_cast<int>(std::count_if(statements_.begin(), statements_.end(),
                                        [&](const Statement& s) { return s.family == family; }));
}

void WalkTruth::AddObstacleStatements() {
  for (size_t b = 0; b < robot_.bodies.size(); ++b) {
    for (size_t o = 0; o < scene_.size(); ++o) {
      const double rate = 3.0 + scene_.speed(o);
      statements_.push_back(
          {"clearance", robot_.bodies[b].name + " - " + scene_.name(o), rate,
           [this, b, o, &far = far_["clearance"]](Instant& at, const Stretch&) {
             if (!at.reaches) return Exactly(-kNever);
             const double radius = robot_.bodies[b].radius;
             const double off = scene_.Uncertainty(o, at.t);
             const Eigen::Vector3d center = scene_.AtStart(o, at.t, at.centers[b]);
             // Without the body's points first: a piece's ball is often far
             // enough.
             const double quick = scene_.BallDistance(o, center, radius);
             if (quick > far + off) return Exactly(quick - off);
             Bracket apart =
                 scene_.Distance(o, SeenAtStart(o, at.t, BodyAt(at, b)), center, radius, far + off);
             apart.lower -= off;
             apart.upper -= off;
             return apart;
           }});
    }
  }
}

// All of the robot from the ground's solids, but a foot from those that are not above its sole.
void WalkTruth::AddSolidStatements() {
  for (size_t b = 0; b < robot_.bodies.size(); ++b) {
    const auto [leg, j] = leg_link_[b];
    for (const PlainSolid& solid : scene_.ground().solids()) {
      statements_.push_back(
          {"clearance", robot_.bodies[b].name + " - " + solid.name, 3.0,
           [this, b, foot = j == 5 ? leg : -1, &solid, &far = far_["clearance"]](Instant& at,
                                                                                 const Stretch&) {
             if (!at.reaches) return Exactly(-kNever);
             if (foot >= 0 &&
                 solid.top <= at.X_WSole[static_cast<size_t>(foot)].translation().z() + 1e-8) {
               return Exactly(kNever);
             }
             const double quick =
                 (at.centers[b] - solid.center).norm() - robot_.bodies[b].radius - solid.radius;
             if (quick > far) return Exactly(quick);
             return DistanceOf(BodyAt(at, b), solid.set);
           }});
    }
  }
}

void WalkTruth::Sample(const Statement& statement, const Stretch& stretch, double rate, double a,
                       const Bracket& at_a, double b, const Bracket& at_b, TrueMargin* least) {
  const double lowest = 0.5 * (at_a.upper + at_b.upper - rate * (b - a));
  if (!(lowest < Demanded(statement.family)) || b - a < 1.01 * kFine) return;
  const double middle = 0.5 * (a + b);
  const Instant& before = instants_.at(a);
  const Bracket value = statement.value(At(middle, before.q), stretch);
  Lower(least, value, middle, statement.subject);
  Sample(statement, stretch, rate, a, at_a, middle, value, least);
  Sample(statement, stretch, rate, middle, value, b, at_b, least);
}

// One statement on one stretch, at the times of the grid and between.
void WalkTruth::SampleStretch(const Statement& statement, const Stretch& stretch,
                              const std::vector<Instant*>& grid, TrueMargin* least) {
  std::vector<Bracket> values;
  double steepest = 0;
  const double before = least->value;
  for (size_t k = 0; k < grid.size(); ++k) {
    values.push_back(statement.value(*grid[k], stretch));
    Lower(least, values[k], grid[k]->t, statement.subject);
    if (k == 0) continue;
    const double fall = std::abs(values[k].upper - values[k - 1].upper);
    if (fall < kNever) steepest = std::max(steepest, fall / (grid[k]->t - grid[k - 1]->t));
  }
  const double rate = statement.has_cusps
                          ? statement.rate
                          : std::min(statement.rate, 4 * steepest + statement.rate / 40);
  for (size_t k = 1; k < grid.size(); ++k) {
    Sample(statement, stretch, rate, grid[k - 1]->t, values[k - 1], grid[k]->t, values[k], least);
  }
  if (least->value < before) {
    Descend(statement, stretch, grid[1]->t - grid[0]->t, least);
  }
}

// Golden section about the least margin that was found.
void WalkTruth::Descend(const Statement& statement, const Stretch& stretch, double width,
                        TrueMargin* least) {
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  double low = std::max(stretch.begin, least->t - width);
  double high = std::min(stretch.end, least->t + width);
  const std::array<Vector6, 2> guess = instants_.at(least->t).q;
  const auto value = [&](double t) {
    const Bracket found = statement.value(At(t, guess), stretch);
    Lower(least, found, t, statement.subject);
    return found.upper;
  };
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double at_a = value(a), at_b = value(b);
  while (high - low > 1e-5) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      a = high - golden * (high - low), at_a = value(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + golden * (high - low), at_b = value(b);
    }
  }
}

std::map<std::string, TrueMargin> WalkTruth::Least(const std::string& only) {
  std::map<std::string, TrueMargin> least;
  std::array<Vector6, 2> guess = {robot_.Standing(0), robot_.Standing(1)};
  for (const Stretch& stretch : walk_.stretches()) {
    const int n = std::max(1, static_cast<int>((stretch.end - stretch.begin) / kCoarse) + 1);
    std::vector<Instant*> instants;
    for (int k = 0; k <= n; ++k) {
      const double t = k == n ? stretch.end : stretch.begin + (stretch.end - stretch.begin) * k / n;
      instants.push_back(&At(t, guess));
      if (instants.back()->reaches) guess = instants.back()->q;
    }
    for (const Statement& statement : statements_) {
      if (!only.empty() && statement.family != only) continue;
      SampleStretch(statement, stretch, instants, &least[statement.family]);
    }
    if (!only.empty() && only != "clearance") continue;
    // Being inside a mesh begins and ends at distance 0, which the sampling would see.
    Instant& first = *instants.front();
    for (size_t o = 0; o < scene_.size(); ++o) {
      for (size_t b = 0; b < robot_.bodies.size(); ++b) {
        const auto seen = [&](const Eigen::Vector3d& p) { return scene_.AtStart(o, first.t, p); };
        if (!first.reaches || !scene_.MightSurround(o, seen(first.centers[b]))) continue;
        if (scene_.Around(o, seen(BodyAt(first, b).points[0])).surely()) {
          Lower(&least["clearance"], Exactly(-1), first.t,
                robot_.bodies[b].name + " inside " + scene_.name(o));
        }
      }
    }
  }
  return least;
}

TrueMargin WalkTruth::At(const std::string& family, double t, const std::string& subject) {
  std::array<Vector6, 2> guess = {robot_.Standing(0), robot_.Standing(1)};
  double nearest = 4 * kCoarse;  // of the instants that are known
  for (const auto& [s, instant] : instants_) {
    const double away = std::abs(s - t);
    if (!instant.reaches || away >= nearest) continue;
    nearest = away;
    guess = instant.q;
  }
  // Else from the start to t in steps, so that Newton's method stays in its branch.
  for (double s = 0; s < t && nearest == 4 * kCoarse; s += 3 * kCoarse) {
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
        const auto seen = [&](const Eigen::Vector3d& p) { return scene_.AtStart(o, t, p); };
        if (!scene_.MightSurround(o, seen(at.centers[b]))) continue;
        const std::string name = robot_.bodies[b].name + " - " + scene_.name(o);
        if (!subject.empty() && name != subject) continue;
        if (scene_.Around(o, seen(BodyAt(at, b).points[0])).maybe()) {
          Lower(&least, Exactly(0), t, name + " (inside)");
        }
      }
    }
  }
  return least;
}

}  // namespace halfstep::oracle
