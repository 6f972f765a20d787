#pragma once

#include "experiments/config/experiment_config.h"

namespace halfstep {

/// Declares the key `footsteps_file` of a config. Reading a config that has it reads the file,
/// whose footsteps become the config's own, as does where the soles stand at the start where the
/// file says it and the config does not; so a config that is written back has no such key. Must be
/// declared after `robot`, `start`, `goal` and `footsteps`. Returns whether a config that is read
/// has the key. Throws InputError for a file that is there and cannot be read.
bool DeclareFootstepsFile(Fields& fields, ExperimentConfig* config);

}  // namespace halfstep
