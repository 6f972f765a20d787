#pragma once

#include <pybind11/pybind11.h>

namespace halfstep::python {

/// Each declares one concept in the module.
void BindExceptions(pybind11::module_& module);
void BindConfig(pybind11::module_& module);
void BindPlace(pybind11::module_& module);
void BindWalk(pybind11::module_& module);
void BindExperiment(pybind11::module_& module);
void BindProgram(pybind11::module_& module);
void BindRun(pybind11::module_& module);
void BindExtension(pybind11::module_& module);

}  // namespace halfstep::python
