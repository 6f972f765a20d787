#pragma once

#include <string>
#include <vector>

#include "experiments/replay/player.h"

namespace halfstep {

/// The pushes of options `--push T,FX,FY,SECONDS`, in times of the walk [s], forces [N] in W on the
/// waist. Throws InputError for what is no push, and for one that begins before the one before it
/// ends.
std::vector<replay::Push> PushesOf(const std::vector<std::string>& texts);

}  // namespace halfstep
