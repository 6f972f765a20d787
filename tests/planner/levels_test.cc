// Planning from level to level: sets by rise, volumes of the parts, searches over stairs.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "planner/collision/collision_world.h"
#include "planner/search/planners.h"
#include "planner/swept/swept_volume_cache.h"
#include "tests/planner/blocks_ground.h"
#include "tests/planner/flat_world.h"
#include "tests/planner/swept_volume_draws.h"
#include "tests/temporary_folder.h"
#include "wpg/geometry/support_polygon.h"

namespace halfstep {
namespace {

const Eigen::Matrix2Xd kOutline = SoleCorners({}, {0.24, 0.14});

// Treads of 0.3 m from x = 0.3 m on, each higher by `rise` than the one before; the last goes on.
std::shared_ptr<const BlocksGround> BlockStairs(int count, double rise) {
  std::vector<GroundSolid> treads;
  for (int k = 0; k < count; ++k) {
    const double x = 0.3 + 0.3 * k, top = (k + 1) * rise;
    treads.push_back(Block("tread " + std::to_string(k + 1), x, k + 1 < count ? x + 0.3 : x + 2.0,
                           -1.0, 1.0, top, 0.0));
  }
  return std::make_shared<const BlocksGround>(0.0, treads);
}

std::vector<double> HeightsOf(const Ground& ground) {
  std::vector<double> heights;
  for (const GroundLevel& level : ground.Levels()) heights.push_back(level.height);
  std::ranges::sort(heights);
  return heights;
}

// Free is what lands on a level.
class LevelQuery : public HalfStepQuery {
 public:
  LevelQuery(const StepSet& set, const Ground& ground) : set_(set), ground_(ground) {}
  bool DownIsFree(int i, Side support, const Foothold& X_WS) const override {
    return Bears(X_WS * set_.Placement(i, support));
  }
  bool UpIsFree(int, Side, const Foothold&) const override { return true; }
  bool Bears(const Foothold& X_WF) const override {
    const auto level = ground_.LevelUnder(kOutline, X_WF.Planar(), X_WF.height + 1e-8);
    return level && std::abs(level->height - X_WF.height) <= 1e-8;
  }

 private:
  const StepSet& set_;
  const Ground& ground_;
};

StepSet PlausibleSetOn(const std::vector<double>& rises) {
  const StepSet flat = PlausibleSet();
  StepSet set{.prototype = flat.prototype, .placements = {}, .on_levels = true};
  for (const double rise : rises) {
    for (Foothold X_SF : flat.placements) {
      X_SF.height = rise;
      set.placements.push_back(X_SF);
    }
  }
  return set;
}

PlanResult PlanOn(const Ground& ground, const StepSet& set, const std::string& planner,
                  double goal_x, int nodes = 20000) {
  const LevelQuery query(set, ground);
  PlanRequest request = RequestTo({goal_x, 0.0, 0.0}, set, query);
  request.levels = HeightsOf(ground);
  request.goal.radius = 0.2;
  request.stop = AnyOf({AtFirstPlan(), AfterNodes(nodes)});
  std::mt19937_64 random(1);
  return Planners::Standard().Make(planner, {})->Plan(request, random);
}

// The same for level elements that land on the ground under them.
class GroundQuery : public HalfStepQuery {
 public:
  GroundQuery(const StepSet& set, const Ground& ground) : set_(set), ground_(ground) {}
  double HeightAt(const Pose2& X_WF, double from) const {
    const auto level = ground_.LevelUnder(kOutline, X_WF, from + 0.2);
    return level && level->height >= from - 0.2 ? level->height
                                                : std::numeric_limits<double>::quiet_NaN();
  }
  bool DownIsFree(int i, Side support, const Foothold& X_WS) const override {
    const Pose2 X_WF = (X_WS * set_.Placement(i, support)).Planar();
    return std::isfinite(HeightAt(X_WF, X_WS.height));
  }
  bool UpIsFree(int, Side, const Foothold&) const override { return true; }
  bool Bears(const Foothold& X_WF) const override { return std::isfinite(X_WF.height); }

 private:
  const StepSet& set_;
  const Ground& ground_;
};

TEST(RisesBetween, AreTheDifferencesOfHeightWithZeroFirst) {
  EXPECT_EQ(RisesBetween({0.0}, 0.3), std::vector<double>{0.0});
  const double r = 0.1;
  const std::vector<double> rises = RisesBetween({0.0, r, r + r, r + r + r}, 0.25);
  ASSERT_EQ(rises.size(), 5u);
  const double expected[] = {0.0, -0.2, -0.1, 0.1, 0.2};
  for (size_t i = 0; i < 5; ++i) EXPECT_NEAR(rises[i], expected[i], 1e-12);
  EXPECT_EQ(RisesBetween({0.0, 1.0}, 0.25), std::vector<double>{0.0});
}

TEST(StepSetOnLevels, HasThePlacesOfEachRise) {
  const auto any = [](const HalfStep&) { return true; };
  const StepGrid grid{
      .x_min = 0.0, .x_max = 0.1, .y_min = -0.3, .y_max = -0.2, .spacing = 0.1, .yaws = {0.0}};
  const HalfStep prototype{.via_height = 0.15};
  const StepSet flat = MakeStepSet(grid, prototype, any);
  const StepSet set = MakeStepSet(grid, prototype, {0.0, -0.1, 0.1, 0.2}, any);
  EXPECT_FALSE(flat.on_levels);
  EXPECT_TRUE(set.on_levels);
  ASSERT_EQ(set.size(), 3 * flat.size());  // 0.2 is above the via point
  for (int i = 0; i < flat.size(); ++i)
    EXPECT_EQ(set.Placement(i, Side::kLeft), flat.placements[static_cast<size_t>(i)]);
  const int up = 2 * flat.size();
  EXPECT_EQ(set.Down(up, Side::kLeft).X_SF.height, 0.1);
  EXPECT_EQ(set.Up(up, Side::kLeft).X_SF.height, -0.1);
  EXPECT_EQ(set.Down(up, Side::kRight).X_SF.height, 0.1);
}

TEST(LevelPlanning, LandsOnTheGroundUnderTheElements) {
  const auto stairs = BlockStairs(4, 0.15);
  const StepSet set = PlausibleSet();
  const GroundQuery query(set, *stairs);
  for (const char* planner : {"best", "astar", "astar/classic", "rrt"}) {
    PlanRequest request = RequestTo({1.6, 0.0, 0.0}, set, query);
    request.ground = [&query](const Pose2& X_WF, double from) {
      return query.HeightAt(X_WF, from);
    };
    request.goal.radius = 0.2;
    request.stop = AnyOf({AtFirstPlan(), AfterNodes(20000)});
    std::mt19937_64 random(1);
    const PlanResult result = Planners::Standard().Make(planner, {})->Plan(request, random);
    ASSERT_EQ(result.status, PlanStatus::kSolved) << planner << ": " << result.sentence;
    for (const Footstep& footstep : result.footsteps) {
      const auto level = stairs->LevelUnder(kOutline, footstep.X_WF.Planar(), 10.0);
      ASSERT_TRUE(level.has_value()) << planner;
      EXPECT_EQ(level->height, footstep.X_WF.height) << planner;
    }
    EXPECT_EQ(result.footsteps.back().X_WF.height, stairs->Levels().back().height);
    // Where nothing bears, nothing is found.
    request.ground = [](const Pose2&, double) { return std::numeric_limits<double>::quiet_NaN(); };
    std::mt19937_64 again(1);
    EXPECT_EQ(Planners::Standard().Make(planner, {})->Plan(request, again).status,
              PlanStatus::kNoPlan);
  }
}

TEST(LevelPlanning, ClimbsStairs) {
  const auto stairs = BlockStairs(4, 0.15);
  const StepSet set = PlausibleSetOn(RisesBetween(HeightsOf(*stairs), 0.2));
  for (const char* planner : {"best", "astar", "astar/classic", "rrt"}) {
    const PlanResult result = PlanOn(*stairs, set, planner, 1.6);
    ASSERT_EQ(result.status, PlanStatus::kSolved) << planner << ": " << result.sentence;
    std::array<Foothold, 2> feet = {Foothold::Level({0.0, 0.1, 0.0}),
                                    Foothold::Level({0.0, -0.1, 0.0})};
    for (size_t j = 0; j < result.footsteps.size(); ++j) {
      const Footstep& footstep = result.footsteps[j];
      // On the level itself, to the bit.
      EXPECT_EQ(stairs->Standing(kOutline, footstep.X_WF.Planar()), footstep.X_WF);
      const Foothold& support = feet[static_cast<size_t>(Index(Opposite(footstep.side)))];
      const Foothold expected =
          support * set.Placement(result.elements[j], Opposite(footstep.side));
      EXPECT_EQ(expected.Planar(), footstep.X_WF.Planar());
      EXPECT_NEAR(expected.height, footstep.X_WF.height, 1e-12);
      feet[static_cast<size_t>(Index(footstep.side))] = footstep.X_WF;
    }
    EXPECT_EQ(result.footsteps.back().X_WF.height, 4 * 0.15);
    // Controls: no way is found without higher places, nor where treads are too high.
    const int many = 200;
    EXPECT_NE(PlanOn(*stairs, PlausibleSetOn({0.0}), planner, 1.6, many).status,
              PlanStatus::kSolved);
    EXPECT_NE(PlanOn(*BlockStairs(2, 0.21), set, planner, 1.6, many).status, PlanStatus::kSolved);
  }
}

// A goal on a level is not reached on another one beside it.
TEST(LevelPlanning, AGoalMayBeOnALevel) {
  GoalRegion goal;
  goal.X_WG = {1.0, 0.0, 0.0};
  goal.radius = 0.3;
  const Foothold high({1.0, 0.1, 0.0}, 0.15), low = Foothold::Level({1.0, -0.1, 0.0});
  EXPECT_TRUE(goal.ContainsLanding(Side::kLeft, high, low));
  EXPECT_TRUE(goal.ContainsLanding(Side::kRight, low, high));
  goal.height = 0.15;
  EXPECT_TRUE(goal.ContainsLanding(Side::kLeft, high, low));
  EXPECT_FALSE(goal.ContainsLanding(Side::kRight, low, high));
  EXPECT_TRUE(goal.ContainsStance({high, low}));
  goal.part = GoalPart::kMidFeet;
  EXPECT_FALSE(goal.ContainsLanding(Side::kLeft, high, low));
  EXPECT_FALSE(goal.ContainsStance({high, low}));
  EXPECT_TRUE(goal.ContainsLanding(Side::kLeft, high, {low.Planar(), 0.15}));
}

// States in one cell are told apart by their level.
TEST(LevelPlanning, CellsDifferByHeight) {
  const PoseCells cells;
  const Pose2 X{0.3, -0.2, 0.1};
  const StepState low{Foothold::Level(X), Side::kLeft}, high{{X, 0.15}, Side::kLeft},
      higher{{X, 0.3}, Side::kLeft};
  EXPECT_NE(cells.KeyOf(low), cells.KeyOf(high));
  EXPECT_NE(cells.KeyOf(higher), cells.KeyOf(high));
  EXPECT_EQ(cells.KeyOf(low), cells.KeyOf({{X, -0.0}, Side::kLeft}));
}

TEST(LevelPlanning, TheBoxSaysThatItKnowsOneHeightOnly) {
  Scene scene;
  scene.ground = BlockStairs(2, 0.1);
  const Planners all = Planners::Standard();
  for (const std::string& name : all.Names()) {
    EXPECT_EQ(all.Make(name, scene)->knows_levels(), name != "bounding_box") << name;
  }
}

// ---- volumes of the parts

StepSet FewRises() {
  StepSet set;
  set.prototype.duration = 1.6;
  set.on_levels = true;
  set.placements = {{{0.2, -0.2, 0.0}, 0.0}, {{0.25, -0.2, 0.0}, 0.1}, {{0.2, -0.22, 0.1}, -0.1}};
  return set;
}

const SweptVolumes& VolumesOnLevels() {
  static const SweptVolumes volumes = *BakeSweptVolumes(
      SweptRobot(), LipmOf(SweptRobot()), FewRises(), CoarseOptions(), {.threads = 1});
  return volumes;
}

// Whether all bodies keep the clearance at many instants, as the family `clearance` counts.
bool Keeps(const RobotModel& robot, const CollisionWorld& world, const HalfStep& half_step,
           const Foothold& X_WFoot, double clearance) {
  const HalfStepTracks tracks(half_step, LipmOf(robot));
  for (int n = 0; n <= 40; ++n) {
    const WalkState x = Transformed(X_WFoot, tracks.At(half_step.duration * n / 40).value);
    const Posture posture = SolvePosture(robot, x);
    if (!posture.reachable) return false;
    for (const RobotBody& body : robot.bodies) {
      CollisionWorld::Scratch scratch;
      const double above = body.link != 5 ? CollisionWorld::kAllSolids
                                          : x[FootIndex(static_cast<Side>(body.leg)) + 2] + 1e-8;
      if (!world.Clears(CollisionShape(body.shape), posture.OfBody(body), 0.0, clearance, &scratch,
                        0.0, above)) {
        return false;
      }
    }
  }
  return true;
}

TEST(VolumesOnLevels, WhatIsFreeKeepsTheClearanceFromSolids) {
  const RobotModel& robot = SweptRobot();
  const SweptVolumes& volumes = VolumesOnLevels();
  SweptDraw draw(31);
  int free = 0, taken = 0, near = 0;
  for (int k = 0; k < 60; ++k) {
    const int i = draw.Index(volumes.set.size());
    const Side support = draw.AnySide();
    const Foothold X_WS({0.0, 0.0, draw.Uniform(-0.4, 0.4)}, 0.3);
    const Foothold X_WF = X_WS * volumes.set.Placement(i, support);
    // A block under each foot, and one more that may be in the way.
    std::vector<GroundSolid> blocks;
    for (const Foothold& X : {X_WS, X_WF}) {
      GroundSolid block = Block("tread", -0.14, 0.14, -0.09, 0.09, X.height);
      block.polygon = (X.Planar().rotation() * block.polygon).colwise() + X.Planar().position();
      blocks.push_back(block);
    }
    const double x = draw.Uniform(-0.2, 0.4), y = draw.Uniform(-0.4, 0.4);
    blocks.push_back(Block("block", x, x + 0.06, y, y + 0.06, draw.Uniform(0.2, 0.8)));
    Scene scene;
    scene.ground = std::make_shared<const BlocksGround>(BlocksGround::kNoFloor, blocks);
    const SweptVolumeQuery query(volumes, SoleCorners({}, {0.22, 0.14}), scene);
    const CollisionWorld world(scene);
    const bool down = k % 2 == 0;
    const bool is_free =
        down ? query.DownIsFree(i, support, X_WS) : query.UpIsFree(i, support, X_WS);
    const bool keeps =
        Keeps(robot, world, down ? volumes.set.Down(i, support) : volumes.set.Up(i, support),
              down ? X_WS : X_WF, CoarseOptions().clearance);
    EXPECT_TRUE(keeps || !is_free) << k;
    free += is_free, taken += !keeps, near += keeps && !is_free;
  }
  EXPECT_GT(free, 8);
  EXPECT_GT(taken, 5);
  EXPECT_LT(near, 40);
}

// The landing tread bears the foot: a sole over its edge, or a tread of another height, does not.
TEST(VolumesOnLevels, AFootLandsWhereItsOutlineIsOnTheLevel) {
  const SweptVolumes& volumes = VolumesOnLevels();
  const Eigen::Matrix2Xd sole = SoleCorners({}, {0.22, 0.14});
  const auto lands = [&](double gap, double rise, double foothold) {
    Scene scene;
    scene.ground = std::make_shared<const BlocksGround>(
        0.0, std::vector{Block("tread", 0.14 - gap, 2.0, -1.0, 1.0, rise, 0.0)});
    const SweptVolumeQuery query(volumes, sole, scene, 0.0, std::numeric_limits<double>::infinity(),
                                 foothold);
    return query.Bears(Foothold({0.25, -0.2, 0.0}, 0.1));
  };
  EXPECT_TRUE(lands(0.0001, 0.1, 0.0));
  EXPECT_FALSE(lands(-0.001, 0.1, 0.0));
  EXPECT_FALSE(lands(0.0001, 0.101, 0.0));
  EXPECT_FALSE(lands(0.0001, 0.099, 0.0));
  EXPECT_FALSE(lands(0.0049, 0.1, 0.005));
  EXPECT_TRUE(lands(0.0052, 0.1, 0.005));
}

TEST(VolumesOnLevels, AreKeptInFilesOfTheirOwn) {
  RobotModel robot = SweptRobot();
  std::erase_if(robot.bodies, [](const RobotBody& b) { return b.leg < 0 || b.link < 4; });
  robot.self_pairs.clear();
  const SweptVolumeOptions options{.cell = 0.08, .displacement = 0.05};
  const TemporaryFolder folder;
  StepSet set = FewRises();
  set.placements.resize(2);
  const auto get = [&](const StepSet& of) {
    return LoadOrBakeSweptVolumes(robot, LipmOf(robot), of, options, folder.path().string(),
                                  {.threads = 1});
  };
  const CachedVolumes baked = get(set), read = get(set);
  ASSERT_TRUE(baked.baked && !read.baked) << read.refused;
  EXPECT_EQ(baked.path, read.path);
  const auto sizes = [](const SweptVolumes& volumes) {
    std::vector<double> all;  // [m³]
    ForEachVolume(volumes, true, [&](const SweptVolumes::Volumes& of) {
      for (const auto& tree : of) all.push_back(tree ? tree->Volume() : 0.0);
    });
    return all;
  };
  EXPECT_EQ(sizes(*baked.volumes), sizes(*read.volumes));
  for (const double size : sizes(*read.volumes)) EXPECT_GT(size, 1e-4);
  EXPECT_EQ(read.volumes->down_stand[0]->cell, 0.04);
  StepSet higher = set;
  higher.placements[1].height += 1e-3;
  EXPECT_NE(get(higher).path, baked.path);
  StepSet flat = set;
  flat.on_levels = false;
  flat.placements.resize(1);
  EXPECT_TRUE(get(flat).volumes->down_swing.empty());
}

}  // namespace
}  // namespace halfstep
