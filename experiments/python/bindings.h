#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "experiments/config/experiment_config.h"
#include "experiments/config/toolbox.h"

namespace halfstep::python {

/// What configs may name, with those that Python registered: the module's own.
using ModuleTools = std::shared_ptr<Toolbox>;

/// The config as a dict with every key, whose paths are absolute.
pybind11::object ConfigToPython(ExperimentConfig config);

/// Each declares one concept in the module.
void BindExceptions(pybind11::module_& module);
void BindConfig(pybind11::module_& module, const ModuleTools& tools);
void BindPlace(pybind11::module_& module);
void BindWalk(pybind11::module_& module);
void BindExperiment(pybind11::module_& module, const ModuleTools& tools);
void BindProgram(pybind11::module_& module);
void BindRun(pybind11::module_& module, const ModuleTools& tools);
void BindReplay(pybind11::module_& module, const ModuleTools& tools);
void BindExtension(pybind11::module_& module, const ModuleTools& tools);
void BindCheck(pybind11::module_& module);

}  // namespace halfstep::python
