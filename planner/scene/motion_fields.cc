#include "planner/scene/motion_fields.h"

#include <optional>
#include <string>
#include <vector>

#include "wpg/files/text.h"

namespace halfstep {
namespace {

constexpr double kLongest = 1e6;      // of any time [s]
constexpr double kMostYaw = 36000.0;  // of a waypoint [deg]
constexpr size_t kMostWaypoints = 10000;

struct WaypointFields {
  double t = 0.0;
  std::vector<double> xyz;
  double yaw = 0.0;
};

void DeclareWaypoint(Fields& fields, WaypointFields* waypoint) {
  fields.Number(
      "t_s", &waypoint->t,
      {.meaning = "time of the walk", .unit = "s", .min = 1e-6, .max = kLongest, .required = true});
  fields.Numbers("xyz", &waypoint->xyz, 3,
                 {.meaning = "position then",
                  .unit = "m",
                  .min = -kFarthestPlace,
                  .max = kFarthestPlace,
                  .required = true});
  fields.Number("yaw_deg", &waypoint->yaw,
                {.meaning = "turn about the world's z since t = 0",
                 .unit = "deg",
                 .min = -kMostYaw,
                 .max = kMostYaw});
}

}  // namespace

void DeclareMotion(Fields& fields, ObstacleMotion* motion) {
  std::vector<WaypointFields> waypoints;
  fields.List("waypoints", {.meaning = "known motion", .max_items = kMostWaypoints}, &waypoints,
              [&](Fields& item, WaypointFields* waypoint) {
                DeclareWaypoint(item, waypoint);
                if (waypoint == waypoints.data()) return;
                const double last = (waypoint - 1)->t;
                if (waypoint->t > last) return;
                item.Complain("t_s", Formatted("%.6g is not after the waypoint before it, at %.6g "
                                               "s (valid: increasing times)",
                                               waypoint->t, last));
              });
  for (const WaypointFields& from : waypoints) {
    if (from.xyz.size() != 3) continue;  // complained about
    motion->waypoints.push_back({from.t, {from.xyz[0], from.xyz[1], from.xyz[2]}, from.yaw});
  }
  fields.Number("error_m", &motion->error,
                {.meaning = "how far any point may be from where it is said to be",
                 .unit = "m",
                 .min = 0.0,
                 .max = kFarthestPlace});
  fields.Number("speed_m_s", &motion->speed,
                {.meaning = "how fast it may move beyond its waypoints",
                 .unit = "m/s",
                 .min = 0.0,
                 .max = kFarthestPlace});
  fields.Number("measured_at_s", &motion->measured_at,
                {.meaning = "when it was measured, a time of the walk",
                 .unit = "s",
                 .min = -kLongest,
                 .max = kLongest});
  std::optional<double> horizon;
  fields.OptionalNumber("horizon_s", &horizon,
                        {.meaning = "how long it may have moved at that speed",
                         .unit = "s",
                         .min = 0.0,
                         .max = kLongest});
  if (horizon) motion->horizon = *horizon;
}

}  // namespace halfstep
