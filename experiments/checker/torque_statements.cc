#include <algorithm>
#include <limits>
#include <map>
#include <memory>

#include "experiments/checker/trajectory_statements.h"
#include "wpg/nth.h"
#include "wpg/robot/gravity.h"

namespace halfstep::checker {
namespace {

using Rate = Taylor<1>;

VectorIn<Rate> Rates(const VectorIn<Curve>& x) {
  return {x[0].Derivative<0, 1>(), x[1].Derivative<0, 1>(), x[2].Derivative<0, 1>()};
}
VectorIn<Rate> Seconds(const VectorIn<Curve>& x) {
  return {x[0].Derivative<2, 1>(), x[1].Derivative<2, 1>(), x[2].Derivative<2, 1>()};
}

// ∫ (ẍ + gẑ) dm and ∫ x × (ẍ + gẑ) dm of links.
struct Push {
  VectorIn<Rate> force{}, moment{};

  void operator+=(const Push& other) {
    force = force + other.force;
    moment = moment + other.moment;
  }
};

// Of x = r + R ξ with r the centre of mass: ∫ R ξ (R̈ ξ)ᵀ dm = R Σ R̈ᵀ with Σ = ½tr(I)·1 − I.
Push PushOf(const UrdfLink& link, const FrameIn<Curve>& X) {
  Push push;
  const VectorIn<Curve> center = X * VectorOf<Curve>(link.com);
  push.force = Seconds(center);
  push.force[2] = push.force[2] + Rate(kGravity);
  for (Rate& f : push.force) f = link.mass * f;
  push.moment = Cross(Rates(center), push.force);
  const Eigen::Matrix3d& I = link.inertia;
  const Interval half_trace = Interval(0.5) * (Interval(I(0, 0)) + I(1, 1) + I(2, 2));
  std::array<VectorIn<Rate>, 3> spread;  // rows of R Σ
  for (size_t i = 0; i < 3; ++i) {
    const VectorIn<Rate> row = Rates(X.R[i]);
    for (size_t k = 0; k < 3; ++k) {
      for (size_t l = 0; l < 3; ++l) {
        const Interval entry =
            -Interval(I(static_cast<Eigen::Index>(l), static_cast<Eigen::Index>(k)));
        spread[i][k] = spread[i][k] + (k == l ? half_trace + entry : entry) * row[l];
      }
    }
  }
  for (size_t i = 0; i < 3; ++i) {
    const size_t k = (i + 1) % 3, l = (i + 2) % 3;
    push.moment[i] =
        push.moment[i] + Dot(spread[k], Seconds(X.R[l])) - Dot(spread[l], Seconds(X.R[k]));
  }
  return push;
}

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
      if (urdf.links[i].mass > 0.0) pushes[i] += PushOf(urdf.links[i], motion_.On(link, from, to));
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
        const VectorIn<Rate> axis = Rates(X.Turned(VectorOf<Curve>(joint.axis)));
        const auto& [force, moment] = Nth(pushes->On(a, b), joint.child);
        const Rate torque = Dot(axis, joint.slides ? force : moment - Cross(Rates(X.p), force));
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
