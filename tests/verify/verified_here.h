#pragma once

#include "experiments/commands/verify_command.h"
#include "experiments/verify/verify_run.h"
#include "tests/experiments/child_process.h"
#include "wpg/files/input_error.h"

namespace halfstep {

/// What `halfstep verify --verbose` tells and how it ends, found in this process.
inline Outcome VerifiedHere(const verify::VerifyOptions& options) {
  Outcome outcome;
  std::vector<std::string> complaints;
  try {
    const std::vector<verify::MethodVerification> results = verify::VerifyRun(options);
    for (const verify::MethodVerification& result : results) {
      outcome.out += verify::Describe(result);
      complaints.insert(complaints.end(), result.complaints.begin(), result.complaints.end());
    }
    outcome.out += "\nNot examined:\n" + verify::TellNotExamined(results.front());
    outcome.status = StatusOf(results);
  } catch (const InputError& error) {
    complaints = error.complaints();
    outcome.status = kBadInput;
  }
  for (const std::string& complaint : complaints) outcome.err += complaint + "\n";
  return outcome;
}

}  // namespace halfstep
