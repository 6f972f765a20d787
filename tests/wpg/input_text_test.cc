#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

TEST(NumberText, ReadsBackEveryDouble) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    const NumberText number = ParseNumber(ShortestText(value));
    ASSERT_EQ(number.kind, NumberText::Kind::kNumber) << ShortestText(value);
    ASSERT_EQ(std::bit_cast<uint64_t>(number.value), std::bit_cast<uint64_t>(value));
  }
}

TEST(NumberText, ReadsBackRadiansWrittenInDegrees) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> angle(-4.0, 4.0);
  for (int i = 0; i < 20000; ++i) {
    const double radians = angle(random);
    const std::string text = ShortestDegrees(radians);
    ASSERT_EQ(DegreesToRadians(ParseNumber(text).extended), radians) << text;
  }
  for (int degrees = -360; degrees <= 360; ++degrees) {
    EXPECT_EQ(ShortestDegrees(DegreesToRadians(degrees)), std::to_string(degrees));
  }
}

TEST(NumberText, TellsWhichNumberADecimalCommaMeans) {
  EXPECT_EQ(PointNeeded("0,5"), "a decimal point is needed: 0.5?");
  EXPECT_EQ(PointNeeded("-,5e-3"), "a decimal point is needed: -.5e-3?");
  for (const char* other : {"0.5", "1,000,000", "a,b", ",", "", "1,2.3"}) {
    EXPECT_EQ(PointNeeded(other), "") << other;
  }
  EXPECT_EQ(NumberMistake("0,5"), "'0,5' is not a number (a decimal point is needed: 0.5?)");
  EXPECT_EQ(NumberMistake("nan"), "'nan' is not a finite number");
  EXPECT_EQ(NumberMistake("010"), "'010' is not a decimal number (leading zero)");
}

TEST(NumberText, IsShortenedToAFewDigits) {
  EXPECT_EQ(Shortened(3.14159265, 3), 3.14);
  EXPECT_EQ(Shortened(-1234567.0), -1234600.0);
  EXPECT_EQ(Shortened(0.0), 0.0);
  EXPECT_EQ(Shortened(2.5, 1), 2.0) << "half to even";
}

TEST(NearestWord, FindsSlipsOnly) {
  const std::vector<std::string> words{"overlap_max_s", "clearance_m", "x"};
  EXPECT_EQ(NearestWord("ovrlap_max_s", words), "overlap_max_s");
  EXPECT_EQ(NearestWord("claerance_m", words), "clearance_m");
  EXPECT_EQ(NearestWord("duration_s", words), "");
  EXPECT_EQ(NearestWord("y", words), "");
  EXPECT_EQ(NearestWord("", words), "");
  EXPECT_EQ(NearestWord(std::string(1000, 'x'), words), "");
}

TEST(Quote, ShowsWhatATerminalMustNotSee) {
  EXPECT_EQ(Quote("a\x1B[2J\xFFé"), "'a\\x1B[2J\\xFFé'");
  EXPECT_EQ(Quote(std::string(100, 'x')), "'" + std::string(60, 'x') + "…'");
}

TEST(Printable, KeepsLineBreaksAndShowsOtherControls) {
  EXPECT_EQ(Printable("a\nb\r\x1B[2J\xC2\x9Bm\xC3é"), "a\nb\\x0D\\x1B[2J\\xC2\\x9Bm\\xC3é");
  EXPECT_EQ(Printable(std::string(1, '\0')), "\\x00");
}

}  // namespace
}  // namespace halfstep
