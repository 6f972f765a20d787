#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "planner/ground/level_surface.h"
#include "wpg/files/fields.h"
#include "wpg/files/input_file.h"
#include "wpg/ground/ground.h"

namespace halfstep {

/// What a scene says of its ground (planner/README.md, "Levels").
struct GroundFields {
  bool has_floor = true;               ///< z = 0 bears where nothing stands on it
  std::size_t said = 0;                ///< items of `surfaces`
  std::vector<LevelSurface> surfaces;  ///< those of meshes are added to them
  std::vector<InputFile> files;        ///< of heightmaps
  std::vector<std::string> told;       ///< for the user, each with the surface's name in front

  /// z of the floor [m]; −∞: there is none.
  double Floor() const;
};

/// Takes a name for `item`: false, after a complaint at the key `name` of the group, where it is
/// taken already.
using TakeName = std::function<bool(Fields&, const std::string& name, const std::string& item)>;

/// Declares the keys `floor` and `surfaces` of a scene, and reads heightmaps relative to its
/// folder. What was complained of leaves no surface. `declare_name` declares the key `name` of a
/// surface.
void DeclareGround(
    Fields& fields,
    const std::function<void(Fields&, const std::string& item, std::string*)>& declare_name,
    const TakeName& take_name, GroundFields* ground);

/// The ground that was said: flat at z = 0 without surfaces. Precondition: nothing was complained
/// of.
std::shared_ptr<const Ground> MakeGround(const GroundFields& ground);

}  // namespace halfstep
