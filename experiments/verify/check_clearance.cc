#include "experiments/verify/check_clearance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

namespace halfstep::verify {
namespace {

constexpr double kFinest = 1.0 / 256;  // of the time between two rows

// Time at which a path that grows linearly between rows first has length u.
double TimeOf(const std::vector<double>& path, const std::vector<PlayedRow>& rows, double u) {
  const auto after = std::upper_bound(path.begin(), path.end(), u);
  if (after == path.end()) return rows.back().t;
  const size_t i = static_cast<size_t>(std::max<std::ptrdiff_t>(after - path.begin() - 1, 0));
  const double s = (u - path[i]) / (path[i + 1] - path[i]);
  return rows[i].t + std::clamp(s, 0.0, 1.0) * (rows[i + 1].t - rows[i].t);
}

// Length of the path in 1/256 of the row pair that begins at length u.
double FinestStep(const std::vector<double>& path, double u) {
  const auto after = std::upper_bound(path.begin(), path.end(), u);
  if (after == path.end() || after == path.begin()) return 0;
  return kFinest * (*after - *(after - 1));
}

// The path of a body, and what an obstacle can take off the distance in the same time: at its
// fastest of each row pair, so that the sum is linear between rows.
std::vector<double> WithObstacle(std::vector<double> path, const PlayedMotion& motion,
                                 const Distances& distances, size_t obstacle) {
  const std::vector<PlayedRow>& rows = motion.rows();
  double way = 0;
  for (size_t i = 1; i < path.size(); ++i) {
    const double begin = rows[i - 1].t, end = rows[i].t;
    way += distances.ObstacleSpeed(obstacle, begin, end) * (end - begin);
    path[i] += way;
  }
  return path;
}

// First and last rows of the stretches of time in which a body has to keep off an obstacle, at one
// of their ends at least of each pair of rows: all of them, but of a foot and what its sole is
// above.
std::vector<std::pair<size_t, size_t>> Stretches(const PlayedMotion& motion,
                                                 const Distances& distances, size_t body,
                                                 size_t obstacle) {
  const std::vector<PlayedRow>& rows = motion.rows();
  std::vector<std::pair<size_t, size_t>> stretches;
  for (size_t i = 0; i + 1 < rows.size(); ++i) {
    std::array<double, 2> lower{};
    for (size_t side = 0; side < 2; ++side) {
      lower[side] = std::min(rows[i].soles[side][2], rows[i + 1].soles[side][2]);
    }
    if (!distances.MustKeepOff(body, obstacle, lower)) continue;
    if (stretches.empty() || stretches.back().second != i) stretches.emplace_back(i, i);
    stretches.back().second = i + 1;
  }
  return stretches;
}

// Keeps one pair of bodies apart over all time; false: not shown. With d the distance at the
// instant of length u, all of [u − (d − required), u + (d − required)] is covered.
bool Keep(const std::vector<double>& path, const PlayedMotion& motion, const std::string& name,
          const std::function<Distances::Result(const Placement&, double, double)>& distance,
          Check* check) {
  const double required = check->required();
  const double last = path.back();
  double covered = 0, ahead = 0;
  for (bool first = true; first || covered < last;) {
    const double u = std::min(covered + ahead, last);
    const double t = TimeOf(path, motion.rows(), u);
    const auto [d, exact] = distance(motion.Place(t), t, required + kQuick);
    const double slack = d - required;
    if (exact) check->Add(d, [&] { return name + Formatted(" at t = %.6g s", t); });
    if (!(slack >= 0)) {
      if (!exact) check->Open(name + Formatted(" at t = %.6g s", t));
      return false;
    }
    // Rounding of u and of the time keeps off the last 1e-12.
    if (const double usable = slack - 1e-12; usable >= u - covered && (usable > 0 || last == 0)) {
      first = false;
      if (u + usable < last && u + usable - covered < FinestStep(path, covered)) {
        check->Open(name + Formatted(" open at t = %.6g s: %.3g m left for the motion", t, slack));
        return false;
      }
      covered = u + usable;
      ahead = 0.9 * usable;
      continue;
    }
    ahead = std::min(0.5 * (u - covered), slack);
    if (u - covered < FinestStep(path, covered) || u == covered) {
      check->Open(name + Formatted(" open at t = %.6g s: %.3g m left for the motion", t, slack));
      return false;
    }
  }
  return true;
}

}  // namespace

void CheckClearances(const PlayedMotion& motion, const CertificateText& certificate,
                     double tolerance, Distances* distances, Findings* findings) {
  const RobotModel& robot = motion.robot();
  Check obstacles("played, clearance", "m", certificate.demanded[kClearance], tolerance);
  for (size_t b = 0; b < robot.bodies.size() && distances->num_obstacles() > 0; ++b) {
    const std::vector<double> of_body = motion.PathInWorld(robot.bodies[b]);
    // Between two rows no point of the body is farther from the first than its path is long; what
    // stays beyond the box around all this is kept clear of at every instant.
    Eigen::AlignedBox3d everywhere;
    for (size_t i = 0; i < of_body.size(); ++i) {
      const Eigen::AlignedBox3d here = distances->Around(b, motion.Place(motion.rows()[i].t));
      const double way = i + 1 < of_body.size() ? of_body[i + 1] - of_body[i] : 0.0;
      const Eigen::Vector3d around = Eigen::Vector3d::Constant(way);
      everywhere.extend(Eigen::AlignedBox3d(here.min() - around, here.max() + around));
    }
    for (const size_t o : distances->Near(everywhere, obstacles.required() + kQuick)) {
      const auto distance = [&](const Placement& at, double t, double enough) {
        return distances->FromObstacle(b, o, at, t, enough);
      };
      const std::string name = distances->NameOfObstaclePair(b, o);
      const std::vector<double> path = WithObstacle(of_body, motion, *distances, o);
      for (const auto& [first, last] : Stretches(motion, *distances, b, o)) {
        if (first == 0 && last + 1 == motion.rows().size()) {
          Keep(path, motion, name, distance, &obstacles);
          continue;
        }
        const auto part = [&](const auto& of) {
          return std::vector(of.begin() + first, of.begin() + last + 1);
        };
        const std::vector<PlayedRow> rows = part(motion.rows());
        std::vector<double> way = part(path);
        for (double& length : way) length -= path[first];
        Keep(way, PlayedMotion(robot, rows), name, distance, &obstacles);
      }
    }
  }
  obstacles.Conclude(findings);

  Check selves("played, self clearance", "m", certificate.demanded[kSelfClearance], tolerance);
  std::vector<std::vector<double>> paths;
  for (const RobotBody& body : robot.bodies) paths.push_back(motion.PathInWaist(body));
  for (const auto& [i, j] : robot.self_pairs) {
    const size_t a = static_cast<size_t>(i), b = static_cast<size_t>(j);
    std::vector<double> path = paths[a];
    for (size_t k = 0; k < path.size(); ++k) path[k] += paths[b][k];
    Keep(
        path, motion, distances->NameOfPair(a, b),
        [&](const Placement& at, double, double enough) {
          return distances->OfPair(a, b, at, enough);
        },
        &selves);
  }
  selves.Conclude(findings);
}

}  // namespace halfstep::verify
