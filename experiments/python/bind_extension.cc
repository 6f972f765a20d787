#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>
#include <stdexcept>

#include "experiments/python/bindings.h"
#include "experiments/python/held_program.h"
#include "experiments/python/long_call.h"
#include "experiments/python/program_options.h"
#include "experiments/python/python_smoother.h"
#include "experiments/python/python_solver.h"
#include "smoothing/methods/solver_method_options.h"

namespace py = pybind11;

namespace halfstep::python {
namespace {

std::shared_ptr<HeldProgram> ProgramOf(const SmoothingTask& task, const py::dict& options) {
  HeldProgramOptions own{.program = task.options().Get(OptimizerGroup()).options.program};
  if (options.size() > 0) own = ToProgramOptions(options);
  return std::make_shared<HeldProgram>(task.setting(), own);
}

// Searches read the methods without the GIL.
void RequireNoSearch() {
  if (!LongCallUnderWay()) return;
  throw std::invalid_argument("a search is under way (valid: to register before it)");
}

NamedOptions ToNamedOptions(const py::list& given) {
  NamedOptions options;
  for (const py::handle& one : given) {
    NamedOption& option = options.emplace_back();
    const auto take = [&one](const char* key, auto* to) {
      *to = one[key].template cast<std::remove_pointer_t<decltype(to)>>();
    };
    take("name", &option.name);
    take("meaning", &option.meaning);
    take("unit", &option.unit);
    take("min", &option.min);
    take("max", &option.max);
    take("choices", &option.choices);
    take("default", &option.value);
  }
  return options;
}

void BindTasks(py::module_& module) {
  using Released = py::call_guard<py::gil_scoped_release>;
  py::class_<SmoothingTask, std::shared_ptr<SmoothingTask>>(module, "SmoothingTask")
      .def_property_readonly("running", &SmoothingTask::running)
      .def_property_readonly("stopped", &SmoothingTask::stopped)
      .def_property_readonly("remaining", &SmoothingTask::remaining)
      .def_property_readonly("duration", &SmoothingTask::duration)
      .def_property_readonly(
          "incumbent",
          [](const SmoothingTask& task) {
            return PlacedWalk{task.setting(),
                              SuperposedWalk(task.setting()->problem.sequence(), task.incumbent())};
          })
      .def_property_readonly("options",
                             [](const SmoothingTask& task) {
                               py::dict options;
                               for (const NamedOption& own : task.own()) {
                                 options[py::str(own.name)] = own.value;
                               }
                               return options;
                             })
      .def("program", &ProgramOf)
      .def(
          "propose",
          [](SmoothingTask& task, const PlacedWalk& walk) {
            return task.Propose(walk.walk.parameters());
          },
          Released())
      .def("walk",
           [](const SmoothingTask& task, const py::dict& given) {
             return WalkWith(task.setting(), task.incumbent(), given);
           })
      .def("tell", &SmoothingTask::Tell);
  py::class_<SolvingTask, std::shared_ptr<SolvingTask>>(module, "SolvingTask")
      .def_property_readonly("lower", [](const SolvingTask& t) { return t.problem().lower(); })
      .def_property_readonly("upper", [](const SolvingTask& t) { return t.problem().upper(); })
      .def_property_readonly("constraint_lower",
                             [](const SolvingTask& t) { return t.problem().constraint_lower(); })
      .def_property_readonly("constraint_upper",
                             [](const SolvingTask& t) { return t.problem().constraint_upper(); })
      .def_property_readonly("pattern",
                             [](const SolvingTask& t) {
                               const opt::SparsityPattern& pattern = t.problem().pattern();
                               return py::make_tuple(pattern.rows, pattern.cols);
                             })
      .def_property_readonly("stopped", &SolvingTask::stopped)
      .def_property_readonly("remaining", &SolvingTask::remaining)
      .def("cost", &SolvingTask::Cost, Released())
      .def("gradient", &SolvingTask::Gradient, Released())
      .def("constraints", &SolvingTask::Constraints, Released())
      .def("jacobian", [](const SolvingTask& task, const Eigen::VectorXd& x) {
        std::vector<double> nonzeros;
        {
          const py::gil_scoped_release released;
          nonzeros = task.Jacobian(x);
        }
        return py::array_t<double>(static_cast<py::ssize_t>(nonzeros.size()), nonzeros.data());
      });
}

}  // namespace

void BindExtension(py::module_& module, const ModuleTools& tools) {
  BindTasks(module);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const SolveStopped& stop) {
      const py::object type = py::module_::import("halfstep.errors").attr("SolveStopped");
      PyErr_SetString(type.ptr(), stop.what());
    }
  });
  module.def("register_smoother", [tools](const std::string& name, const std::string& meaning,
                                          const py::list& options, const py::function& function) {
    RequireNoSearch();
    tools->methods.Add(MakePythonSmoother(name, meaning, ToNamedOptions(options), function));
  });
  module.def("register_solver", [tools](const std::string& name, const py::function& function) {
    RequireNoSearch();
    const py::handle kept = function.inc_ref();  // for ever: solvers are never removed
    tools->methods.AddSolver(MakePythonSolver(name, kept));
  });
}

}  // namespace halfstep::python
