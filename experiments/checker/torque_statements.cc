#include <algorithm>
#include <memory>

#include "experiments/checker/standing.h"
#include "experiments/checker/trajectory_statements.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep::checker {
namespace {

// Adds torques for a time in which nothing pushes but what holds the root (stands < 0), or the
// floor under the link `stands`.
void AddFor(const Standing& time, int stands, RobotMotion* motion,
            std::vector<Statement>* statements, std::vector<std::string>* unknown) {
  const JointedRobot& robot = motion->robot();
  const UrdfTree& urdf = robot.urdf();
  const Eigen::Vector3d about =
      stands < 0 ? Eigen::Vector3d(0, 0, 0)
                 : Eigen::Vector3d(Nth(motion->At(time.from).about, stands).translation());
  const auto pushes = std::make_shared<Pushes>(motion, about);
  std::vector<double> masses(urdf.links.size());  // of all that hangs on a link
  for (size_t i = masses.size(); i-- > 1;) {
    masses[i] += urdf.links[i].mass;
    Nth(masses, robot.JointOf(static_cast<int>(i)).parent) += masses[i];
  }
  std::vector<bool> carries(urdf.links.size(), false);  // by link: the one that stands hangs on it
  for (int link = stands; link > 0; link = robot.JointOf(link).parent) Nth(carries, link) = true;
  for (const UrdfJoint& joint : urdf.joints) {
    if (!joint.moves()) continue;
    const bool carrying = Nth(carries, joint.child);
    if (!(joint.max_effort > 0.0 && (carrying || Nth(masses, joint.child) > 0.0))) {
      if (std::ranges::count(*unknown, joint.name) == 0) unknown->push_back(joint.name);
      continue;
    }
    const auto margin = [=](double from, double to) {
      const FrameIn<Curve>& X = motion->On(joint.child, from, to);
      const VectorIn<Rate> axis = FirstOf(X.Turned(VectorOf<Curve>(joint.axis)));
      // The floor moves all of the robot by way of the link that stands: on its side the joint
      // bears what moves the others, the other way round.
      const Push push =
          carrying ? pushes->Others(joint.child, from, to) : pushes->Below(joint.child, from, to);
      const VectorIn<Rate> lever = FirstOf(X.p) - VectorOf<Rate>(pushes->reference());
      const Rate torque =
          Dot(axis, joint.slides ? push.force : push.moment - Cross(lever, push.force));
      return Beyond(joint.max_effort, torque.over[0].Magnitude());
    };
    Statement& statement = statements->emplace_back(ByPieces(time, *motion, margin));
    statement.kind = TrajectoryFinding::Kind::kTorque;
    statement.subject = stands < 0 ? joint.name : joint.name + ", by " + time.Text(urdf);
    statement.slides = joint.slides;
  }
}

}  // namespace

void AddTorques(const Trajectory& trajectory, const std::vector<Standing>& standing,
                RobotMotion* motion, std::vector<Statement>* statements, TrajectoryCheck* check) {
  const std::string none = NoAccelerations(trajectory, *motion);
  if (!none.empty()) {
    check->not_covered.push_back("torques: " + none);
    return;
  }
  std::vector<std::string> unknown;
  double shared = 0.0;
  if (!motion->has_base()) {
    AddFor({motion->curves().begin(), motion->curves().end()}, -1, motion, statements, &unknown);
  }
  for (const Standing& time : standing) {
    if (!motion->has_base()) break;
    if (time.links.size() == 1) {
      AddFor(time, time.links.front(), motion, statements, &unknown);
    } else {
      shared += time.to - time.from;
    }
  }
  for (const std::string& joint : unknown) {
    check->not_covered.push_back("torque of " + joint +
                                 ": the URDF states no limit, or no mass that hangs on it");
  }
  if (shared > 0.0) {
    check->not_covered.push_back(
        Formatted("torques for %.4g s in which not exactly one contact is claimed: what each link "
                  "gets of the floor's push is not determined",
                  shared));
  }
}

}  // namespace halfstep::checker
