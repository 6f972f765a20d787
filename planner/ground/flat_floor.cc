#include "planner/ground/flat_floor.h"

#include "wpg/files/input_error.h"

namespace halfstep {

void RequireFlatFloor(const Ground& ground, const std::string& who) {
  const std::optional<GroundLevel> only = ground.OnlyLevel();
  if (only && only->height == 0.0) return;
  throw InputError({who + ": the scene's ground is uneven (" +
                    std::to_string(ground.Levels().size()) +
                    " levels), and this knows the flat floor only (valid: a scene without "
                    "`surfaces`)"});
}

}  // namespace halfstep
