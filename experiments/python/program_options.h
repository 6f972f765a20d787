#pragma once

#include <pybind11/pybind11.h>

#include "experiments/python/held_program.h"

namespace halfstep::python {

/// The options of OverlapProgram as Python gives them. Throws std::invalid_argument for an unknown
/// program.
HeldProgramOptions ToProgramOptions(const pybind11::dict& options);

}  // namespace halfstep::python
