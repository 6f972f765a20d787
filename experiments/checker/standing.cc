#include "experiments/checker/standing.h"

#include <algorithm>

#include "experiments/checker/trajectory_statements.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep::checker {

std::string Standing::Text(const UrdfTree& urdf) const {
  std::vector<std::string> names;
  for (const int link : links) names.push_back(Nth(urdf.links, link).name);
  return Joined(names) + Formatted(" from %g to %g s", from, to);
}

std::vector<Standing> StandingOf(const TrajectoryDemands& demands, const RobotMotion& motion) {
  const double begin = motion.curves().begin(), end = motion.curves().end();
  std::vector<double> times = {begin, end};
  for (const TrajectoryDemands::Contact& contact : demands.contacts) {
    times.push_back(contact.from.value_or(begin));
    times.push_back(contact.to.value_or(end));
  }
  std::ranges::sort(times);
  std::vector<Standing> all;
  for (size_t i = 0; i + 1 < times.size(); ++i) {
    if (!(times[i] < times[i + 1])) continue;
    Standing one{.from = times[i], .to = times[i + 1]};
    for (const TrajectoryDemands::Contact& contact : demands.contacts) {
      const double from = contact.from.value_or(begin), to = contact.to.value_or(end);
      const int link = motion.robot().urdf().FindLink(contact.link);
      if (from > one.from || to < one.to || std::ranges::count(one.links, link) > 0) continue;
      one.links.push_back(link);
      one.since.push_back(from);
    }
    all.push_back(std::move(one));
  }
  return all;
}

std::string NoAccelerations(const Trajectory& trajectory, const RobotMotion& motion) {
  if (motion.has_base() && trajectory.base_v.size() == 0) {
    return "the root goes straight between knots, for its velocities are not told";
  }
  const bool linear = trajectory.interpolation == Interpolation::kLinear;
  return linear ? "linear pieces have no accelerations" : "";
}

const Pushes::ByLink& Pushes::On(double from, double to) {
  const auto known = known_.find({from, to});
  if (known != known_.end()) return known->second;
  const UrdfTree& urdf = motion_.robot().urdf();
  if (known_.size() > 250'000 / urdf.links.size()) known_.clear();
  ByLink pushes{std::vector<Push>(urdf.links.size()), std::vector<Push>(urdf.links.size())};
  for (size_t i = urdf.links.size(); i-- > 0;) {  // a link comes after its parent
    const auto link = static_cast<int>(i);
    const UrdfLink& of = urdf.links[i];
    if (of.mass > 0.0) {
      pushes.own[i] = PushOf({of.mass, of.com, of.inertia}, motion_.On(link, from, to), reference_);
      pushes.below[i] += pushes.own[i];
    }
    if (i > 0) Nth(pushes.below, motion_.robot().JointOf(link).parent) += pushes.below[i];
  }
  return known_.emplace(std::pair(from, to), std::move(pushes)).first->second;
}

Push Pushes::Others(int link, double from, double to) {
  const auto& [own, below] = On(from, to);
  Push sum;
  for (int at = link; at > 0;) {
    const int parent = motion_.robot().JointOf(at).parent;
    sum += Nth(own, parent);
    for (int other = 1; other < std::ssize(own); ++other) {
      const bool beside = other != at && motion_.robot().JointOf(other).parent == parent;
      if (beside) sum += Nth(below, other);
    }
    at = parent;
  }
  return sum;
}

// At a knot itself bounds are of the pieces on both sides, of numbers one by one.
Statement ByPieces(const Standing& time, const RobotMotion& motion,
                   const std::function<double(double from, double to)>& margin) {
  constexpr double kBeside = 1e-7;  // [s]
  const Span span{time.from, time.to, &motion.curves().times()};
  const auto bound = [margin](double from, double to) {
    try {
      return margin(from, to);
    } catch (const NotDefined&) {
      return -kInfinity;
    }
  };
  const auto value = [=](double t) {
    if (!std::ranges::binary_search(*span.knots, t)) return bound(t, t);
    const double before = t - kBeside, after = t + kBeside;
    return std::min(before < span.begin ? kInfinity : bound(before, before),
                    after > span.end ? kInfinity : bound(after, after));
  };
  const auto look = [=](double from, double to) {
    Part part{.from = from, .to = to, .bound = -kInfinity};
    part.value = value(part.middle());
    if (!span.HasKnot(from, to)) part.bound = bound(from, to);
    return part;
  };
  return {.span = span, .look = look, .value = value};
}

}  // namespace halfstep::checker
