#include "smoothing/margins/demand_profile.h"

namespace halfstep {

std::string_view Name(DemandProfile profile) {
  switch (profile) {
    case DemandProfile::kWalkable:
      return "walkable";
    case DemandProfile::kLimit:
      return "limit";
    case DemandProfile::kPaper:
      return "paper";
  }
  return "";
}

MarginLimits LimitsOf(DemandProfile profile) {
  MarginLimits limits;
  switch (profile) {
    case DemandProfile::kWalkable:
      limits.demanded_of(MarginFamily::kZmpRobot) = 0.0274;
      limits.demanded_of(MarginFamily::kFriction) = 0.3;
      limits.demanded_of(MarginFamily::kDoubleSupport) = 0.08;
      break;
    case DemandProfile::kLimit:
      break;
    case DemandProfile::kPaper:
      limits.foot_speed = limits.foot_yaw_rate = std::nullopt;
      for (const MarginFamily family :
           {MarginFamily::kZmpRobot, MarginFamily::kTorque, MarginFamily::kFriction}) {
        limits.demanded_of(family) = kNotDemanded;
      }
      break;
  }
  return limits;
}

}  // namespace halfstep
