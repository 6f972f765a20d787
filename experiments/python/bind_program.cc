#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <chrono>
#include <stdexcept>

#include "experiments/python/bindings.h"
#include "experiments/python/held_program.h"
#include "experiments/python/long_call.h"
#include "experiments/python/placed_experiment.h"
#include "experiments/python/program_options.h"
#include "smoothing/walk/parameter_complaint.h"

namespace py = pybind11;

namespace halfstep::python {
namespace {

std::vector<std::string> VariableNames(const HeldProgram& held) {
  std::vector<std::string> names;
  for (int i = 0; i < held.problem().num_variables(); ++i) {
    names.push_back(held.problem().VariableName(i));
  }
  return names;
}

// (indptr (m+1), columns) of the Jacobian by rows; its pattern comes row by row.
py::tuple Pattern(const HeldProgram& held) {
  const opt::SparsityPattern& pattern = held.problem().pattern();
  py::array_t<int> starts(held.problem().num_constraints() + 1);
  auto at = starts.mutable_unchecked<1>();
  size_t k = 0;
  for (int row = 0; row <= held.problem().num_constraints(); ++row) {
    while (k < pattern.rows.size() && pattern.rows[k] < row) ++k;
    at(row) = static_cast<int>(k);
  }
  return py::make_tuple(
      starts, py::array_t<int>(static_cast<py::ssize_t>(pattern.cols.size()), pattern.cols.data()));
}

// Half-step, from 1, and family of each row of slacks.
py::tuple WatchedRows(const HeldProgram& held) {
  const WatchedInstants& watched = held.program().watched();
  py::list half_steps, families;
  for (int row = 0; row < watched.rows(); ++row) {
    half_steps.append(watched.half_step_of(row) + 1);
    families.append(std::string(Name(watched.family_of(row))));
  }
  return py::make_tuple(half_steps, families);
}

// Seconds that `count` evaluations of the rows and their Jacobian take without Python.
double CppSeconds(const HeldProgram& held, const Eigen::VectorXd& x, int count) {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<double> nonzeros;
  for (int i = 0; i < count; ++i) held.problem().ConstraintsWithJacobian(x, &nonzeros);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// A function of the program that holds it for this thread.
template <typename Get>
auto Taking(Get get) {
  return [get](HeldProgram& held) {
    const auto use = held.Take();
    return get(held);
  };
}

// The same for one of the program and x, without the GIL. The result is a copy.
template <typename Evaluate>
auto Evaluating(Evaluate evaluate) {
  return [evaluate](HeldProgram& held, const Eigen::VectorXd& x) {
    const py::gil_scoped_release released;
    const auto use = held.Take();
    return evaluate(held, x);
  };
}

py::tuple RefineAt(HeldProgram& held, const Eigen::VectorXd& x) {
  const auto use = held.Take();
  Refinement result;
  CallLong(py::none(), [&](const LongCallHooks& hooks) { result = held.Refine(x, hooks.stop); });
  return py::make_tuple(result.proved, result.least_slack, result.sentence);
}

}  // namespace

HeldProgramOptions ToProgramOptions(const py::dict& options) {
  HeldProgramOptions result;
  ParameterChoice& choice = result.program.parameters;
  const auto take = [&options](const char* key, auto* value) {
    using Value = std::remove_pointer_t<decltype(value)>;
    if (options.contains(key)) *value = options[key].cast<Value>();
  };
  const std::string name = options["program"].cast<std::string>();
  bool known = false;
  for (ProgramKind kind : {ProgramKind::kFastest, ProgramKind::kSmooth, ProgramKind::kSafest}) {
    if (name != Name(kind)) continue;
    result.program.kind = kind;
    known = true;
  }
  if (!known) {
    throw std::invalid_argument("program: '" + name + "' (valid: fastest, smooth, safest)");
  }
  take("overlaps", &result.overlaps);
  for (const ParameterFamily family : AllParameterFamilies()) {
    const std::string_view key = Traits(family).key;
    if (bool* const flag = choice.flag(family); flag && !key.empty()) take(key.data(), flag);
  }
  take("instants", &result.program.watch.instants);
  take("sharpness", &result.program.watch.sharpness);
  take("row_per_instant", &result.program.watch.row_per_instant);
  take("duration_limit", &result.duration_limit);
  if (options.contains("weights")) {
    const auto w = options["weights"].cast<std::array<double, 3>>();
    result.program.weights = {w[0], w[1], w[2]};
  }
  return result;
}

void BindProgram(py::module_& module) {
  py::class_<HeldProgram, std::shared_ptr<HeldProgram>>(module, "Program")
      .def(py::init([](const PlacedExperiment& experiment, const py::dict& options) {
        return std::make_shared<HeldProgram>(experiment.Setting(), ToProgramOptions(options));
      }))
      .def_property_readonly("names", Taking(&VariableNames))
      .def_property_readonly("x0", Taking([](HeldProgram& h) { return h.problem().initial(); }))
      .def_property_readonly("lower", Taking([](HeldProgram& h) { return h.problem().lower(); }))
      .def_property_readonly("upper", Taking([](HeldProgram& h) { return h.problem().upper(); }))
      .def_property_readonly("constraint_lower",
                             Taking([](HeldProgram& h) { return h.problem().constraint_lower(); }))
      .def_property_readonly("constraint_upper",
                             Taking([](HeldProgram& h) { return h.problem().constraint_upper(); }))
      .def_property_readonly("pattern", Taking(&Pattern))
      .def_property_readonly("watched", Taking(&WatchedRows))
      .def_property("sharpness",
                    Taking([](HeldProgram& h) { return h.program().watched().sharpness(); }),
                    [](HeldProgram& h, double sharpness) {
                      const auto use = h.Take();
                      h.SetSharpness(sharpness);
                    })
      .def("cost", Evaluating([](HeldProgram& h, const Eigen::VectorXd& x) { return h.Cost(x); }))
      .def("gradient",
           Evaluating([](HeldProgram& h, const Eigen::VectorXd& x) { return h.Gradient(x); }))
      .def("constraints",
           Evaluating([](HeldProgram& h, const Eigen::VectorXd& x) { return h.Constraints(x); }))
      .def("jacobian", Evaluating([](HeldProgram& h, const Eigen::VectorXd& x) -> Eigen::VectorXd {
             const std::vector<double>& nonzeros = h.Jacobian(x);
             return Eigen::Map<const Eigen::VectorXd>(nonzeros.data(),
                                                      static_cast<Eigen::Index>(nonzeros.size()));
           }))
      .def("walk", Evaluating([](HeldProgram& h, const Eigen::VectorXd& x) {
             return PlacedWalk{h.setting(),
                               SuperposedWalk(h.setting()->problem.sequence(), h.ToParameters(x))};
           }))
      .def("to_x",
           [](HeldProgram& h, const PlacedWalk& walk) {
             const auto use = h.Take();
             const std::string complaint =
                 ComplaintAbout(h.setting()->problem.sequence(), walk.walk.parameters());
             if (!complaint.empty()) throw std::invalid_argument("walk: " + complaint);
             return h.program().ToVariables(walk.walk.parameters());
           })
      .def("refine", &RefineAt)
      .def("cpp_seconds", [](HeldProgram& h, const Eigen::VectorXd& x, int count) {
        const auto use = h.Take();
        return CppSeconds(h, x, count);
      });
}

}  // namespace halfstep::python
