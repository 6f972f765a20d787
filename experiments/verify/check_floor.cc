#include <algorithm>
#include <array>
#include <optional>

#include "experiments/verify/check_rows.h"
#include "experiments/verify/floor_distances.h"
#include "experiments/verify/tolerances.h"

namespace halfstep::verify {
void CheckFloor(const PlayedMotion& motion, const WalkFloor& floor, const Scene& scene,
                const CertificateText& certificate, double tolerance, Findings* findings) {
  const RobotModel& robot = motion.robot();
  const std::vector<PlayedRow>& rows = motion.rows();
  const Tolerances near(robot);
  Check feet("feet above the floor", "m", 0, near.foot);
  Check ground("bodies above the floor", "m", certificate.demanded[kGround], tolerance);
  Check areas("no-step areas", "m", certificate.demanded[kNoStep], near.length);
  std::vector<double> before(robot.bodies.size());
  std::array<std::optional<Pose2>, 2> footprint;
  for (size_t i = 0; i < rows.size(); ++i) {
    const PlayedRow& row = rows[i];
    const Placement at = motion.PlaceRow(row);
    const auto when = [&row] { return Formatted(" at t = %.6g s", row.t); };
    for (size_t b = 0; b < robot.bodies.size(); ++b) {
      const RobotBody& body = robot.bodies[b];
      const double height = floor.Above(LowestPoint(body, at));
      const auto where = [&] { return body.name + when(); };
      if (verify::IsOnFoot(body)) {
        feet.Add(height, where);
      } else {
        // Between two rows no lower than the lower end, but for what the path is bent.
        ground.Add(i == 0 ? height : std::min(before[b], height) - motion.Sag(body, i - 1), where);
      }
      before[b] = height;
    }
    for (size_t side = 0; side < 2 && !scene.no_step.empty(); ++side) {
      const Pose2 X_WF = row.X_WS(static_cast<int>(side));
      if (!row.Stands(static_cast<int>(side)) || footprint[side] == X_WF) continue;
      footprint[side] = X_WF;
      for (const Eigen::Matrix2Xd& area : scene.no_step) {
        areas.Add(FromArea(robot, X_WF, area),
                  [&] { return std::string(side == 0 ? "left foot" : "right foot") + when(); });
      }
    }
  }
  feet.Conclude(findings);
  ground.Conclude(findings);
  if (!scene.no_step.empty()) areas.Conclude(findings);
}

}  // namespace halfstep::verify
