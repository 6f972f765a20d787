// Certificates that are wrong by 10⁻¹² to 10⁻³ are not proved: a small part of forgery_study.
#include "tests/checker/forged_certificates.h"

#include <gtest/gtest.h>

#include "tests/draws.h"
#include "tests/oracle/project_side.h"
#include "tests/oracle/unequal_legs.h"
#include "tests/temporary_folder.h"

namespace halfstep::checker {
namespace {

TEST(ForgedCertificates, AreNotProved) {
  const TemporaryFolder folder;
  const TemporaryFolder of_offset;
  const oracle::Judge wren(oracle::WriteJudgedRobot("wren", folder.path().string()));
  const oracle::Judge offset(
      oracle::WriteUnequalRobot("hrp2", {.seed = 1, .offset = true}, of_offset.path().string()));
  ForgeryTally all;
  std::vector<std::string> falsehoods;
  for (const oracle::SceneKind kind :
       {oracle::SceneKind::kPrimitives, oracle::SceneKind::kPlatforms}) {
    for (unsigned seed = 1; seed < (kFewDraws ? 3u : 4u); ++seed) {
      all.Add(wren.Forge(kind, seed, 2, folder.path().string(), &falsehoods));
      if (kFewDraws && seed > 1) continue;
      all.Add(offset.Forge(kind, seed, 1, of_offset.path().string(), &falsehoods));
    }
  }
  for (const std::string& told : falsehoods) ADD_FAILURE() << told;
  EXPECT_GE(all.walks, 3);
  EXPECT_GE(all.proved, all.walks - 1);
  long wrong = 0;
  for (const auto& [name, count] : all.raised) wrong += count.wrong;
  for (const auto& [name, count] : all.nudged) wrong += count.wrong;
  EXPECT_GT(wrong, 50);
  EXPECT_GT(all.proved_controls, all.controls / 2);
}

}  // namespace
}  // namespace halfstep::checker
