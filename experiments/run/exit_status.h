#pragma once

namespace halfstep {

/// Exit statuses of every command.
enum ExitStatus : int {
  kSuccess = 0,
  kFailed = 1,        ///< the command's purpose failed: infeasible plan, full disk …
  kBadInput = 2,      ///< something that the user wrote is wrong; nothing was written
  kNotVerified = 3,   ///< `halfstep verify` disagrees with a certificate
  kTooCoarse = 4,     ///< `halfstep verify` agrees, but cannot vouch for motion between rows
  kInterrupted = 130  ///< stopped by Ctrl-C; what was written is whole and feasible
};

}  // namespace halfstep
