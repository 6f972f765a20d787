#pragma once

#include "planner/search/planners.h"
#include "smoothing/methods/methods.h"

namespace halfstep {

/// What configs may name in this program: what is built in, and what it added. A value.
struct Toolbox {
  Methods methods = Methods::Standard();     ///< of `smoothing.methods`
  Planners planners = Planners::Standard();  ///< of `planner.name`
};

}  // namespace halfstep
