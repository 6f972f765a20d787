#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

namespace halfstep::replay {

/// Throws std::runtime_error with what MuJoCo says.
[[noreturn]] void RefuseMujoco(const char* message);

/// The model of an MJCF text that names no files. Errors of MuJoCo, here and later, become
/// exceptions (RefuseMujoco) in place of the process's end; a warning is refused, too, for then it
/// took something in another way. Its numbers know no locale.
std::shared_ptr<const mjModel> CompileMujoco(const std::string& mjcf);

}  // namespace halfstep::replay
