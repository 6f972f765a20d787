#pragma once

#include "experiments/checker/prove_walk.h"
#include "experiments/commands/verify_command.h"
#include "experiments/verify/verify_run.h"
#include "tests/experiments/child_process.h"
#include "wpg/files/input_error.h"

namespace halfstep {

/// VerifyRun with the interval checker, as `halfstep verify` has it.
inline std::vector<verify::MethodVerification> VerifyProved(verify::VerifyOptions options) {
  options.prove = checker::ProverOfWalks();
  return verify::VerifyRun(options);
}

/// What `halfstep verify --verbose` tells and how it ends, found in this process.
inline Outcome VerifiedHere(const verify::VerifyOptions& options) {
  Outcome outcome;
  std::vector<std::string> complaints;
  try {
    const std::vector<verify::MethodVerification> results = VerifyProved(options);
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
