// What the checker makes of obstacles that move.

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "experiments/commands/commands.h"
#include "experiments/verify/obstacle_path.h"
#include "tests/verify/verify_mutation.h"

namespace halfstep {
namespace {

using testing::HasSubstr;

TEST(VerifyMoving, ItsOwnFormulasAgreeWithTheProgram) {
  std::mt19937 random(41);
  const auto drawn = [&random](double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(random);
  };
  double fastest = 0.0;
  for (int i = 0; i < 200; ++i) {
    Obstacle obstacle{.name = "o", .shape = Sphere{0.1}};
    obstacle.X_WO = Eigen::Translation3d(drawn(-1, 1), drawn(-1, 1), drawn(0, 1)) *
                    Eigen::AngleAxisd(drawn(-3, 3), Eigen::Vector3d(0.6, 0.0, 0.8));
    double t = 0.0;
    for (int k = 0; k < 3; ++k) {
      t += drawn(0.2, 1.5);
      obstacle.motion.waypoints.push_back(
          {t, {drawn(-1, 1), drawn(-1, 1), drawn(0, 1)}, drawn(-4, 4)});
    }
    obstacle.motion.error = drawn(0, 0.1);
    obstacle.motion.speed = drawn(0, 0.5);
    obstacle.motion.measured_at = drawn(-1, 2);
    if (i % 2 == 0) obstacle.motion.horizon = drawn(0, 2);
    const verify::ObstaclePath path(obstacle, 0.5);
    for (int k = 0; k < 20; ++k) {
      const double a = drawn(-1, 6), b = a + drawn(0, 0.5);
      EXPECT_TRUE(path.At(a).isApprox(obstacle.PoseAt(a), 1e-12)) << a;
      EXPECT_NEAR(path.Uncertainty(a), obstacle.UncertaintyAt(a), 1e-12);
      const Eigen::Vector3d p(0.3, 0.4, 0.0);
      const double change = (path.At(a) * p - path.At(b) * p).norm() +
                            std::abs(path.Uncertainty(a) - path.Uncertainty(b));
      const double way = path.FastestWithin(a, b) * (b - a);
      EXPECT_LE(change, way + 1e-12);
      fastest = std::max(fastest, change / (way + 1e-9));
    }
  }
  EXPECT_GT(fastest, 0.9);
}

const TamperedWalk kCrossing{.config = "crossing"};

TEST(VerifyMoving, ARunAmongThemIsVerified) {
  const TamperedRun run(kCrossing);
  const Outcome outcome = run.Verify();
  EXPECT_EQ(outcome.status, kSuccess) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\n  verified\n"));
}

struct Untruth {
  std::string name, old, by, reason;
};
void PrintTo(const Untruth& one, std::ostream* out) { *out << one.name; }

class OfMotion : public testing::TestWithParam<Untruth> {};

// The scene is another one, and all hashes follow: what the walk is then is for distances to say.
TEST_P(OfMotion, IsFound) {
  TamperedRun run(kCrossing);
  TamperedRun::Replace(run.scene(), GetParam().old, GetParam().by);
  run.Rehash();
  const Outcome outcome = run.Verify();
  EXPECT_EQ(outcome.status, kNotVerified) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out + outcome.err, HasSubstr(GetParam().reason));
}

INSTANTIATE_TEST_SUITE_P(
    VerifyMoving, OfMotion,
    testing::Values(Untruth{"TheBoxIsLater", "{t_s: 10.0,", "{t_s: 12.0,", " - box"},
                    Untruth{"TheBoxIsLessKnown", "error_m: 0.01", "error_m: 0.03", " - box"},
                    Untruth{"TheBoxMayMove", "error_m: 0.01",
                            "error_m: 0.01\n      speed_m_s: 0.01", " - box"},
                    Untruth{"TheBarMovesWhereNothingIsNear", "{t_s: 8.0, xyz", "{t_s: 4.0, xyz",
                            "clearance_m is "}),
    [](const testing::TestParamInfo<Untruth>& one) { return one.param.name; });

}  // namespace
}  // namespace halfstep
