#include "smoothing/methods/search_pace.h"

#include <gtest/gtest.h>

namespace halfstep {
namespace {

TEST(SearchPace, EndsAfterPoorRoundsInARow) {
  SearchPace pace(40, 3);
  pace.Note(5.0, 6.0, 5.0);
  pace.Note(4.999, 5.0, 4.999);  // less than a thousandth
  pace.Note(4.999, 4.999, 4.998);
  EXPECT_FALSE(pace.over());
  pace.Note(4.8, 4.998, 4.8);
  EXPECT_EQ(pace.poor(), 0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(pace.over());
    pace.Note(4.8, 4.8, 4.8);
  }
  EXPECT_TRUE(pace.over());
  EXPECT_FALSE(pace.exhausted());
}

// Reserves grow until the proof succeeds; to end before would leave the gain behind.
TEST(SearchPace, APointThatWaitsForItsProofIsNoPoorRound) {
  SearchPace pace(20, 2);
  pace.Note(4.0, 5.0, 5.0);
  for (int i = 0; i < 18; ++i) {
    EXPECT_FALSE(pace.over()) << i;
    pace.Note(4.0, 5.0, 5.0);
  }
  pace.Note(4.0, 5.0, 5.0);
  EXPECT_TRUE(pace.exhausted());
  EXPECT_TRUE(pace.over());
}

TEST(SearchPace, EndsWhereTheIncumbentIsOutOfReach) {
  SearchPace pace(40, 5);
  double end = 10.0;
  int rounds = 0;
  for (; !pace.over() && rounds < 40; ++rounds) pace.Note(end -= 0.03, 3.0, 3.0);
  EXPECT_TRUE(pace.over());
  EXPECT_LT(rounds, 10);
}

TEST(SearchPace, GoesOnWhereThePaceIsEnough) {
  SearchPace pace(40, 5);
  double end = 10.0;
  int rounds = 0;
  for (; !pace.over(); ++rounds) pace.Note(end = 3.0 + 0.8 * (end - 3.0), 3.0, 3.0);
  EXPECT_GT(rounds, 15);
}

TEST(SearchPace, AFirstWalkIsAGain) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(SearchPace::Gained(kInfinity, 1.0));
  EXPECT_FALSE(SearchPace::Gained(kInfinity, kInfinity));
  EXPECT_FALSE(SearchPace::Gained(1.0, 0.9995));
  EXPECT_TRUE(SearchPace::Gained(1.0, 0.998));
}

}  // namespace
}  // namespace halfstep
