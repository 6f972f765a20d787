#pragma once

#include <cmath>
#include <limits>

#include "experiments/live/live_config.h"
#include "experiments/server/client_inbox.h"

namespace halfstep {

/// From when on a robot that rests in the goal has arrived, where clients may do something at any
/// time [s]: when one asked for the end, or when the longest time is up.
inline double QuietFrom(const ClientInbox& inbox, const LiveOptions& options) {
  return inbox.ended() ? -std::numeric_limits<double>::infinity()
                       : std::nextafter(options.longest, 0.0);
}

}  // namespace halfstep
