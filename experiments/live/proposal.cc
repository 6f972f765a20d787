#include "experiments/live/proposal.h"

namespace halfstep {

std::string_view Name(ProposalKind kind) {
  switch (kind) {
    case ProposalKind::kSafe:
      return "safe";
    case ProposalKind::kResumed:
      return "resumed";
    case ProposalKind::kChanged:
      return "changed";
    case ProposalKind::kShortened:
      return "shortened";
    case ProposalKind::kSmoothed:
      return "smoothed";
    case ProposalKind::kCommanded:
      return "commanded";
    case ProposalKind::kUnsafe:
      return "unsafe";
  }
  return "";
}

}  // namespace halfstep
