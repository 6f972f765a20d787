#pragma once

#include <random>
#include <string>

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// A walk that nobody tuned for: footsteps, duration and what lies about, drawn at random.
struct DrawnWalk {
  std::string kind;    ///< straight, arc, sideways, backwards, turning or wandering
  std::string config;  ///< YAML text of its config
  std::string scene;   ///< YAML text of its scene, which the config names `NAME_scene.yaml`
};

/// Draws 4 to 40 footsteps (few as often as many) of one of the kinds, a duration of half-steps of
/// 1.2 to 3 s of a robot of HRP-2's size, and 0 to 6 obstacles beside and between the footsteps,
/// all rounded to what is written. Lengths are scaled by the leg's, durations by the square root of
/// that. The planned motion is feasible, proved with the defaults of the config: footsteps and
/// obstacles that make it otherwise are drawn again. The same robot and random numbers give the
/// same bytes on one kind of machine. `robot_name`: as the config shall name it. Throws InputError
/// for a robot for which no draw of a thousand is feasible.
DrawnWalk DrawWalk(const std::string& name, const std::string& robot_name, const RobotModel& robot,
                   std::mt19937_64& random);

}  // namespace halfstep
