#include "experiments/python/python_controller.h"

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>

#include <memory>
#include <utility>

#include "experiments/python/long_call.h"

namespace py = pybind11;

namespace halfstep::python {
namespace {

using control::JointCommand;
using control::MeasuredState;
using control::PlannedState;

using BothLegs = Eigen::Matrix<double, 2, 6, Eigen::RowMajor>;

BothLegs RowsOf(const std::array<Vector6d, 2>& legs) {
  BothLegs rows;
  for (size_t s = 0; s < 2; ++s) rows.row(static_cast<Eigen::Index>(s)) = legs[s].transpose();
  return rows;
}

// Precondition: 2×6 numbers, which the package checks.
std::array<Vector6d, 2> LegsOf(const py::handle& rows) {
  const auto values = rows.cast<py::array_t<double, py::array::c_style | py::array::forcecast>>();
  const auto both = values.unchecked<2>();
  std::array<Vector6d, 2> legs;
  for (Eigen::Index j = 0; j < 6; ++j) {
    legs[0][j] = both(0, j);
    legs[1][j] = both(1, j);
  }
  return legs;
}

py::tuple TupleOf(const MeasuredState& state) {
  Eigen::Vector2d forces;
  Eigen::Matrix2d centres;
  for (Eigen::Index s = 0; s < 2; ++s) {
    const control::SoleLoad& load = state.loads[static_cast<size_t>(s)];
    forces[s] = load.force;
    centres.row(s) = load.centre.transpose();
  }
  return py::make_tuple(state.t, RowsOf(state.q), RowsOf(state.speeds), state.R_WB, state.turn_B,
                        forces, centres);
}

py::tuple TupleOf(const PlannedState& state) {
  return py::make_tuple(state.t, RowsOf(state.q), RowsOf(state.speeds), RowsOf(state.torques),
                        state.X_WB.matrix(), state.X_WSole[0].matrix(), state.X_WSole[1].matrix(),
                        py::make_tuple(bool{state.stands[0]}, bool{state.stands[1]}), state.com,
                        state.com_velocity, state.zmp, state.force, state.zmp_height, state.tilt,
                        py::make_tuple(double{state.levels[0]}, double{state.levels[1]}));
}

// Released with the GIL, wherever the last owner is.
std::shared_ptr<py::object> Held(py::object object) {
  return {new py::object(std::move(object)), [](py::object* held) {
            const py::gil_scoped_acquire acquired;
            delete held;
          }};
}

// What a call of Python gives; what it raises is kept and ends the simulation.
template <class Call>
auto Guarded(const Call& call) {
  const py::gil_scoped_acquire acquired;
  try {
    return call();
  } catch (const py::error_already_set& error) {
    KeepPythonError(error);
  }
  throw ControllerRaised();
}

class PythonController final : public control::TrackingController {
 public:
  PythonController(std::shared_ptr<py::object> make, std::shared_ptr<py::object> command)
      : make_(std::move(make)), command_(std::move(command)) {}

  JointCommand Command(const MeasuredState& measured, const PlannedState& then,
                       const PlannedState& next) override {
    return Guarded([&] {
      if (!command_) command_ = Held((*make_)());
      const py::tuple given = (*command_)(TupleOf(measured), TupleOf(then), TupleOf(next));
      return JointCommand{LegsOf(given[0]), LegsOf(given[1])};
    });
  }

  std::unique_ptr<TrackingController> Clone() const override {
    if (!command_) return std::make_unique<PythonController>(make_, nullptr);
    return Guarded([this] {
      const py::object copy = py::module_::import("copy").attr("deepcopy")(*command_);
      return std::make_unique<PythonController>(make_, Held(copy));
    });
  }

 private:
  std::shared_ptr<py::object> make_;
  std::shared_ptr<py::object> command_;  // none before the first command
};

}  // namespace

control::MakeController MakePythonControllers(const py::function& make) {
  return [held = Held(make)](const control::ControlledRobot&) {
    return std::make_unique<PythonController>(held, nullptr);
  };
}

}  // namespace halfstep::python
