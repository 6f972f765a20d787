#include "planner/swept/swept_volume.h"

#include <gtest/gtest.h>

#include "tests/planner/swept_volume_draws.h"
#include "tests/wpg/shipped_robots.h"
#include "wpg/motion/lipm.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// How many of random points of the moving robot, pushed outwards by at most δ, lie outside.
int CountOutside(const BoxTree& tree, const HalfStep& half_step, double clearance, int draws,
                 SweptDraw* draw, const RobotModel& robot = SweptRobot()) {
  const HalfStepTracks tracks(half_step, LipmOf(robot));
  int outside = 0;
  for (int i = 0; i < draws; ++i) {
    const BodyPoint point = DrawBodyPoint(robot, half_step, tracks, draw);
    outside += !tree.Contains(point.p_S + clearance * draw->Direction());
  }
  return outside;
}

TEST(SweptVolumeTest, ContainsTheRobotAndItsClearanceAtAllTimes) {
  const SweptVolumes& volumes = CoarseVolumes();
  SweptDraw draw(1);
  for (int i = 0; i < volumes.set.size(); ++i) {
    const size_t e = static_cast<size_t>(i);
    ASSERT_TRUE(volumes.down[e] && volumes.up[e]);
    const double clearance = CoarseOptions().clearance;
    EXPECT_EQ(
        CountOutside(*volumes.down[e], volumes.set.Down(i, Side::kLeft), clearance, 1500, &draw),
        0);
    EXPECT_EQ(CountOutside(*volumes.up[e], volumes.set.Up(i, Side::kRight), clearance, 1500, &draw),
              0);
  }
}

TEST(SweptVolumeTest, ContainsOtherShippedRobots) {
  for (const std::string name : {"wren", "bison"}) {
    SCOPED_TRACE(name);
    const RobotModel robot = ShippedRobot(name);
    const double size = LegScale(robot);
    const SweptVolumeOptions options{.cell = 0.03 * size, .displacement = 0.01 * size};
    const SweptVolumeBaker baker(robot, options);
    HalfStep half_step = FewHalfSteps().Down(0, Side::kLeft);
    half_step.X_SF = Foothold::Level({0.2 * size, -robot.standing_width - 0.05 * size, 0.25});
    half_step.via_height = 0.2 * size;
    half_step.via_lateral = 1.14 * robot.standing_width;
    const auto tree = baker.Bake(half_step, LipmOf(robot));
    ASSERT_TRUE(tree);
    SweptDraw draw(6);
    EXPECT_EQ(CountOutside(*tree, half_step, options.clearance, 1500, &draw, robot), 0);
    EXPECT_GT(CountOutside(Eroded(*tree), half_step, options.clearance, 1500, &draw, robot), 15);
  }
}

// A robot with one heavy hand, walking on its other foot.
TEST(SweptVolumeTest, ContainsTheMirroredHalfStepOfAnAsymmetricRobot) {
  RobotModel robot = SweptRobot();
  robot.bodies.resize(1);
  const Eigen::Vector3d hand(0.1, 0.4, 0.3);
  robot.bodies[0].shape.vertices.col(0) += hand;
  robot.bodies[0].shape = MakeHull(robot.bodies[0].shape.vertices);
  const SweptVolumeBaker baker(robot, CoarseOptions());
  const HalfStep half_step = FewHalfSteps().Down(0, Side::kLeft);
  const auto tree = baker.Bake(half_step, LipmOf(robot));
  ASSERT_TRUE(tree);
  SweptDraw draw(5);
  EXPECT_EQ(CountOutside(*tree, half_step, 0.005, 500, &draw, robot), 0);
  const HalfStep mirrored = half_step.Mirrored();
  const HalfStepTracks tracks(mirrored, LipmOf(robot));
  int right_hand = 0;
  for (int i = 0; i < 500; ++i) {
    Vector3d p = DrawBodyPoint(robot, mirrored, tracks, &draw).p_S;
    right_hand += p.y() > 0.3;
    p.y() = -p.y();
    EXPECT_TRUE(tree->Contains(p));
  }
  EXPECT_GT(right_hand, 5);
}

// A small box on the waist, 0.9 mm farther left than right: within what its twin, itself, may be
// off. It sticks out to the right when the robot walks on its other foot.
TEST(SweptVolumeTest, ContainsTheMirrorImageOfABodyThatIsNotQuiteItsTwins) {
  RobotModel robot = SweptRobot();
  robot.bodies.resize(1);
  RobotBody& box = robot.bodies[0];
  box.leg = box.link = -1;
  box.shape = MakeBox({0.02, 0.02, 0.02});
  box.shape.vertices.row(1).array() += 0.00045;
  box.shape = MakeHull(box.shape.vertices);
  const SweptVolumeBaker baker(robot, {.cell = 1e-3, .displacement = 1e-4, .clearance = 0.0});
  const HalfStep half_step = FewHalfSteps().Down(0, Side::kLeft);
  const auto tree = baker.Bake(half_step, LipmOf(robot));
  ASSERT_TRUE(tree);
  const HalfStep mirrored = half_step.Mirrored();
  const HalfStepTracks tracks(mirrored, LipmOf(robot));
  SweptDraw draw(7);
  int without = 0;
  for (int i = 0; i < 2000; ++i) {
    const double tau = draw.Uniform(0, mirrored.duration);
    const Posture posture = SolvePosture(robot, tracks.At(tau).value);
    const Eigen::Isometry3d& X_SBody = posture.OfBody(box);
    const Vector3d left = X_SBody.linear().transpose() * Vector3d::UnitY();
    Vector3d p = X_SBody * (SupportPoint(box.shape, left) - 1e-6 * left);
    p.y() = -p.y();
    EXPECT_TRUE(tree->Contains(p));
    without += !tree->Contains(p - Vector3d(0, 0.9e-3, 0));  // a control
  }
  EXPECT_GT(without, 200);
}

TEST(SweptVolumeTest, ControlVolumeLessItsOutermostCellsDoesNot) {
  const SweptVolumes& volumes = CoarseVolumes();
  SweptDraw draw(2);
  const BoxTree less = Eroded(*volumes.down[0]);
  EXPECT_TRUE(less.IsSound());
  EXPECT_LT(less.Volume(), volumes.down[0]->Volume());
  EXPECT_GT(CountOutside(less, volumes.set.Down(0, Side::kLeft), 0.005, 1500, &draw), 15);
}

// Time reversal changes nothing.
TEST(SweptVolumeTest, UpAndDownOfOnePlaceSweepTheSame) {
  const SweptVolumeBaker baker(SweptRobot(), CoarseOptions());
  HalfStep half_step = FewHalfSteps().Down(0, Side::kLeft);
  const auto down = baker.Bake(half_step, LipmOf(SweptRobot()));
  half_step.kind = HalfStepKind::kUp;
  const auto up = baker.Bake(half_step, LipmOf(SweptRobot()));
  ASSERT_TRUE(up && down);
  EXPECT_NEAR(up->Volume() / down->Volume(), 1.0, 0.01);
  SweptDraw draw(3);
  EXPECT_EQ(CountOutside(*down, half_step, 0.005, 1000, &draw), 0);
}

TEST(SweptVolumeTest, FinerBakesAreSmaller) {
  const Lipm lipm = LipmOf(SweptRobot());
  const HalfStep half_step = FewHalfSteps().Down(0, Side::kLeft);
  double last = 1e9;
  for (const double cell : {0.1, 0.05, 0.03}) {
    const SweptVolumeBaker baker(SweptRobot(), {.cell = cell, .displacement = 0.3 * cell});
    const auto volume = baker.Bake(half_step, lipm);
    ASSERT_TRUE(volume);
    EXPECT_LT(volume->Volume(), last);
    last = volume->Volume();
  }
}

TEST(SweptVolumeTest, OutOfReachHasNone) {
  const SweptVolumeBaker baker(SweptRobot(), CoarseOptions());
  HalfStep half_step;
  half_step.X_SF = Foothold::Level({0.9, -0.2, 0.0});
  EXPECT_FALSE(baker.Bake(half_step, LipmOf(SweptRobot())).has_value());
}

TEST(SweptVolumeTest, IntervalsCoverAllTimeForEachBody) {
  const SweptVolumeBaker baker(SweptRobot(), CoarseOptions());
  const auto placements = baker.Cover(FewHalfSteps().Down(0, Side::kLeft), LipmOf(SweptRobot()));
  ASSERT_TRUE(placements);
  std::vector<int> count(SweptRobot().bodies.size(), 0);
  for (const auto& placement : *placements) {
    EXPECT_LE(placement.displacement, CoarseOptions().displacement);
    ++count[placement.body];
  }
  for (int c : count) EXPECT_GT(c, 0);
}

// A displacement that is never too long leaves intervals of one length, in order.
TEST(SweptVolumeTest, PlacementsCoverTheHalfStepAndNoBodyLeavesItsOwn) {
  SweptVolumeOptions options = CoarseOptions();
  options.displacement = 0.01;
  const RobotModel& robot = SweptRobot();
  const SweptVolumeBaker baker(robot, options);
  for (int element = 0; element < FewHalfSteps().size(); ++element) {
    const HalfStep half_step = FewHalfSteps().Down(element, Side::kLeft);
    const Lipm lipm = LipmOf(robot);
    const HalfStepTracks tracks(half_step, lipm);
    const auto placements = baker.Cover(half_step, lipm);
    ASSERT_TRUE(placements);
    std::vector<double> covered(robot.bodies.size(), 0.0);  // by body, until then [s]
    double longest = 0.0;
    for (const auto& placement : *placements) {
      const RobotBody& body = robot.bodies[placement.body];
      const double from = covered[placement.body], to = 2.0 * placement.time - from;
      ASSERT_GT(to, from) << body.name;
      covered[placement.body] = to;
      longest = std::max(longest, to - from);
      ASSERT_LE(placement.displacement, to - from > 0.0081 ? 0.004 : 0.01) << body.name;
      for (const double at : {1e-9, 0.5, 1 - 1e-9}) {
        const double tau = from + at * (to - from);
        const Posture posture = SolvePosture(robot, tracks.At(tau).value);
        ASSERT_TRUE(posture.reachable);
        const Eigen::Isometry3d& X = posture.OfBody(body);
        const Eigen::Matrix<double, 3, 4> moved =
            X.matrix().topRows<3>() - placement.X_SBody.matrix().topRows<3>();
        const double farthest =
            ((moved.leftCols<3>() * body.shape.vertices).colwise() + moved.col(3))
                .colwise()
                .norm()
                .maxCoeff();
        ASSERT_LE(farthest, placement.displacement + 1e-12) << body.name << " " << tau;
      }
    }
    for (const double until : covered) EXPECT_NEAR(until, half_step.duration, 1e-12);
    EXPECT_GT(longest, 0.01);
  }
}

TEST(VoxelGridTest, FillsEveryCellThatARegionMeets) {
  SweptDraw draw(4);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Matrix3d R = draw.Turn(trial % 4 == 0);
    const Vector3d half = draw.Point({0.02, 0.02, 0.02}, {0.2, 0.2, 0.2});
    HalfSpaces region;
    region.normals.resize(3, 6);
    region.normals << R, -R;
    region.offsets.resize(6);
    region.offsets << half, half;
    const Vector3d reach = R.cwiseAbs() * half;
    region.lower = -reach;
    region.upper = reach;
    VoxelGrid grid(-reach, reach, 0.03);
    grid.Fill(region);
    const BoxTree tree = BoxTree::Build(grid);
    for (int k = 0; k < 200; ++k) {
      EXPECT_TRUE(tree.Contains(R * draw.Point(-half, half)));
    }
    EXPECT_LT(tree.Volume(), (2 * half.array() + 4 * 0.03).prod());
  }
}

// Cells so fine, and no clearance: neither hides what a body moves within its interval of time.
// Points where a body is farthest along its own velocity, which is where it would stand out.
TEST(SweptVolumeTest, ContainsWhatABodyMovesWithinItsIntervals) {
  RobotModel robot = SweptRobot();
  std::erase_if(robot.bodies, [](const RobotBody& b) { return b.leg < 0 || b.link < 5; });
  const SweptVolumeBaker baker(robot, {.cell = 2.5e-3, .displacement = 0.02, .clearance = 0.0});
  HalfStep half_step = FewHalfSteps().Down(0, Side::kLeft);
  half_step.duration = 0.7;
  const auto tree = baker.Bake(half_step, LipmOf(robot));
  ASSERT_TRUE(tree);
  const HalfStepTracks tracks(half_step, LipmOf(robot));
  SweptDraw draw(6);
  double fastest = 0.0;
  int outside = 0;
  for (int i = 0; i < 5000; ++i) {
    const double tau = draw.Uniform(0, half_step.duration);
    const RobotBody& body = robot.bodies[static_cast<size_t>(draw.Index(2))];
    const WalkJet jet = tracks.At(tau);
    const Vector3d velocity =
        jet.first.segment<3>(FootIndex(body.leg == 0 ? Side::kLeft : Side::kRight));
    const Vector3d ahead = velocity.norm() > 1e-3 ? velocity.normalized() : draw.Direction();
    const Posture posture = SolvePosture(robot, jet.value);
    const Eigen::Isometry3d& X_SBody = posture.OfBody(body);
    const Vector3d direction = X_SBody.linear().transpose() * (ahead + 0.2 * draw.Direction());
    outside += !tree->Contains(X_SBody * SupportPoint(body.shape, direction));
    fastest = std::max(fastest, velocity.norm());
  }
  EXPECT_EQ(outside, 0);
  EXPECT_GT(fastest, 1.0);  // 4 ms of it are more than a cell
}

}  // namespace
}  // namespace halfstep
