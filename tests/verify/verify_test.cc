#include "experiments/verify/verify_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "experiments/commands/commands.h"
#include "tests/verify/verify_mutation.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
using Table = TamperedRun::Table;

TEST(Verify, AcceptsARunAndSaysWhatIsGuaranteed) {
  TamperedRun run;
  Outcome outcome = run.Verify();
  EXPECT_EQ(outcome.status, kSuccess) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\n  verified\n"));
  EXPECT_THAT(outcome.out, HasSubstr("Guaranteed for every instant"));
  const Outcome verbose =
      Halfstep(run.run(), {"verify", ".", "--method", "dichotomy", "--verbose"});
  EXPECT_EQ(verbose.status, kSuccess) << verbose.err;
  EXPECT_EQ(verbose.out, outcome.out);
  const Outcome brief = Halfstep(run.run().parent_path(), {"verify", "run"});
  EXPECT_EQ(brief.status, kSuccess);
  EXPECT_THAT(brief.out, testing::ContainsRegex("^dichotomy +verified \\([0-9]+ checks\\)\n"));
  EXPECT_THAT(brief.out, testing::Not(HasSubstr("Guaranteed")));
  // The tampering itself, without a change, spoils nothing.
  run.EditTrajectory([](Table&) {});
  run.EditCertificate([](Table&) {});
  run.Rehash();
  EXPECT_EQ(run.Verify().status, kSuccess);
}

TEST(Verify, AcceptsEveryMethodOfAWalkOverABar) {
  const TemporaryFolder place;
  const Outcome run = Halfstep(place.path(), {"run", ShippedConfig("bar_8cm"), "--out", "run",
                                              "--quiet", "--set", "output.period_s=0.004"});
  ASSERT_EQ(run.status, kSuccess) << run.err;
  const auto results = VerifyProved({.run = (place / "run").string()});
  ASSERT_EQ(results.size(), 3u);
  for (const auto& result : results) EXPECT_TRUE(result.verified) << verify::Describe(result);
}

TEST(Verify, ToleranceIsWhatSeparatesTheTrajectoryFromTheWalk) {
  const TamperedRun run(TamperedWalk{.overrides = {"output.period_s=0.01"}});
  verify::VerifyOptions options{.run = run.run().string(), .method = "dichotomy"};
  options.tolerance = 0;
  EXPECT_FALSE(VerifyProved(options).front().verified);
  EXPECT_NE(VerifyProved(options).front().too_coarse, "");
  options.tolerance = 1e-4;
  EXPECT_TRUE(VerifyProved(options).front().verified);
}

TEST(Verify, TakesAnotherSceneOnlyWhenItIsTheSame) {
  const TamperedRun run;
  const TemporaryFolder elsewhere;
  const std::string copy = WriteText(elsewhere / "box.yaml", ReadText(run.scene()));
  verify::VerifyOptions options{.run = run.run().string(), .method = "dichotomy", .scene = copy};
  EXPECT_TRUE(VerifyProved(options).front().verified);
  options.scene = "none";
  EXPECT_FALSE(VerifyProved(options).front().verified);
}

TEST(Verify, MethodWithoutCertificateIsNamedAndNotVerified) {
  const TamperedRun run;
  for (const std::string file : {"certificate.csv", "certificate.json"}) {
    std::filesystem::remove(run.run() / "raw" / file);
  }
  std::vector<std::string> without;
  for (const auto& result : VerifyProved({.run = run.run().string()})) {
    if (result.verified) continue;
    without.push_back(result.method);
    EXPECT_THAT(verify::Describe(result), HasSubstr("there is no certificate"));
  }
  EXPECT_THAT(without, testing::ElementsAre("raw"));
  // A method of the manifest whose whole folder is gone is missed as well.
  std::filesystem::remove_all(run.run() / "raw");
  EXPECT_EQ(VerifyProved({.run = run.run().string()}).size(), 2u);
}

TEST(Verify, BadInputIsStatusTwo) {
  const TemporaryFolder place;
  EXPECT_EQ(Halfstep(place.path(), {"verify", "nowhere"}).status, kBadInput);
  EXPECT_EQ(Halfstep(place.path(), {"verify", "."}).status, kBadInput);
  TamperedRun run;
  EXPECT_EQ(Halfstep(run.run(), {"verify", ".", "--method", "magic"}).status, kBadInput);
  EXPECT_EQ(Halfstep(run.run(), {"verify", ".", "--tolerance", "nan"}).status, kBadInput);
  for (const std::string& text :
       {std::string(), std::string("{"), std::string("[]"), std::string("{\"format\": 1e999}"),
        std::string(100000, '['), std::string("\0\xff", 2)}) {
    WriteText(run.json(), text);
    const Outcome outcome = run.Verify();
    EXPECT_EQ(outcome.status, kBadInput) << text.substr(0, 20);
    EXPECT_THAT(outcome.err, HasSubstr("certificate.json"));
  }
  const Outcome told = Halfstep(run.run(), {"verify", ".", "--method", "dichotomy"});
  EXPECT_EQ(told.status, kBadInput);
  EXPECT_THAT(told.err, HasSubstr("certificate.json"));
  for (const auto& path : {run.json(), run.certificate()}) {
    std::filesystem::remove(path);
    EXPECT_EQ(run.Verify().status, kBadInput);
  }
}

// One character of a file becomes another one.
void MutateOneCharacter(const std::filesystem::path& path, std::mt19937* random) {
  std::string text = ReadText(path);
  const std::string by = "0123456789.,-+e\n\"naif {}x";
  char& c = text[std::uniform_int_distribution<size_t>(0, text.size() - 1)(*random)];
  char other = c;
  while (other == c) other = by[std::uniform_int_distribution<size_t>(0, by.size() - 1)(*random)];
  c = other;
  WriteText(path, text);
}

// Every file below is covered by a hash: whatever changes is refused.
class OneCharacter : public testing::TestWithParam<unsigned> {};

TEST_P(OneCharacter, IsNeverAcceptedAndNeverCrashes) {
  const TamperedRun run;
  std::mt19937 random(GetParam());
  const std::vector<std::filesystem::path> files = {run.trajectory(), run.certificate(),
                                                    run.scene(), run.urdf()};
  for (int i = 0; i < 40; ++i) {
    const auto& path = files[static_cast<size_t>(i) % files.size()];
    const std::string before = ReadText(path);
    MutateOneCharacter(path, &random);
    const auto results = VerifyProved({.run = run.run().string(), .method = "dichotomy"});
    EXPECT_FALSE(results.front().verified) << path << " " << i;
    WriteText(path, before);
  }
}

INSTANTIATE_TEST_SUITE_P(Verify, OneCharacter, testing::Values(1u, 2u, 3u, 4u, 5u));

TEST(Verify, OneCharacterBehindTheHashNeverCrashes) {
  TamperedRun run;
  std::mt19937 random(6);
  for (int i = 0; i < 24; ++i) {
    const auto path =
        std::vector{run.trajectory(), run.certificate(), run.json()}[static_cast<size_t>(i) % 3];
    const std::string before = ReadText(path), json = ReadText(run.json());
    MutateOneCharacter(path, &random);
    if (path != run.json()) run.Rehash();
    EXPECT_NO_THROW((void)VerifyProved({.run = run.run().string(), .method = "dichotomy"}));
    WriteText(path, before);
    WriteText(run.json(), json);
  }
}

}  // namespace
}  // namespace halfstep
