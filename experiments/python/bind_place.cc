#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <memory>

#include "experiments/python/bindings.h"
#include "experiments/python/walk_setting.h"
#include "planner/scene/scene.h"
#include "wpg/robot/not_covered.h"
#include "wpg/robot/robot_model.h"

namespace py = pybind11;

namespace halfstep::python {
namespace {

// Name, lower [rad], upper [rad], speed [rad/s], torque [N m], acceleration [rad/s²] of each leg
// joint, left leg first.
py::list JointRows(const RobotModel& robot) {
  py::list rows;
  for (const Leg& leg : robot.legs) {
    for (const LegJoint& joint : leg.joints) {
      rows.append(py::make_tuple(joint.name, joint.lower, joint.upper, joint.max_speed,
                                 joint.max_torque, joint.max_acceleration));
    }
  }
  return rows;
}

template <typename Item>
std::vector<std::string> NamesOf(const std::vector<Item>& items) {
  std::vector<std::string> names;
  for (const Item& item : items) names.push_back(item.name);
  return names;
}

}  // namespace

py::list ToPython(const std::vector<NotCovered>& list) {
  py::list rows;
  for (const NotCovered& one : list) {
    rows.append(py::make_tuple(std::string(Name(one.kind)), one.subject, one.sentence));
  }
  return rows;
}

void BindPlace(py::module_& module) {
  py::class_<RobotModel, std::shared_ptr<RobotModel>>(module, "Robot")
      .def(py::init([](const std::string& path) {
             return std::make_shared<RobotModel>(LoadRobot(path));
           }),
           py::call_guard<py::gil_scoped_release>())
      .def_readonly("name", &RobotModel::name)
      .def_readonly("mass", &RobotModel::mass)
      .def_readonly("com_height", &RobotModel::com_height)
      .def_readonly("waist_height", &RobotModel::waist_height)
      .def_readonly("standing_width", &RobotModel::standing_width)
      .def_property_readonly(
          "sole_size", [](const RobotModel& robot) { return Eigen::Vector2d(robot.sole_size); })
      .def_property_readonly("joints", &JointRows)
      .def_property_readonly("bodies",
                             [](const RobotModel& robot) { return NamesOf(robot.bodies); })
      .def_readonly("warnings", &RobotModel::warnings)
      .def_property_readonly("not_covered",
                             [](const RobotModel& robot) { return ToPython(NotCoveredOf(robot)); });
  py::class_<Scene, std::shared_ptr<Scene>>(module, "Scene")
      .def(py::init(
               [](const std::string& path) { return std::make_shared<Scene>(LoadScene(path)); }),
           py::call_guard<py::gil_scoped_release>())
      .def(py::init([](const std::string& path, const std::string& text) {
             return std::make_shared<Scene>(ParseScene(path, text));
           }),
           py::call_guard<py::gil_scoped_release>())
      .def_readonly("name", &Scene::name)
      .def_property_readonly("obstacles",
                             [](const Scene& scene) { return NamesOf(scene.obstacles); })
      .def_property_readonly("no_step_areas",
                             [](const Scene& scene) { return scene.no_step.size(); })
      .def_readonly("friction", &Scene::friction)
      .def("rests", &Scene::rests)
      .def_readonly("warnings", &Scene::warnings);
}

}  // namespace halfstep::python
