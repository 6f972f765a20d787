// 10: a robot of one's own: its file is the first argument (`halfstep robot URDF` makes one).
#include <halfstep/experiments/halfstep.h>

#include <cstdio>
#include <iostream>

using namespace halfstep;

int main(int argc, char** argv) try {
  const std::string file = argc > 1 ? argv[1] : (RobotsFolder() / "wren.yaml").string();
  const RobotModel robot = LoadRobot(file);
  for (const std::string& warning : robot.warnings) std::printf("warning: %s\n", warning.c_str());
  std::printf("%s: %.1f kg, CoM %.3f m high, soles %.3f × %.3f m, %.3f m apart\n",
              robot.name.c_str(), robot.mass, robot.com_height, robot.sole_size.x(),
              robot.sole_size.y(), robot.standing_width);
  for (const Leg& leg : robot.legs) {
    for (const LegJoint& joint : leg.joints) {
      std::printf("  %-14s %6.2f … %5.2f rad, %5.2f rad/s\n", joint.name.c_str(), joint.lower,
                  joint.upper, joint.max_speed);
    }
  }
} catch (const InputError& error) {
  for (const std::string& complaint : error.complaints()) std::cerr << complaint << '\n';
  return 2;
}
