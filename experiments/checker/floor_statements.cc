// What the floor has to give under links that are said to stand: where it pushes, and friction.
#include <algorithm>
#include <memory>
#include <optional>
#include <set>

#include "experiments/checker/separation.h"
#include "experiments/checker/standing.h"
#include "experiments/checker/support.h"
#include "experiments/checker/trajectory_statements.h"
#include "wpg/elementary.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep::checker {
namespace {

using Kind = TrajectoryFinding::Kind;
constexpr int kSidesOfDisc = 16;  // corners that are taken of a round sole

// The soles of links that stand, as one outline.
struct Soles {
  Eigen::Vector3d reference{0, 0, 0};        // in the plane of the lowest one, rounded down [m]
  std::vector<std::array<Interval, 2>> way;  // around them, seen from there
};

// Points of a body at X, seen from above: of each vertex what is lowest.
void AddPoints(const ConvexBody& body, const Frame& X, std::vector<Vector>* points) {
  const double radius = body.disc_radius * (1.0 - 1e-12);  // rounding stays inside
  const int sides = radius > 0.0 ? kSidesOfDisc : 1;
  for (const Eigen::Vector3d& vertex : body.vertices.colwise()) {
    for (int i = 0; i < sides; ++i) {
      const auto [s, c] = SinCos(2.0 * M_PI * i / sides);
      Vector point = VectorOf(vertex);
      point[0] = point[0] + Interval(radius * c);
      point[1] = point[1] + Interval(radius * s);
      point = X * point;
      point[2] = point[2] - Interval(body.ball_radius);
      points->push_back(point);
    }
  }
}

// Of points within some distance [m] of the lowest one. None where soles are not level to that, or
// have less than three points together.
std::optional<Soles> SolesOf(const Standing& standing, double within, RobotMotion* motion) {
  std::vector<Vector> all;
  double low = kInfinity, high = -kInfinity;
  for (size_t i = 0; i < standing.links.size(); ++i) {
    const int link = standing.links[i];
    const Frame X = Nth(motion->At(standing.since[i]).sure, link);
    std::vector<Vector> points;
    double lowest = kInfinity;
    for (const JointedRobot::Body& body : motion->robot().bodies()) {
      if (body.link != link) continue;
      lowest = std::min(lowest, LeastAlong(Eigen::Vector3d::UnitZ(), body.shape, X));
      AddPoints(body.shape, X, &points);
    }
    for (const Vector& point : points) {
      if (Above(point[2].hi - lowest) <= within) all.push_back(point);
    }
    low = std::min(low, lowest), high = std::max(high, lowest);
  }
  if (!(Above(high - low) <= within)) return std::nullopt;
  std::vector<Eigen::Vector2d> middles;
  Soles soles;
  soles.reference.z() = low;
  for (const Vector& point : all) {
    middles.emplace_back(point[0].Middle(), point[1].Middle());
    soles.reference.head<2>() += middles.back() / static_cast<double>(all.size());
  }
  const std::vector<size_t> hull = all.empty() ? std::vector<size_t>() : HullHint(middles);
  if (hull.size() < 3) return std::nullopt;
  for (const size_t i : hull) {
    soles.way.push_back(
        {all[i][0] - Interval(soles.reference.x()), all[i][1] - Interval(soles.reference.y())});
  }
  return soles;
}

// What keeps statements from being made at all; "": nothing.
std::string Missing(const Trajectory& trajectory, const TrajectoryDemands& demands,
                    const RobotMotion& motion) {
  if (demands.contacts.empty()) return "no contact is claimed (valid with --contact)";
  if (!motion.has_base()) return "the root is fixed in the world (valid: a root that moves)";
  const std::string none = NoAccelerations(trajectory, motion);
  if (!none.empty()) return none + " (valid: velocities of joints and root)";
  const auto& links = motion.robot().urdf().links;
  const auto weighs = [](const UrdfLink& link) { return link.mass > 0.0; };
  return std::ranges::any_of(links, weighs) ? "" : "no link has a mass (valid: masses in the URDF)";
}

}  // namespace

void AddFloor(const Trajectory& trajectory, const TrajectoryDemands& demands,
              const std::vector<Standing>& standing, RobotMotion* motion,
              std::vector<Statement>* statements, TrajectoryCheck* check) {
  const bool claims = !demands.contacts.empty();
  if (claims && !demands.zmp)
    check->not_covered.emplace_back("ZMP: no margin is asked for (--zmp)");
  if (claims && !demands.friction) {
    check->not_covered.emplace_back("friction: no coefficient is asked for (--friction)");
  }
  if (!demands.zmp && !demands.friction) return;
  const std::string option = demands.zmp ? "--zmp: " : "--friction: ";
  const std::string missing = Missing(trajectory, demands, *motion);
  if (!missing.empty()) throw InputError({option + missing});
  double in_air = 0.0, uneven = 0.0;
  bool known = false;
  for (const Standing& one : standing) {
    const std::optional<Soles> soles = SolesOf(one, demands.contact_distance, motion);
    if (!soles) {
      (one.links.empty() ? in_air : uneven) += one.to - one.from;
      continue;
    }
    known = true;
    const auto pushes = std::make_shared<Pushes>(motion, soles->reference);
    const auto add = [&](Kind kind, double demanded, const auto& margin) {
      const auto by_forces = [=, way = soles->way](double from, double to) {
        const Push& floor = pushes->Below(0, from, to);
        if (!(floor.force[2].over[0].lo > 0.0)) throw NotDefined();
        const Rate scale = Inverse(floor.force[2]);
        const Seen<1> zmp = {-(floor.moment[1] * scale), floor.moment[0] * scale};
        return margin(EdgesAround(way, zmp), floor, zmp);
      };
      Statement& statement = statements->emplace_back(ByPieces(one, *motion, by_forces));
      statement.kind = kind;
      statement.subject = one.Text(motion->robot().urdf());
      statement.demanded = demanded;
    };
    if (demands.zmp) {
      add(Kind::kZmpRobot, *demands.zmp,
          [](const std::vector<SupportEdge<1>>& edges, const Push&, const Seen<1>&) {
            double least = kInfinity;
            for (const auto& edge : edges) least = std::min(least, edge.inside.over[0].lo);
            return least;
          });
    }
    if (!demands.friction) continue;
    add(Kind::kFriction, 0.0,
        [most = *demands.friction](const std::vector<SupportEdge<1>>& edges, const Push& floor,
                                   const Seen<1>& zmp) {
          return FrictionLeft(RoomInHull(edges), floor, zmp, most).bound;
        });
    statements->back().most = *demands.friction;
  }
  if (!known) {
    throw InputError({option +
                      "contacts are at no time level soles (valid: links of which three points or "
                      "more are within --contact-distance of the lowest one at FROM)"});
  }
  std::set<int> without;  // links with bodies, but no mass
  for (const JointedRobot::Body& body : motion->robot().bodies()) {
    if (!(Nth(motion->robot().urdf().links, body.link).mass > 0.0)) without.insert(body.link);
  }
  if (!without.empty()) {
    check->not_covered.push_back(Formatted(
        "masses of %zu links with bodies, which the URDF does not state", without.size()));
  }
  const auto tell = [check](double time, const char* why) {
    if (time == 0.0) return;
    check->not_covered.push_back(Formatted("ZMP and friction for %.4g s in which %s", time, why));
  };
  tell(in_air, "no contact is claimed");
  tell(uneven, "contacts are no soles, or not level to --contact-distance");
}

}  // namespace halfstep::checker
