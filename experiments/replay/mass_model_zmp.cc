#include "experiments/replay/mass_model_zmp.h"

#include "wpg/nth.h"
#include "wpg/robot/gravity.h"

namespace halfstep::replay {
namespace {

using Eigen::Vector3d;

// CoMs of all links in W.
std::vector<Vector3d> LinkCentres(const RobotModel& robot, const RobotTree& tree,
                                  const TrajectoryRow& row) {
  const std::vector<Eigen::Isometry3d> X = tree.urdf.LinkPoses(JointAngles(robot, tree, row.q));
  const Eigen::Isometry3d X_WRoot = row.X_WB() * Nth(X, tree.waist).inverse();
  std::vector<Vector3d> centres;
  for (size_t i = 0; i < X.size(); ++i) centres.push_back(X_WRoot * X[i] * tree.urdf.links[i].com);
  return centres;
}

}  // namespace

std::vector<Eigen::Vector2d> MassModelZmp(const RobotModel& robot, const RobotTree& tree,
                                          const std::vector<TrajectoryRow>& rows) {
  std::vector<std::vector<Vector3d>> centres;
  for (const TrajectoryRow& row : rows) centres.push_back(LinkCentres(robot, tree, row));
  std::vector<Eigen::Vector2d> zmp;
  for (size_t i = 0; i < rows.size(); ++i) {
    Eigen::Vector2d moment(0, 0);
    double force = 0.0;
    for (size_t link = 0; link < tree.urdf.links.size(); ++link) {
      const double mass = tree.urdf.links[link].mass;
      const Vector3d& p = centres[i][link];
      const double height = p.z() - rows[i].zmp_z;
      Vector3d a = Vector3d::Zero();
      if (i > 0 && i + 1 < rows.size()) {
        const double before = rows[i].t - rows[i - 1].t, after = rows[i + 1].t - rows[i].t;
        a = 2 / (before + after) *
            ((centres[i + 1][link] - p) / after - (p - centres[i - 1][link]) / before);
      }
      moment += mass * (p.head<2>() * (a.z() + kGravity) - height * a.head<2>());
      force += mass * (a.z() + kGravity);
    }
    zmp.push_back(moment / force);
  }
  return zmp;
}

}  // namespace halfstep::replay
