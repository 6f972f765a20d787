#pragma once

#include <string>

#include "experiments/references/reference_maker.h"
#include "experiments/run/exit_status.h"

namespace halfstep {

/// What `halfstep draw references` was told.
struct ReferencesCommand {
  ReferenceRequest request;  ///< the robot as it was typed
  std::string out;           ///< folder
  int jobs = 1;              ///< threads
  bool quiet = false;        ///< prints nothing but errors
};

/// Makes a set of references, or goes on with one. kFailed where no draw of a reference was
/// certified; kInterrupted after Ctrl-C, what is done by then staying. Throws InputError, and
/// std::runtime_error when files cannot be written.
ExitStatus DrawReferences(const ReferencesCommand& command);

}  // namespace halfstep
