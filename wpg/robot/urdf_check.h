#pragma once

#include <map>
#include <string>
#include <vector>

#include "wpg/files/input_error.h"

namespace halfstep {

/// Where an XML element starts; both count from 1.
struct UrdfPlace {
  int line = 0;
  int column = 0;
};

/// Where the named elements of a URDF stand.
struct UrdfPlaces {
  std::map<std::string, UrdfPlace> links;
  std::map<std::string, UrdfPlace> joints;
  std::map<std::string, std::vector<UrdfPlace>> collisions;  ///< by link, in file order.
};

/// Complains about everything in a URDF text that urdfdom would accept, drop or repair in silence:
/// numbers that are missing or not finite, negative masses, limits that are missing, reversed or
/// without speed, zero axes, unknown or repeated names, several roots, cycles, more than 5000
/// links. `file` stands for the text in complaints.
UrdfPlaces CheckUrdf(const std::string& text, const std::string& file, Complaints* complaints);

}  // namespace halfstep
