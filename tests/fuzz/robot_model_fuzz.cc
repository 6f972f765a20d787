// A whole robot: its YAML file, a line "--- 8< ---", its URDF. Slow: legs are checked, hulls made.

#include "tests/fuzz/fuzz.h"
#include "wpg/robot/robot_fields.h"
#include "wpg/robot/robot_model.h"

using namespace halfstep;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const auto [yaml, xml] = fuzz::Halves(fuzz::Text(data, size));
  UrdfTree urdf;
  if (!fuzz::Reads("fuzz.", [&, &xml = xml] { urdf = ParseUrdf("fuzz.urdf", xml); })) return 0;
  RobotModel robot;
  const auto read = [&, &yaml = yaml] {
    robot = BuildRobot("fuzz.yaml", yaml, ReadRobotFile("fuzz.yaml", yaml, &urdf));
  };
  if (!fuzz::Reads("", read)) return 0;
  fuzz::Require(robot.mass > 0 && robot.com_height > 0 && robot.waist_height > 0, "no robot");
  for (const RobotBody& body : robot.bodies) {
    fuzz::Require(body.shape.vertices.cols() > 0 && body.shape.vertices.allFinite(), "no body");
  }
  for (const Leg& leg : robot.legs) {
    for (const auto& X : LegForwardKinematics(leg, leg.standing_q)) {
      fuzz::Require(X.matrix().allFinite(), "a leg is not finite");
    }
  }
  return 0;
}
