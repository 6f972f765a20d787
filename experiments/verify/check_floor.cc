#include <algorithm>

#include "experiments/verify/check_rows.h"
#include "experiments/verify/floor_distances.h"

namespace halfstep::verify {
void CheckFloor(const PlayedMotion& motion, const WalkFloor& floor,
                const CertificateText& certificate, double tolerance, Findings* findings) {
  const std::vector<PlayedRow>& rows = motion.rows();
  Check ground("played, bodies above the floor", "m", certificate.demanded[kGround], tolerance);
  std::vector<double> before(motion.robot().bodies.size());
  for (size_t i = 0; i < rows.size(); ++i) {
    const Placement at = motion.PlaceRow(rows[i]);
    for (size_t b = 0; b < before.size(); ++b) {
      const RobotBody& body = motion.robot().bodies[b];
      if (verify::IsOnFoot(body)) continue;
      const double height = floor.Above(LowestPoint(body, at));
      // Between two rows no lower than the lower end, but for what the path is bent.
      ground.Add(i == 0 ? height : std::min(before[b], height) - motion.Sag(body, i - 1),
                 [&] { return body.name + Formatted(" at t = %.6g s", rows[i].t); });
      before[b] = height;
    }
  }
  ground.Conclude(findings);
}

}  // namespace halfstep::verify
