#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "experiments/checker/separation.h"
#include "experiments/checker/trajectory_statements.h"
#include "wpg/elementary.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep::checker {
namespace {

using Kind = TrajectoryFinding::Kind;
constexpr double kNothing = -std::numeric_limits<double>::infinity();  // is known

// What is known of a margin on an interval by a link's frame: `margin` of the frame.
template <typename Margin>
Part ByFrame(RobotMotion* motion, int link, double from, double to, const Margin& margin) {
  Part part{.from = from, .to = to, .bound = kNothing};
  const double t = part.middle();
  part.value = margin(Nth(motion->At(t).sure, link));
  if (motion->Pieces().HasKnot(from, to)) return part;
  try {
    part.bound = margin(FrameOver(motion->On(link, from, to)));
  } catch (const NotDefined&) {  // the base turns far: known on shorter intervals
  }
  return part;
}

std::vector<const JointedRobot::Body*> BodiesOf(const JointedRobot& robot, int link) {
  std::vector<const JointedRobot::Body*> bodies;
  for (const JointedRobot::Body& body : robot.bodies()) {
    if (body.link == link) bodies.push_back(&body);
  }
  return bodies;
}

// Corners of the box along the link's axes around its bodies; its origin where there are none.
std::vector<Eigen::Vector3d> CornersOf(const JointedRobot& robot, int link) {
  Eigen::Vector3d least = Eigen::Vector3d::Zero(), most = least;
  bool first = true;
  for (const JointedRobot::Body* body : BodiesOf(robot, link)) {
    // Along an axis of its frame no point is farther than that.
    const double z = body->shape.ball_radius;
    const Eigen::Vector3d beyond(z + body->shape.disc_radius, z + body->shape.disc_radius, z);
    const Eigen::Vector3d low = body->shape.vertices.rowwise().minCoeff() - beyond;
    const Eigen::Vector3d high = body->shape.vertices.rowwise().maxCoeff() + beyond;
    least = first ? low : least.cwiseMin(low);
    most = first ? high : most.cwiseMax(high);
    first = false;
  }
  if (first) return {least};
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back(i & 1 ? most.x() : least.x(), i & 2 ? most.y() : least.y(),
                         i & 4 ? most.z() : least.z());
  }
  return corners;
}

// How far any of the points is from where it is by the other frame, at most [m].
double Shifted(const std::vector<Eigen::Vector3d>& points, const Frame& X, const Frame& X_0) {
  Frame change;
  for (size_t i = 0; i < 3; ++i) change.R[i] = X.R[i] - X_0.R[i];
  change.p = X.p - X_0.p;
  double most = 0.0;
  for (const Eigen::Vector3d& point : points) {
    const Vector d = change * VectorOf(point);
    most = std::max(most, Sqrt(Square(d[0]) + Square(d[1]) + Square(d[2])).hi);
  }
  return most;
}

// By which angle θ one rotation is from the other at most [rad]: ΣΣ (R − R₀)² = 8 sin²(θ/2).
double Turned(const Frame& X, const Frame& X_0) {
  Interval sum;
  for (size_t i = 0; i < 3; ++i) {
    const Vector d = X.R[i] - X_0.R[i];
    sum = sum + Square(d[0]) + Square(d[1]) + Square(d[2]);
  }
  const double sine = Sqrt(sum / Interval(8.0)).hi;
  if (sine >= 1.0) return Above(M_PI);
  return 2.0 * Above(Above(Asin(sine)));
}

}  // namespace

void AddGround(const TrajectoryDemands& demands, RobotMotion* motion,
               std::vector<Statement>* statements, TrajectoryCheck* check) {
  if (!demands.ground) {
    check->not_covered.push_back("the floor z = 0: no depth is asked for (--ground)");
    return;
  }
  const JointedRobot& robot = motion->robot();
  for (size_t i = 0; i < robot.urdf().links.size(); ++i) {
    const auto link = static_cast<int>(i);
    const std::vector<const JointedRobot::Body*> bodies = BodiesOf(robot, link);
    if (bodies.empty() || motion->Levers(*bodies.front(), -1).empty()) continue;  // fixed in W
    const auto lowest = [bodies](const Frame& X) {
      double least = std::numeric_limits<double>::infinity();
      for (const JointedRobot::Body* body : bodies) {
        least = std::min(least, LeastAlong(Eigen::Vector3d::UnitZ(), body->shape, X));
      }
      return least;
    };
    std::vector<JointedRobot::Lever> levers;  // of the one that reaches farthest
    double reach = -1.0;
    for (const JointedRobot::Body* body : bodies) {
      if (body->reach <= reach) continue;
      levers = motion->Levers(*body, -1);
      reach = body->reach;
    }
    const double asked = -*demands.ground;
    statements->push_back({.kind = Kind::kGround,
                           .subject = robot.urdf().links[i].name,
                           .demanded = asked,
                           .span = motion->Pieces(),
                           .look =
                               [=](double from, double to) {
                                 Part part = ByFrame(motion, link, from, to, lowest);
                                 const double moved =
                                     motion->Moved(levers, from, to, part.middle());
                                 part.bound = std::max(part.bound, Below(part.value - moved));
                                 return part;
                               },
                           .value = [=](double t) { return lowest(Nth(motion->At(t).sure, link)); },
                           .most = 0.0});
  }
}

void AddContacts(const TrajectoryDemands& demands, RobotMotion* motion,
                 std::vector<Statement>* statements, TrajectoryCheck* check) {
  const JointedRobot& robot = motion->robot();
  if (demands.contacts.empty())
    check->not_covered.push_back("contacts: none is claimed (--contact)");
  for (const TrajectoryDemands::Contact& contact : demands.contacts) {
    const int link = robot.urdf().FindLink(contact.link);
    if (link < 0) throw InputError({"--contact: no such link: " + Quote(contact.link)});
    Span span = motion->Pieces();
    const double from = contact.from.value_or(span.begin), to = contact.to.value_or(span.end);
    if (!(from >= span.begin && to <= span.end && from < to)) {
      throw InputError({Formatted("--contact: %s: %g to %g s (valid: from %g to %g s)",
                                  contact.link.c_str(), from, to, span.begin, span.end)});
    }
    span.begin = from, span.end = to;
    const Frame X_0 = Nth(motion->At(from).sure, link);
    const std::string subject = contact.link + Formatted(" from %g to %g s", from, to);
    const auto add = [&](Kind kind, double most, const auto& moved) {
      const auto margin = [=](const Frame& X) { return Below(most - moved(X)); };
      statements->push_back(
          {.kind = kind,
           .subject = subject,
           .span = span,
           .look = [=](double a, double b) { return ByFrame(motion, link, a, b, margin); },
           .value = [=](double t) { return margin(Nth(motion->At(t).sure, link)); },
           .most = most});
    };
    add(Kind::kStill, demands.contact_distance,
        [X_0, corners = CornersOf(robot, link)](const Frame& X) {
          return Shifted(corners, X, X_0);
        });
    add(Kind::kTilt, demands.contact_angle, [X_0](const Frame& X) { return Turned(X, X_0); });
  }
}

}  // namespace halfstep::checker
