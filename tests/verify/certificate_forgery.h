#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <string>

#include "experiments/commands/commands.h"
#include "tests/verify/verify_mutation.h"

namespace halfstep {

/// A change of a run after which `verify` must refuse it.
struct CertificateForgery {
  std::string name;
  std::function<void(TamperedRun&)> forge;
  std::string reason;  ///< part of what must be said
};
inline void PrintTo(const CertificateForgery& forgery, std::ostream* out) { *out << forgery.name; }

/// Forges a run of the walk, makes all hashes fit again, and verifies it.
inline void ExpectRefused(const TamperedWalk& walk, const CertificateForgery& forgery) {
  TamperedRun run(walk);
  forgery.forge(run);
  run.Rehash();
  const Outcome outcome = run.Verify();
  EXPECT_EQ(outcome.status, kNotVerified) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out + outcome.err, testing::HasSubstr(forgery.reason));
}

}  // namespace halfstep
