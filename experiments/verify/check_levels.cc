#include "experiments/verify/check_levels.h"

#include <algorithm>
#include <array>
#include <optional>

#include "experiments/verify/check_rows.h"
#include "experiments/verify/level_tops.h"
#include "experiments/verify/tolerances.h"

namespace halfstep::verify {
namespace {

const char* FootName(size_t side) { return side == 0 ? "left foot" : "right foot"; }

void CheckFootholds(const PlayedMotion& motion, const LevelTops& levels, double demanded,
                    Findings* findings) {
  const RobotModel& robot = motion.robot();
  Check inside("soles inside their levels", "m", demanded, Tolerances(robot).claim);
  std::array<std::optional<Eigen::Vector4d>, 2> last;
  for (const PlayedRow& row : motion.rows()) {
    for (size_t side = 0; side < 2; ++side) {
      const Eigen::Vector4d& sole = row.soles[side];
      const double near = Tolerances(robot).moved;
      if (!row.Stands(static_cast<int>(side))) continue;
      if (last[side] && (*last[side] - sole).cwiseAbs().maxCoeff() <= near) continue;
      last[side] = sole;
      inside.Add(levels.Inside(robot, row.X_WS(static_cast<int>(side)), sole[2]),
                 [&] { return FootName(side) + Formatted(" at t = %.6g s", row.t); });
    }
  }
  inside.Conclude(findings);
}

// The motion may begin or end between two rows: then the farther one of both counts.
void CheckMovingSoles(const PlayedMotion& motion, double demanded, double tolerance,
                      Distances* distances, Findings* findings) {
  const std::vector<PlayedRow>& rows = motion.rows();
  Check beside("moving soles and the ground's solids", "m", demanded, tolerance);
  const double enough = demanded + 0.1;  // what is farther need not be measured
  for (size_t side = 0; side < 2; ++side) {
    const int foot = static_cast<int>(side);
    bool moved = false;
    double last = 0;
    for (size_t i = 0; i < rows.size(); ++i) {
      const bool moves = i + 1 < rows.size() && MovesHorizontally(motion, i, foot);
      if (!moves && !moved) continue;
      const double here = distances->SoleFromSolids(foot, rows[i].soles[side], enough);
      const auto where = [&] { return FootName(side) + Formatted(" at t = %.6g s", rows[i].t); };
      if (moves && moved) beside.Add(here, where);
      // The only row of a motion that is shorter than a row.
      if (moved && !moves && i >= 2 && !MovesHorizontally(motion, i - 2, foot)) {
        beside.Add(std::max(last, here), where);
      }
      moved = moves;
      last = here;
    }
  }
  beside.Conclude(findings);
}

}  // namespace

void CheckLevels(const PlayedMotion& motion, const CertificateText& certificate, double tolerance,
                 Distances* distances, Findings* findings) {
  const LevelTops levels(distances->scene());
  if (levels.even()) return;
  CheckFootholds(motion, levels, certificate.demanded[kFoothold], findings);
  CheckMovingSoles(motion, certificate.demanded[kFloor], tolerance, distances, findings);
}

}  // namespace halfstep::verify
