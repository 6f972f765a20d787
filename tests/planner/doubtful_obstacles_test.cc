// Obstacles in other units are told: by their size, their place and their speed, for any robot.

#include "planner/scene/doubtful_obstacles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace halfstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A box of an edge [m] at (x, 0, 0), as a mesh.
Obstacle Crate(double edge, double x) {
  TriangleMesh mesh = FacesOf(MakeBox({edge, edge, edge}));
  Obstacle crate{.name = "crate", .shape = std::move(mesh)};
  crate.X_WO.translation().x() = x;
  return crate;
}

Scene With(std::vector<Obstacle> obstacles) {
  Scene scene;
  scene.name = "room";
  scene.obstacles = std::move(obstacles);
  return scene;
}

// A walk over 3 m by a robot of 1.6 m; everything `times` as large.
std::vector<std::string> Told(const Scene& scene, double times = 1.0) {
  const Eigen::AlignedBox2d walk(times * Eigen::Vector2d(0, -0.1), times * Eigen::Vector2d(3, 0.1));
  return DoubtfulObstacles(scene, times * 1.6, walk);
}

TEST(DoubtfulObstacles, RoomsAndCablesAreNone) {
  for (const double times : {0.03, 1.0, 2.5}) {
    Scene scene = With({Crate(times * 0.5, times * 1), Crate(times * 40, times * 1),
                        Crate(times * 0.02, times * 1), Crate(times * 0.5, times * 60)});
    scene.obstacles[0].motion.waypoints = {
        {.t = 1.0, .translation = {times, times * std::sqrt(times), 0}, .yaw = 0}};
    EXPECT_THAT(Told(scene, times), IsEmpty()) << times;
  }
}

TEST(DoubtfulObstacles, AMeshInMillimetresIsTold) {
  EXPECT_THAT(Told(With({Crate(880, 1)})),
              ElementsAre("room: obstacle crate is 880 m long, 550 times as the robot is high: is "
                          "its file in other units (`mesh.scale`: 0.001 for millimetres)?"));
  EXPECT_THAT(Told(With({Crate(0.5, 140)})),
              ElementsAre(HasSubstr("crate is 136.7 m away from the walk, 85.5 times")));
  EXPECT_THAT(Told(With({Crate(0.0005, 1)})),
              ElementsAre(HasSubstr("is 0.0005 m small, 1/3.2e+03 of the robot's height")));
}

TEST(DoubtfulObstacles, OfManyTheWorstIsNamed) {
  Scene scene = With({Crate(900, 1), Crate(1000, 1), Crate(800, 1)});
  scene.obstacles[1].name = "shelf";
  EXPECT_THAT(Told(scene), ElementsAre(HasSubstr("obstacle shelf (and 2 others) is 1000 m long")));
}

TEST(DoubtfulObstacles, AnOriginFarFromAMeshThatTurnsIsTold) {
  Obstacle gate = Crate(1, 0);
  std::get<TriangleMesh>(gate.shape).vertices.row(0).array() += 60;
  gate.motion.waypoints = {{.t = 1.0, .translation = {0, 0, 0}, .yaw = 1.5}};
  EXPECT_THAT(Told(With({gate})),
              ElementsAre(HasSubstr("crate has points that move at up to 90.")));
}

TEST(DoubtfulObstacles, BoxesAskForMetres) {
  EXPECT_THAT(Told(With({{.name = "slab", .shape = Box{{880, 1, 1}}}})),
              ElementsAre(HasSubstr("slab is 880 m long, 550 times as the robot is high: are its "
                                    "numbers metres?")));
}

}  // namespace
}  // namespace halfstep
