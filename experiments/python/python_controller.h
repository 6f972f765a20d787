#pragma once

#include <pybind11/pybind11.h>

#include <exception>

#include "experiments/control/controllers.h"

namespace halfstep::python {

/// Ends a simulation in which a controller of the user's raised; the exception itself is kept
/// (KeepPythonError). No std::runtime_error, which would be a simulation that became unstable.
class ControllerRaised : public std::exception {
 public:
  const char* what() const noexcept override { return "the controller raised"; }
};

/// Makes controllers of what `make` returns: a Python function of measured, then and next, each a
/// tuple of what the state has in its order, that returns joint angles and speeds. It is called
/// when the first command is due; a clone from then on is a deep copy. Needs the GIL.
control::MakeController MakePythonControllers(const pybind11::function& make);

}  // namespace halfstep::python
