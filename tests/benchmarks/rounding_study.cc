// How the bounds of smoothing/README.md, "Rounding", compare with the errors of a million draws of
// each elementary quantity: rounding_study [DRAWS]. Exit status 1 when one is exceeded.

#include <algorithm>
#include <cstdio>
#include <string>

#include "tests/oracle/rounding_draws.h"
#include "tests/places.h"
#include "tests/wpg/generated_robots.h"

namespace {

using halfstep::oracle::RoundingTally;

bool Print(const std::string& title, const RoundingTally& tally) {
  bool kept = true;
  for (const auto& [name, part] : tally.parts) {
    std::printf("%-14s %-20s %9ld %8ld   %9.3g\n", title.c_str(), name.c_str(), part.draws,
                part.undecided, part.largest > 0 ? 1 / part.largest : 0.0);
    kept = kept && !(part.largest > 1);
  }
  std::fflush(stdout);
  return kept;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace halfstep::oracle;
  const long draws = argc > 1 ? std::stol(argv[1]) : 1'000'000;
  const std::string robots = halfstep::InSources("wpg/robots/");
  std::printf("%-14s %-20s %9s %8s   %s\n", "of", "quantity", "draws", "unbounded", "bound/error");
  bool kept = true;
  RoundingTally tally;
  DrawNumbers(draws, 1, &tally);
  DrawForms(draws, 2, &tally);
  DrawSupports(draws, 3, &tally);
  DrawPolygons(draws, 8, &tally);
  DrawDistances(halfstep::LoadRobot(robots + "hrp2.yaml"), draws, 4, &tally);
  kept = Print("any", tally) && kept;
  // Of each instant there are at least three quantities of a kind, and twelve joints.
  tally = {};
  for (const char* robot : {"hrp2", "wren", "bison"}) {
    DrawWalks(robots + robot + ".yaml", draws / 9, 0, 5, &tally);
  }
  kept = Print("drawn walks", tally) && kept;
  tally = {};
  DrawWalks(robots + "hrp2.yaml", std::min(draws, 2000L), 2000, 6, &tally);
  kept = Print("4,000 half-steps", tally) && kept;
  for (const char* robot : {"hrp2", "wren", "bison"}) {
    for (const double scale : {1.0, 0.035, 2.7}) {
      tally = {};
      const halfstep::RobotModel of = halfstep::LoadRobot(robots + robot + ".yaml");
      DrawLegs(of, scale, draws / 90, 7, &tally);
      DrawDynamics(of, scale, draws / 90, 8, &tally);
      char title[40];
      std::snprintf(title, sizeof title, "%s × %g", robot, scale);
      kept = Print(title, tally) && kept;
    }
  }
  for (const halfstep::GeneratedRobot& generated : halfstep::OffsetRobots()) {
    const halfstep::RobotModel robot = halfstep::TemporaryRobot(generated).Load();
    for (const double scale : {1.0, 0.08, 6.0}) {
      tally = {};
      DrawLegs(robot, scale, draws / 900, 9, &tally);
      DrawNeighbourhoods(robot, scale, draws / 90, 10, &tally);
      kept = Print("offset × " + std::to_string(scale), tally) && kept;
    }
  }
  return kept ? 0 : 1;
}
