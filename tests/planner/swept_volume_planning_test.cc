#include <gtest/gtest.h>

#include <random>

#include "planner/search/planners.h"
#include "tests/planner/swept_volume_draws.h"

namespace halfstep {
namespace {

Scene TwoBoxes() {
  Scene scene;
  for (const double y : {-1.1, 0.1}) {
    Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
    X_WO.translation() << 0.5, y, 0.2;
    scene.obstacles.push_back(
        {y < 0 ? "right" : "left", MakeBox(Eigen::Vector3d(0.3, 0.5, 0.4)), X_WO});
  }
  return scene;
}

PlanResult PlanBetween(const SweptVolumes& volumes, const Scene& scene, const char* planner,
                       std::uint64_t seed) {
  const SweptVolumeQuery query(volumes, SweptRobot().sole_outline, scene);
  PlanRequest request{
      .start = {Foothold::Level({0.0, 0.1, 0.0}), Foothold::Level({0.0, -0.1, 0.0})},
      .goal = {},
      .set = volumes.set,
      .query = query};
  request.goal.X_WG = {1.1, 0.0, 0.0};
  request.goal.radius = 0.2;
  request.stop = AnyOf({AfterNodes(2000), WhenNotImprovedFor(300)});
  std::mt19937_64 random(seed);
  return Planners::Standard().Make(planner, scene)->Plan(request, random);
}

void ExpectEqual(const PlanResult& a, const PlanResult& b) {
  EXPECT_EQ(a.elements, b.elements);
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.queries, b.queries);
  ASSERT_EQ(a.footsteps.size(), b.footsteps.size());
  for (size_t j = 0; j < a.footsteps.size(); ++j) {
    EXPECT_EQ(a.footsteps[j].side, b.footsteps[j].side);
    EXPECT_EQ(a.footsteps[j].X_WF.x, b.footsteps[j].X_WF.x);
    EXPECT_EQ(a.footsteps[j].X_WF.y, b.footsteps[j].X_WF.y);
    EXPECT_EQ(a.footsteps[j].X_WF.yaw, b.footsteps[j].X_WF.yaw);
  }
}

TEST(SweptVolumePlanning, TheSameSeedGivesTheSameFootstepsWhateverBakedTheVolumes) {
  const SweptVolumes two_threads = *BakeSweptVolumes(
      SweptRobot(), LipmOf(SweptRobot()), FewHalfSteps(), CoarseOptions(), {.threads = 2});
  const Scene scene = TwoBoxes();
  for (const char* planner : {"rrt", "astar"}) {
    const PlanResult first = PlanBetween(CoarseVolumes(), scene, planner, 3);
    ASSERT_EQ(first.status, PlanStatus::kSolved) << planner << ": " << first.sentence;
    ExpectEqual(first, PlanBetween(CoarseVolumes(), scene, planner, 3));
    ExpectEqual(first, PlanBetween(two_threads, scene, planner, 3));
    // Controls: the boxes matter, and so does the seed of a planner that draws.
    EXPECT_NE(PlanBetween(CoarseVolumes(), {}, planner, 3).queries, first.queries) << planner;
  }
  EXPECT_NE(PlanBetween(CoarseVolumes(), scene, "rrt", 3).queries,
            PlanBetween(CoarseVolumes(), scene, "rrt", 4).queries);
}

}  // namespace
}  // namespace halfstep
