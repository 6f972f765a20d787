#include "smoothing/margins/ground_margin.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wpg/nth.h"

namespace halfstep {

int GroundMargin::count() const { return static_cast<int>(place_.robot.bodies.size()); }

std::string GroundMargin::Subject(const Margin& margin) const {
  return BodyName(place_.robot, margin.subject);
}

Margin GroundMargin::Least(Instant* at, double enough) const {
  if (!at->reachable()) return Of(-std::numeric_limits<double>::infinity(), -1);
  return place_.heights.Least(at->posture(), at->jet().value, enough);
}

void GroundMargin::AddRows(Instant* at, SlackSink* rows) const {
  if (!at->regular()) return;
  const Posture& posture = at->posture();
  for (int b : place_.heights.of_legs()) {
    if (place_.heights.LowestPossible(b, posture) > rows->cutoff_margin()) continue;
    const RobotBody& body = Nth(place_.robot.bodies, b);
    const Eigen::Vector3d lowest = place_.heights.LowestPoint(b, posture);
    rows->Add(lowest.z() - place_.heights.floor(),
              [&](size_t i) { return PointTangent(body, posture, rows->tangents[i], lowest).z(); });
  }
}

void GroundMargin::AddBounds(const MarginInterval& interval, TightestStatement* tightest) const {
  const BodyHeights& heights = place_.heights;
  const IntervalMotion& motion = interval.motion;
  const WalkState& x = motion.jet.value;
  const double h = motion.half_width, t = interval.mid.t();
  const double rounding = interval.mid.rounding();
  const int step = interval.mid.step_in_air();
  for (int body : heights.on_feet()) {
    const Side side = static_cast<Side>(Nth(place_.robot.bodies, body).leg);
    const int z = FootIndex(side) + 2;
    double least = x[z] - heights.floor() - motion.Change(z);
    if (step >= 0 && interval.mid.swing() == side) {
      least =
          std::max(least, interval.mid.walk().LeastHeight(step, t - h, t + h) - heights.floor());
    }
    // On the floor or above it for all t, below it at the midpoint, or neither is known.
    const double margin = heights.OnFoot(body, x);
    const bool open = least < -kSoleRounding && margin > 0.0;
    tightest->Add(Of(open ? std::nan("") : margin, body), rounding);
  }
  for (int body : heights.of_legs()) {
    const double change = Nth(motion.displacement, body);
    const double possible = heights.LowestPossible(body, motion.posture);
    if (tightest->Pass(possible - change - rounding)) continue;
    tightest->Add(Of(heights.LowestPoint(body, motion.posture).z() - heights.floor(), body),
                  change + rounding);
  }
  tightest->Add(Of(heights.of_waist().value, heights.of_waist().subject), rounding);
  tightest->count = count();  // the lowest of the waist's bodies for all
}

}  // namespace halfstep
