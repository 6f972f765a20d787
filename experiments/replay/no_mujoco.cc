// Stands in for mujoco_simulation.cc where MuJoCo is absent or unwanted.
#include <stdexcept>

#include "experiments/replay/simulation.h"

namespace halfstep::replay {

struct Simulation::State {};

std::string WhyNoSimulation() { return HALFSTEP_WHY_NO_MUJOCO; }

std::string EngineVersion() { return ""; }

Simulation::Simulation(const std::string&, const RobotModel&, const std::string&,
                       const std::vector<SimulatedObstacle>&) {
  throw std::logic_error(WhyNoSimulation());
}
Simulation::~Simulation() = default;
Simulation::Simulation(const Simulation&) { throw std::logic_error(WhyNoSimulation()); }
double Simulation::timestep() const { throw std::logic_error(WhyNoSimulation()); }
double Simulation::weight() const { throw std::logic_error(WhyNoSimulation()); }
Eigen::Isometry3d Simulation::X_WFloor() const { throw std::logic_error(WhyNoSimulation()); }
Eigen::Vector2d Simulation::sole_size() const { throw std::logic_error(WhyNoSimulation()); }
void Simulation::Place(const Eigen::Isometry3d&, const std::array<Vector6d, 2>&) {
  throw std::logic_error(WhyNoSimulation());
}
int Simulation::num_keyframes() const { throw std::logic_error(WhyNoSimulation()); }
void Simulation::PlaceAtKeyframe(int) { throw std::logic_error(WhyNoSimulation()); }
FloorForces Simulation::Step(const JointTargets&, const Eigen::Vector3d&) {
  throw std::logic_error(WhyNoSimulation());
}
RobotForces Simulation::Needed(const RobotMotion&) { throw std::logic_error(WhyNoSimulation()); }
void Simulation::MoveObstacles(double) { throw std::logic_error(WhyNoSimulation()); }
std::vector<Touch> Simulation::touches() const { throw std::logic_error(WhyNoSimulation()); }
Eigen::Isometry3d Simulation::X_WB() const { throw std::logic_error(WhyNoSimulation()); }
Eigen::Isometry3d Simulation::X_WObstacle(int) const { throw std::logic_error(WhyNoSimulation()); }
Eigen::Isometry3d Simulation::X_WSole(Side) const { throw std::logic_error(WhyNoSimulation()); }
Eigen::Vector3d Simulation::com() const { throw std::logic_error(WhyNoSimulation()); }
control::MeasuredState Simulation::Measure() const { throw std::logic_error(WhyNoSimulation()); }

}  // namespace halfstep::replay
