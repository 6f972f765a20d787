// 01: a walk is a pure function of time, made of footsteps.
#include <halfstep/experiments/halfstep.h>

#include <cstdio>

using namespace halfstep;

int main() {
  const RobotModel robot = LoadRobot((RobotsFolder() / "hrp2.yaml").string());
  const double y = robot.standing_width / 2;
  const std::array<Foothold, 2> start = {Foothold::Level({0, y, 0}), Foothold::Level({0, -y, 0})};
  const std::vector<Footstep> footsteps = {
      {.side = Side::kLeft, .X_WF = Foothold::Level({0.2, y, 0})},
      {.side = Side::kRight, .X_WF = Foothold::Level({0.4, -y, 0})},
      {.side = Side::kLeft, .X_WF = Foothold::Level({0.4, y, 0})}};
  const HalfStepSequence sequence =
      MakeSequence(start, footsteps, 0.24, {}, std::make_shared<Lipm>(robot.com_height));

  // Without overlaps: half-steps that begin and end at rest, one after the other.
  HomotopyParameters parameters = PlannedMotion(sequence);
  std::printf("isolated:  %.2f s\n", SuperposedWalk(sequence, parameters).duration());
  // Half-step 2 begins half a second before half-step 1 has ended, and so on.
  for (double& overlap : parameters.overlaps) overlap = 0.5;
  const SuperposedWalk walk(sequence, parameters);
  std::printf("overlapped: %.2f s\n\n t [s]  CoM x, y [m]    ZMP x, y [m]    left foot z [m]\n",
              walk.duration());
  for (double t = 0.0; t <= walk.duration(); t += 0.5) {
    const WalkState x = walk.At(t).value;
    std::printf("%6.2f %7.3f %7.3f %7.3f %7.3f %9.3f\n", t, x[kComX], x[kComY], x[kZmpX], x[kZmpY],
                x[kLeftZ]);
  }
}
