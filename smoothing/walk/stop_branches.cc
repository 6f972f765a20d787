#include "smoothing/walk/stop_branches.h"

namespace halfstep {

std::string_view Name(StopBranches branches) {
  switch (branches) {
    case StopBranches::kNone:
      return "none";
    case StopBranches::kDown:
      return "down";
    case StopBranches::kAll:
      return "all";
  }
  return "";
}

bool Demands(StopBranches branches, HalfStepKind after) {
  return branches == StopBranches::kAll ||
         (branches == StopBranches::kDown && after == HalfStepKind::kDown);
}

}  // namespace halfstep
