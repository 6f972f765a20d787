#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "wpg/files/input_error.h"

namespace halfstep {

/// Where an XML element starts; both count from 1.
struct UrdfPlace {
  int line = 0;    ///< of the text
  int column = 0;  ///< in bytes
};

/// What is found in a URDF text, and the text that is taken of it.
struct UrdfFindings {
  UrdfPlace robot;                                           ///< where `<robot>` stands
  std::map<std::string, UrdfPlace> links;                    ///< where the named elements stand
  std::map<std::string, UrdfPlace> joints;                   ///< the same of joints
  std::map<std::string, std::vector<UrdfPlace>> collisions;  ///< by link, in file order.
  std::map<std::string, double> masses;                      ///< of links that have one [kg]
  /// Mistakes of a joint that only a leg's joint must not have, by joint: of its axis and limits,
  /// or that it mimics another one. Outside the legs it is held still.
  std::map<std::string, std::vector<std::string>> joint_faults;
  std::set<std::string> continuous;           ///< joints that turn freely
  std::map<std::string, std::string> mimics;  ///< by moving joint, the one that it follows
  std::vector<std::string> warnings;  ///< what was repaired or left out, as complaints are written
  /// What is read of the file (PlainUrdf), with what was repaired, for urdfdom; "" when there are
  /// complaints.
  std::string text;
};

/// Complains about everything in a URDF text that urdfdom would accept, drop or repair in silence
/// and that a walk depends on: numbers that are missing or not finite, negative masses, unknown or
/// repeated names, a second element where one counts (CheckUrdfGrammar), several roots, cycles,
/// more than 5000 links, xacro that is not expanded. Repairs, with a warning, what concerns neither
/// legs nor the shape of bodies: negative moments of inertia (0), shapes without size (left out),
/// links that hang on nothing (left out), joints outside the legs that have no axis, limits or
/// speed (held still). What is only looked at,
/// `<visual>`, is not read. `file` stands for the text in complaints.
UrdfFindings CheckUrdf(const std::string& text, const std::string& file, Complaints* complaints);

}  // namespace halfstep
