#include <mujoco/mujoco.h>

#include <cstring>
#include <stdexcept>

#include "experiments/replay/simulation.h"
#include "wpg/check.h"

namespace halfstep::replay {
namespace {

using Eigen::Vector3d;
constexpr int kRoot = 1;  // the body after the world

[[noreturn]] void Refuse(const char* message) {
  throw std::runtime_error(std::string("MuJoCo: ") + message);
}

// MuJoCo would end the process, or write a file into the working directory.
void CatchErrors() {
  mju_user_error = Refuse;
  mju_user_warning = [](const char*) {};
}

std::shared_ptr<const mjModel> Compile(const std::string& mjcf) {
  CatchErrors();
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "robot.xml", static_cast<int>(mjcf.size()));
  std::memcpy(files->filedata[0], mjcf.data(), mjcf.size());
  std::array<char, 1000> reason{};
  mjModel* model = mj_loadXML("robot.xml", files.get(), reason.data(), reason.size());
  mj_deleteVFS(files.get());
  if (model == nullptr) Refuse(reason.data());
  return {model, mj_deleteModel};
}

int Find(const mjModel& model, mjtObj kind, const std::string& name) {
  const int id = mj_name2id(&model, kind, name.c_str());
  HALFSTEP_CHECK(id >= 0, "no " << name << " in the model");
  return id;
}

Eigen::Isometry3d Pose(const mjtNum* position, const mjtNum* rows) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows);
  X.translation() = Eigen::Map<const Vector3d>(position);
  return X;
}

}  // namespace

struct Simulation::State {
  std::shared_ptr<const mjModel> model;
  std::unique_ptr<mjData, void (*)(mjData*)> data{nullptr, mj_deleteData};
  int waist = 0;                           // body
  std::array<int, 2> soles{};              // geoms
  std::array<std::array<int, 6>, 2> qpos;  // where the legs' angles stand
  double sole_half = 0.0;                  // of a sole's box, along z
  double stiffness = 0.0, damping = 0.0;   // of the servos

  Eigen::Isometry3d Body(int id) const { return Pose(data->xpos + 3 * id, data->xmat + 9 * id); }
};

std::string WhyNoSimulation() { return ""; }
std::string EngineVersion() { return mj_versionString(); }

Simulation::Simulation(const std::string& mjcf, const RobotModel& robot,
                       const std::string& waist_link)
    : state_(std::make_unique<State>()) {
  state_->model = Compile(mjcf);
  const mjModel& model = *state_->model;
  state_->data.reset(mj_makeData(&model));
  state_->waist = Find(model, mjOBJ_BODY, waist_link);
  for (size_t side = 0; side < 2; ++side) {
    const std::string name(Name(static_cast<Side>(side)));
    state_->soles[side] = Find(model, mjOBJ_GEOM, name + "_sole");
    for (size_t j = 0; j < 6; ++j) {
      const int joint = Find(model, mjOBJ_JOINT, robot.legs[side].joints[j].name);
      state_->qpos[side][j] = model.jnt_qposadr[joint];
    }
  }
  state_->sole_half = model.geom_size[3 * state_->soles[0] + 2];
  state_->stiffness = model.actuator_gainprm[0];
  state_->damping = -model.actuator_biasprm[2];
}

Simulation::~Simulation() = default;

Simulation::Simulation(const Simulation& other) : state_(std::make_unique<State>()) {
  const State& from = *other.state_;
  state_->model = from.model;
  state_->data.reset(mj_copyData(nullptr, from.model.get(), from.data.get()));
  state_->waist = from.waist;
  state_->soles = from.soles;
  state_->qpos = from.qpos;
  state_->sole_half = from.sole_half;
  state_->stiffness = from.stiffness;
  state_->damping = from.damping;
}

double Simulation::timestep() const { return state_->model->opt.timestep; }

double Simulation::weight() const {
  return mj_getTotalmass(state_->model.get()) * -state_->model->opt.gravity[2];
}

void Simulation::Place(const Eigen::Isometry3d& X_WB, const std::array<Vector6d, 2>& q) {
  mjData* data = state_->data.get();
  mj_resetData(state_->model.get(), data);
  for (size_t side = 0; side < 2; ++side) {
    for (size_t j = 0; j < 6; ++j) {
      data->qpos[state_->qpos[side][j]] = q[side][static_cast<Eigen::Index>(j)];
    }
  }
  mj_kinematics(state_->model.get(), data);
  // Nothing that moves lies between the root and the waist.
  const Eigen::Isometry3d X_WRoot =
      X_WB * state_->Body(state_->waist).inverse() * state_->Body(kRoot);
  const Eigen::Quaterniond turn(X_WRoot.linear());
  Eigen::Map<Vector3d>(data->qpos) = X_WRoot.translation();
  Eigen::Map<Eigen::Vector4d>(data->qpos + 3) << turn.w(), turn.x(), turn.y(), turn.z();
  mj_forward(state_->model.get(), data);
}

FloorForces Simulation::Step(const JointTargets& targets, const Eigen::Vector3d& push) {
  const mjModel* model = state_->model.get();
  mjData* data = state_->data.get();
  for (size_t side = 0; side < 2; ++side) {
    for (size_t j = 0; j < 6; ++j) {
      const auto k = static_cast<Eigen::Index>(j);
      // The servos damp q̇ itself; shifted so that they damp q̇ − target.
      data->ctrl[6 * side + j] =
          targets.q[side][k] + state_->damping / state_->stiffness * targets.speed[side][k];
    }
  }
  Eigen::Map<Vector3d>(data->xfrc_applied + 6 * state_->waist) = push;
  mj_step(model, data);
  for (const int warning : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC}) {
    if (data->warning[warning].number > 0) Refuse("the simulation became unstable");
  }
  FloorForces forces;
  for (int i = 0; i < data->ncon; ++i) {
    const mjContact& contact = data->contact[i];
    std::array<mjtNum, 6> local{};
    mj_contactForce(model, data, i, local.data());
    // Rows of the frame: the normal, from the floor to the sole, and two tangents.
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> frame(contact.frame);
    const Vector3d force = frame.transpose() * Eigen::Map<const Vector3d>(local.data());
    const Eigen::Map<const Vector3d> place(contact.pos);
    const size_t side = contact.geom2 == state_->soles[0] ? 0 : 1;
    forces.vertical[side] += force.z();
    forces.moment += force.z() * place.head<2>() - place.z() * force.head<2>();
  }
  return forces;
}

Eigen::Isometry3d Simulation::X_WB() const { return state_->Body(state_->waist); }

Eigen::Isometry3d Simulation::X_WSole(Side side) const {
  const int geom = state_->soles[static_cast<size_t>(Index(side))];
  const mjData& data = *state_->data;
  return Pose(data.geom_xpos + 3 * geom, data.geom_xmat + 9 * geom) *
         Eigen::Translation3d(0, 0, -state_->sole_half);
}

Eigen::Vector3d Simulation::com() const {
  return Eigen::Map<const Vector3d>(state_->data->subtree_com + 3 * kRoot);
}

}  // namespace halfstep::replay
