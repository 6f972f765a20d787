#pragma once

#include <array>
#include <optional>
#include <string>

#include "experiments/survey/found_soles.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// How a robot shall stand.
struct StandingRequest {
  double bend = 0.9;   ///< distance of hip and ankle over the leg's stretched length, 0.5 … 0.99
  double width = 0.0;  ///< distance of the sole centres [m]
  double x = 0.0;      ///< of the sole centres ahead of the waist [m]
};

/// How far below the waist's origin a leg's sole is then [m], < 0 for a waist above the floor; none
/// when the leg is too short.
std::optional<double> StandingHeight(const Leg& leg, Side side, const StandingRequest& request);

/// The joint angles of a leg [rad] that put its sole there, at z in B [m], level and pointing
/// forward, within its limits; of several solutions the one whose knee is farthest ahead. None when
/// there is none.
std::optional<Vector6d> FindStanding(const Leg& leg, Side side, const StandingRequest& request,
                                     double z);

/// Which joint is farthest beyond its limits where FindStanding() finds none, in words; "" where
/// the sole is out of reach.
std::string JointInTheWay(const Leg& leg, Side side, const StandingRequest& request, double z);

/// The narrowest stance [m] at which the feet are `gap` apart: their bodies, or the soles where
/// those are wider. It is at least that of straight legs.
double NarrowestStance(const std::array<Leg, 2>& legs, const std::array<FoundSole, 2>& soles,
                       const std::vector<RobotBody>& bodies, double gap);

}  // namespace halfstep
