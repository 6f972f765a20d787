#pragma once

#include <stdexcept>
#include <string>

#include "experiments/checker/check_trajectory.h"

namespace halfstep::checker {

/// What was found about a subject.
inline const TrajectoryFinding& FoundIn(const TrajectoryCheck& check, TrajectoryFinding::Kind kind,
                                        const std::string& subject) {
  for (const TrajectoryFinding& finding : check.findings) {
    if (finding.kind == kind && finding.subject == subject) return finding;
  }
  throw std::logic_error("nothing was found about " + subject);
}

}  // namespace halfstep::checker
