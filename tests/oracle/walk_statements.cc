// The oracle's statements about feet and legs.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "tests/oracle/plain_soles.h"
#include "tests/oracle/walk_truth.h"

namespace halfstep::oracle {
namespace {

constexpr std::array<const char*, 2> kFeet = {"left foot", "right foot"};

// A foot's height over the floor, and the distance of its outline, laid flat at that height, from
// the ground's solids.
Bracket FlatFootAbove(const PlainGround& ground, const Polygon& own, const Polygon& both,
                      const Eigen::Vector4d& place) {
  Bracket least = Exactly(ground.has_floor() ? place[2] : kNever);
  for (const bool all : {false, true}) {
    ConvexSet flat;
    double reach = 0;
    for (const Eigen::Vector2d& p : Standing(all ? both : own, place)) {
      flat.points.emplace_back(p.x(), p.y(), place[2]);
      reach = std::max(reach, (p - place.head<2>()).norm());
    }
    double& bound = all ? least.lower : least.upper;
    for (const PlainSolid& solid : ground.solids()) {
      if ((place.head<3>() - solid.center).norm() - reach - solid.radius > bound) continue;
      const Bracket here = DistanceOf(flat, solid.set);
      bound = std::min(bound, all ? here.lower : here.upper);
    }
  }
  return least;
}

}  // namespace

// No-step areas and the height of all bodies but the feet's, whose soles may touch the floor.
void WalkTruth::AddGroundStatements() {
  // Both feet's outlines together are what the project takes; one foot's own is what touches.
  Polygon both = Touching(robot_, 0, 1e-3);
  for (const Eigen::Vector2d& p : Touching(robot_, 1, 1e-3)) both.push_back(p);
  for (size_t foot = 0; foot < 2; ++foot) {
    for (size_t k = 0; k < no_step_.size(); ++k) {
      statements_.push_back({"no_step", std::string(kFeet[foot]) + " - area" + std::to_string(k),
                             3.0,
                             [this, foot, k, both, own = Touching(robot_, foot, 1e-9)](
                                 Instant& at, const Stretch& s) {
                               if (s.in_air == static_cast<int>(foot)) return Exactly(kNever);
                               const Eigen::Vector4d& place = at.state.value.feet[foot];
                               return Bracket{Apart(Standing(both, place), no_step_[k]),
                                              Apart(Standing(own, place), no_step_[k])};
                             }});
    }
  }
  for (size_t b = 0; b < robot_.bodies.size(); ++b) {
    const bool on_foot = leg_link_[b][1] == 5;
    statements_.push_back({"ground", robot_.bodies[b].name, 3.0,
                           [this, b, on_foot, &far = far_["ground"]](Instant& at, const Stretch&) {
                             if (!at.reaches) return Exactly(-kNever);
                             if (!scene_.ground().has_floor()) return Exactly(kNever);
                             const double bound = at.centers[b].z() - robot_.bodies[b].radius;
                             if (bound > far) return Exactly(bound);
                             double lowest = kNever;
                             for (const Eigen::Vector3d& p : BodyAt(at, b).points)
                               lowest = std::min(lowest, p.z());
                             // A sole that stands is at 0 but for rounding.
                             return Exactly(on_foot && lowest >= -1e-8 ? kNever : lowest);
                           }});
  }
}

// How far what stands on the ground is inside its level. It rests, so each place is asked once.
void WalkTruth::AddFootholdStatements() {
  if (!scene_.ground().has_levels()) return;
  Polygon both = Touching(robot_, 0, 1e-3);
  for (const Eigen::Vector2d& p : Touching(robot_, 1, 1e-3)) both.push_back(p);
  for (size_t foot = 0; foot < 2; ++foot) {
    const auto known = std::make_shared<std::map<std::array<double, 4>, Bracket>>();
    statements_.push_back(
        {"foothold", kFeet[foot], 3.0,
         [this, foot, both, known, own = Touching(robot_, foot, 1e-9)](Instant& at,
                                                                       const Stretch& s) {
           if (s.in_air == static_cast<int>(foot)) return Exactly(kNever);
           const Eigen::Vector4d& place = at.state.value.feet[foot];
           const auto [found, fresh] = known->try_emplace({place[0], place[1], place[2], place[3]});
           if (fresh) {
             const PlainGround& ground = scene_.ground();
             found->second = {ground.Inside(Standing(both, place), place[2]),
                              ground.Inside(Standing(own, place), place[2])};
           }
           return found->second;
         }});
  }
}

void WalkTruth::AddFootStatements() {
  Polygon both = Touching(robot_, 0, kNever);
  for (const Eigen::Vector2d& p : Touching(robot_, 1, kNever)) both.push_back(p);
  for (int foot = 0; foot < 2; ++foot) {
    const size_t i = static_cast<size_t>(foot);
    const auto swings = [foot](const Stretch& s) { return s.in_air == foot; };
    statements_.push_back(
        {"floor", kFeet[i], 2.0,
         [=, this, own = Touching(robot_, i, kNever)](Instant& at, const Stretch& s) {
           if (!swings(s) || !s.moves) return Exactly(kNever);
           return FlatFootAbove(scene_.ground(), own, both, at.state.value.feet[i]);
         }});
    const Demands& d = demands_;
    statements_.push_back(
        {"foot_speed", kFeet[i], 40.0, [=, limit = d.foot_speed](Instant& at, const Stretch& s) {
           if (!swings(s)) return Exactly(kNever);
           return Exactly(limit - at.state.rate.feet[i].head<3>().norm());
         }});
    statements_.push_back({"foot_yaw_rate", kFeet[i], 80.0,
                           [=, limit = d.foot_yaw_rate](Instant& at, const Stretch& s) {
                             if (!swings(s)) return Exactly(kNever);
                             return Exactly(limit - std::abs(at.state.rate.feet[i][3]));
                           }});
  }
  for (size_t i = 0; i < 2; ++i) {
    statements_.push_back({"landing_speed", kFeet[i], 60.0,
                           [i, limit = demands_.landing_speed](Instant& at, const Stretch& s) {
                             if (s.in_air != static_cast<int>(i)) return Exactly(kNever);
                             const double z = at.state.value.feet[i][2] - s.lands_at,
                                          sinks = -at.state.rate.feet[i][2];
                             return Exactly((z > 0.01 ? 100 * z * limit : limit) - sinks);
                           }});
  }
  statements_.push_back(
      {"double_support", "", 0.1, [](Instant&, const Stretch& s) { return Exactly(s.shift); }});
  statements_.push_back({"zmp", "", 15.0 * robot_.size(), [this](Instant& at, const Stretch& s) {
                           return Exactly(
                               InsideHull(SupportCorners(at.state, s), at.state.value.zmp));
                         }});
}

std::vector<Eigen::Vector2d> WalkTruth::SupportCorners(const WalkState& state,
                                                       const Stretch& s) const {
  std::vector<Eigen::Vector2d> points;
  for (int foot = 0; foot < 2; ++foot) {
    if (s.in_air == foot) continue;
    const auto& place = state.value.feet[static_cast<size_t>(foot)];
    for (const auto& c : SoleCorners(place, robot_.sole_size)) points.push_back(c);
  }
  return points;
}

void WalkTruth::AddLegStatements() {
  for (int leg = 0; leg < 2; ++leg) {
    const size_t i = static_cast<size_t>(leg);
    statements_.push_back({"reach", leg == 0 ? "left leg" : "right leg", 2.0,
                           [this, leg, i](Instant& at, const Stretch&) {
                             if (!robot_.legs[i].axes_meet) {
                               if (!at.reaches) return Exactly(-kNever);
                               return Exactly(longest_[i] - robot_.HipToAnkle(leg, at.q[i][3]));
                             }
                             const Eigen::Vector3d hip = at.X_WB * robot_.HipInWaist(leg);
                             const Eigen::Vector3d ankle = at.X_WSole[i] * robot_.AnkleInSole(leg);
                             return Exactly(longest_[i] - (hip - ankle).norm());
                           }});
    for (int j = 0; j < 6; ++j) {
      const PlainRobot::Joint& joint =
          robot_.joints[static_cast<size_t>(robot_.legs[i].joints[static_cast<size_t>(j)])];
      statements_.push_back(
          {"joint", joint.name, 10.0, [&joint, i, j](Instant& at, const Stretch&) {
             if (!at.reaches) return Exactly(-kNever);
             const double q = at.q[i][j];
             return Exactly(std::min(q - joint.lower, joint.upper - q));
           }});
      const double limit = demands_.joint_speed_scale * joint.speed;
      statements_.push_back(
          {"joint_speed", joint.name, 150.0, [limit, i, j](Instant& at, const Stretch&) {
             if (!at.reaches) return Exactly(-kNever);
             return Exactly(limit - std::abs(at.speed[i][j]));
           }});
    }
  }
}

}  // namespace halfstep::oracle
