#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "smoothing/methods/methods.h"

namespace halfstep::python {

/// The methods that configs may name, with those that Python registered: the module's own.
using ModuleMethods = std::shared_ptr<Methods>;

/// Each declares one concept in the module.
void BindExceptions(pybind11::module_& module);
void BindConfig(pybind11::module_& module, const ModuleMethods& methods);
void BindPlace(pybind11::module_& module);
void BindWalk(pybind11::module_& module);
void BindExperiment(pybind11::module_& module, const ModuleMethods& methods);
void BindProgram(pybind11::module_& module);
void BindRun(pybind11::module_& module, const ModuleMethods& methods);
void BindExtension(pybind11::module_& module, const ModuleMethods& methods);

}  // namespace halfstep::python
