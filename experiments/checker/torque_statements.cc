#include <algorithm>
#include <limits>
#include <map>
#include <memory>

#include "experiments/checker/push.h"
#include "experiments/checker/trajectory_statements.h"
#include "wpg/nth.h"

namespace halfstep::checker {
namespace {

// By link: of all that hangs on it, itself included. Those of the last intervals are remembered,
// for joints are looked at one after the other.
class Pushes {
 public:
  explicit Pushes(RobotMotion* motion) : motion_(*motion) {}

  const std::vector<Push>& On(double from, double to) {
    const auto known = known_.find({from, to});
    if (known != known_.end()) return known->second;
    const UrdfTree& urdf = motion_.robot().urdf();
    if (known_.size() > 500'000 / urdf.links.size()) known_.clear();
    std::vector<Push> pushes(urdf.links.size());
    for (size_t i = pushes.size(); i-- > 1;) {  // a link comes after its parent
      const auto link = static_cast<int>(i);
      if (urdf.links[i].mass > 0.0) {
        const UrdfLink& of = urdf.links[i];
        pushes[i] += PushOf({of.mass, of.com, of.inertia}, motion_.On(link, from, to));
      }
      Nth(pushes, motion_.robot().JointOf(link).parent) += pushes[i];
    }
    return known_.emplace(std::pair(from, to), std::move(pushes)).first->second;
  }

 private:
  RobotMotion& motion_;
  std::map<std::pair<double, double>, std::vector<Push>> known_;
};

}  // namespace

void AddTorques(const Trajectory& trajectory, RobotMotion* motion,
                std::vector<Statement>* statements, TrajectoryCheck* check) {
  if (motion->has_base() || trajectory.interpolation == Interpolation::kLinear) {
    check->not_covered.push_back(
        std::string("torques: ") +
        (motion->has_base() ? "the root moves" : "linear pieces have no accelerations"));
    return;
  }
  const UrdfTree& urdf = motion->robot().urdf();
  const auto pushes = std::make_shared<Pushes>(motion);
  std::vector<double> masses(urdf.links.size());  // of all that hangs on a link
  for (size_t i = masses.size(); i-- > 1;) {
    masses[i] += urdf.links[i].mass;
    Nth(masses, motion->robot().JointOf(static_cast<int>(i)).parent) += masses[i];
  }
  for (const UrdfJoint& joint : urdf.joints) {
    if (!joint.moves()) continue;
    const bool known = joint.max_effort > 0.0 && Nth(masses, joint.child) > 0.0;
    if (!known) {
      check->not_covered.push_back("torque of " + joint.name +
                                   ": the URDF states no limit, or no mass that hangs on it");
      continue;
    }
    const auto look = [=](double from, double to) {
      Part part{.from = from, .to = to, .bound = -std::numeric_limits<double>::infinity()};
      const auto margin = [&](double a, double b) {
        const FrameIn<Curve>& X = motion->On(joint.child, a, b);
        const VectorIn<Rate> axis = FirstOf(X.Turned(VectorOf<Curve>(joint.axis)));
        const auto& [force, moment] = Nth(pushes->On(a, b), joint.child);
        const Rate torque = Dot(axis, joint.slides ? force : moment - Cross(FirstOf(X.p), force));
        return Beyond(joint.max_effort, torque.over[0].Magnitude());
      };
      part.value = margin(part.middle(), part.middle());
      if (!motion->Pieces().HasKnot(from, to)) part.bound = margin(from, to);
      return part;
    };
    statements->push_back({.kind = TrajectoryFinding::Kind::kTorque,
                           .subject = joint.name,
                           .span = motion->Pieces(),
                           .look = look,
                           .value = [look](double t) { return look(t, t).value; },
                           .slides = joint.slides});
  }
}

}  // namespace halfstep::checker
