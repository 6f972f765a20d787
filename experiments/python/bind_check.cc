#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <variant>

#include "experiments/checker/check_place.h"
#include "experiments/checker/check_report.h"
#include "experiments/python/bindings.h"
#include "experiments/python/long_call.h"
#include "wpg/files/input_error.h"

namespace py = pybind11;

namespace halfstep::python {
namespace {

using checker::Interpolation;

// Knots × joints in Python.
Eigen::MatrixXd Rows(const py::handle& numbers) {
  if (numbers.is_none()) return {};
  return numbers.cast<Eigen::MatrixXd>().transpose();
}

checker::Trajectory FromArrays(const py::dict& arrays) {
  checker::Trajectory trajectory;
  trajectory.file = arrays["name"].cast<std::string>();
  trajectory.joints = arrays["joints"].cast<std::vector<std::string>>();
  trajectory.times = arrays["times"].cast<std::vector<double>>();
  trajectory.q = Rows(arrays["positions"]);
  trajectory.v = Rows(arrays["velocities"]);
  trajectory.a = Rows(arrays["accelerations"]);
  const Eigen::MatrixXd base = Rows(arrays["base"]);
  if (base.size() > 0) checker::SetBase(base, &trajectory);
  const Eigen::MatrixXd velocities = Rows(arrays["base_velocities"]);
  if (velocities.size() > 0) checker::SetBaseVelocities(velocities, &trajectory);
  return trajectory;
}

std::optional<Interpolation> InterpolationOf(const std::string& name) {
  for (const auto one : {Interpolation::kLinear, Interpolation::kCubic, Interpolation::kQuintic}) {
    if (name == checker::Name(one)) return one;
  }
  return std::nullopt;
}

checker::TrajectoryDemands DemandsOf(const py::dict& options) {
  checker::TrajectoryDemands demands;
  demands.self_clearance = options["self_clearance"].cast<double>();
  demands.clearance = options["clearance"].cast<double>();
  demands.acceleration = options["acceleration"].cast<std::optional<double>>();
  demands.ground = options["ground"].cast<std::optional<double>>();
  demands.contact_distance = options["contact_distance"].cast<double>();
  demands.contact_angle = options["contact_angle"].cast<double>();
  demands.zmp = options["zmp"].cast<std::optional<double>>();
  demands.friction = options["friction"].cast<std::optional<double>>();
  demands.ignored = options["ignore"].cast<std::vector<std::pair<std::string, std::string>>>();
  for (const auto& [link, from, to] :
       options["contacts"]
           .cast<std::vector<
               std::tuple<std::string, std::optional<double>, std::optional<double>>>>()) {
    demands.contacts.push_back({link, from, to});
  }
  return demands;
}

}  // namespace

void BindCheck(py::module_& module) {
  module.def("check", [](const std::variant<std::string, py::dict>& given, const std::string& robot,
                         const std::shared_ptr<Scene>& scene, const py::dict& options,
                         const py::object& progress) {
    const auto* const path = std::get_if<std::string>(&given);
    checker::Trajectory trajectory;
    if (path == nullptr) trajectory = FromArrays(std::get<py::dict>(given));
    const checker::TrajectoryDemands demands = DemandsOf(options);
    const auto interpolation = InterpolationOf(options["interpolation"].cast<std::string>());
    const auto packages = options["packages"].cast<std::map<std::string, std::string>>();
    std::string json;
    CallLong(progress, [&](const LongCallHooks& hooks) {
      checker::CheckPlace place = checker::ReadCheckPlace(robot, "", packages);
      if (scene) place.scene = *scene, place.has_scene = true;
      const checker::JointNames names = checker::NamesOf(place.robot.urdf());
      if (path != nullptr) {
        trajectory = checker::ReadTrajectory(*path, interpolation, names);
      } else {
        checker::CheckNumbers(trajectory, names);
        checker::SetInterpolation(interpolation, &trajectory);
      }
      const checker::TrajectoryCheck check =
          checker::CheckIn(place, trajectory, demands, [&hooks](double done) {
            hooks.progress("check", done);
            return !hooks.stop.stop_requested();
          });
      json = checker::CheckJson(trajectory, check);
    });
    return json;
  });
}

}  // namespace halfstep::python
