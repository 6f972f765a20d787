// Rows of a certificate that are shorter than what ends of motions are rounded by.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/verify/verify_run.h"
#include "tests/verify/verify_mutation.h"
#include "wpg/files/number_text.h"

namespace halfstep {
namespace {

enum : size_t { kSliverBegin, kSliverEnd, kSliverFamily, kSliverMargin = 5 };

// Where a foot comes to stand, a row of its own says `length` [s] too early that it does.
std::string VerdictOfSliver(double length) {
  TamperedRun run;
  run.EditCertificate([length](TamperedRun::Table& table) {
    std::vector<std::string>* moves = nullptr;
    for (size_t i = 1; i < table.size(); ++i) {
      if (table[i][kSliverFamily] != "floor") continue;
      if (table[i][kSliverMargin] != "inf") {
        moves = &table[i];
        continue;
      }
      if (moves == nullptr || (*moves)[kSliverEnd] != table[i][kSliverBegin]) continue;
      std::vector<std::string> sliver = table[i];
      sliver[kSliverEnd] = table[i][kSliverBegin];
      sliver[kSliverBegin] = (*moves)[kSliverEnd] =
          ShortestText(std::stod(table[i][kSliverBegin]) - length);
      while (table[i - 1][kSliverBegin] == table[i][kSliverBegin]) --i;
      table.insert(table.begin() + static_cast<std::ptrdiff_t>(i), sliver);
      return;
    }
    FAIL() << "no foot comes to stand";
  });
  run.Rehash();
  const auto results = VerifyProved({.run = run.run().string(), .method = "dichotomy"});
  return results.front().verified ? "verified" : verify::Describe(results.front());
}

TEST(VerifySliver, WithinRoundingAFootMayStandOrMove) {
  EXPECT_EQ(VerdictOfSliver(4e-16), "verified");
  EXPECT_EQ(VerdictOfSliver(1e-14), "verified");
  EXPECT_THAT(VerdictOfSliver(1e-7), testing::HasSubstr("a foot moves"));
}

}  // namespace
}  // namespace halfstep
