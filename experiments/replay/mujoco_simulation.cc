#include <mujoco/mujoco.h>

#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include "experiments/replay/mujoco_compile.h"
#include "experiments/replay/mujoco_model.h"
#include "experiments/replay/simulation.h"
#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep::replay {
namespace {

using Eigen::Vector3d;
constexpr int kRoot = 1;           // the body after the world
constexpr double kNowhere = -1e4;  // height of obstacles that are not there [m]

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
  // What copies share.
  struct Layout {
    std::shared_ptr<const mjModel> model;
    int floor = 0;                           // geom, −1: there is none
    int waist = 0;                           // body
    std::array<int, 2> soles{};              // geoms
    std::array<std::array<int, 6>, 2> qpos;  // where the legs' angles stand
    double sole_half = 0.0;                  // of a sole's box, along z
    double stiffness = 0.0, damping = 0.0;   // of the servos
    std::vector<SimulatedObstacle> obstacles;
    std::vector<int> robot_bodies;  // by geom: index of RobotModel::bodies, −1: none
    int num_robot_bodies = 0;
    std::vector<int> solids;  // by geom: index of the ground's solids, −1: none
  };
  std::shared_ptr<const Layout> layout;
  std::unique_ptr<mjData, void (*)(mjData*)> data{nullptr, mj_deleteData};

  const mjModel* model() const { return layout->model.get(); }
  Eigen::Isometry3d Body(int id) const { return Pose(data->xpos + 3 * id, data->xmat + 9 * id); }
  // The obstacle that a geom is of, solids of the ground after all obstacles; −1: none.
  int ObstacleOf(int geom) const {
    const int solid = Nth(layout->solids, geom);
    if (solid >= 0) return static_cast<int>(layout->obstacles.size()) + solid;
    return model()->body_mocapid[model()->geom_bodyid[geom]];
  }
  // Whether a geom is the floor, a plate on it or a solid: nothing else is fixed to the world.
  bool IsFloor(int geom) const { return model()->geom_bodyid[geom] == 0; }
  // The side of the sole that a geom is, −1: it is none.
  int SoleOf(int geom) const {
    return geom == layout->soles[0] ? 0 : geom == layout->soles[1] ? 1 : -1;
  }
  // The force of a contact's first geom on its second, in W.
  Vector3d ForceOf(int contact) const {
    std::array<mjtNum, 6> local{};
    mj_contactForce(model(), data.get(), contact, local.data());
    // Rows of the frame: the normal and two tangents.
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> frame(
        data->contact[contact].frame);
    return frame.transpose() * Eigen::Map<const Vector3d>(local.data());
  }
  // What the ground does to a sole at a contact.
  struct SoleContact {
    size_t side = 0;
    Vector3d force;     // on the sole, in W [N]
    bool upon = false;  // the sole is on the ground, not beside a solid of it
  };
  // None: it is another one.
  std::optional<SoleContact> SoleContactAt(int index) const {
    const mjContact& contact = data->contact[index];
    const bool swapped = IsFloor(contact.geom2);
    const int ground = swapped ? contact.geom2 : contact.geom1;
    const int sole = SoleOf(swapped ? contact.geom1 : contact.geom2);
    if (!IsFloor(ground) || sole < 0) return std::nullopt;
    constexpr double kSteep = 0.5;  // z of the normal beside a solid
    SoleContact found{static_cast<size_t>(sole), ForceOf(index)};
    if (swapped) found.force = -found.force;
    found.upon = Nth(layout->solids, ground) < 0 || std::abs(contact.frame[2]) > kSteep;
    return found;
  }
};

std::string WhyNoSimulation() { return ""; }
std::string EngineVersion() { return mj_versionString(); }

Simulation::Simulation(const std::string& mjcf, const RobotModel& robot,
                       const std::string& waist_link,
                       const std::vector<SimulatedObstacle>& obstacles)
    : state_(std::make_unique<State>()) {
  State::Layout layout;
  layout.model = CompileMujoco(mjcf);
  const mjModel& model = *layout.model;
  layout.floor = mj_name2id(&model, mjOBJ_GEOM, "floor");
  layout.waist = Find(model, mjOBJ_BODY, BodyName(waist_link));
  for (size_t side = 0; side < 2; ++side) {
    const std::string name(Name(static_cast<Side>(side)));
    layout.soles[side] = Find(model, mjOBJ_GEOM, name + "_sole");
    for (size_t j = 0; j < 6; ++j) {
      const int joint = Find(model, mjOBJ_JOINT, robot.legs[side].joints[j].name);
      layout.qpos[side][j] = model.jnt_qposadr[joint];
    }
  }
  layout.sole_half = model.geom_size[3 * layout.soles[0] + 2];
  layout.stiffness = model.actuator_gainprm[0];
  layout.damping = -model.actuator_biasprm[2];
  HALFSTEP_CHECK(model.nmocap == std::ssize(obstacles), "obstacles of a model");
  layout.obstacles = obstacles;
  layout.robot_bodies.assign(static_cast<size_t>(model.ngeom), -1);
  layout.solids.assign(static_cast<size_t>(model.ngeom), -1);
  const auto solid = [&model](int i) {
    return mj_name2id(&model, mjOBJ_GEOM, ("solid_" + std::to_string(i)).c_str());
  };
  const bool has_solids = solid(0) >= 0;
  for (int i = 0; solid(i) >= 0; ++i) Nth(layout.solids, solid(i)) = i;
  layout.num_robot_bodies = static_cast<int>(robot.bodies.size());
  for (int i = 0; i < layout.num_robot_bodies && (has_solids || !obstacles.empty()); ++i) {
    const std::string name = "body_" + std::to_string(i);
    Nth(layout.robot_bodies, Find(model, mjOBJ_GEOM, name)) = i;
    const int above = mj_name2id(&model, mjOBJ_GEOM, (name + "_above").c_str());
    if (above >= 0) Nth(layout.robot_bodies, above) = i;
  }
  state_->data.reset(mj_makeData(&model));
  state_->layout = std::make_shared<const State::Layout>(std::move(layout));
}

Simulation::~Simulation() = default;

Simulation::Simulation(const Simulation& other) : state_(std::make_unique<State>()) {
  state_->layout = other.state_->layout;
  state_->data.reset(mj_copyData(nullptr, state_->model(), other.state_->data.get()));
}

double Simulation::timestep() const { return state_->model()->opt.timestep; }

double Simulation::weight() const {
  return state_->model()->body_subtreemass[kRoot] * -state_->model()->opt.gravity[2];
}

Eigen::Isometry3d Simulation::X_WFloor() const {
  const mjModel& model = *state_->model();
  const int floor = state_->layout->floor;
  const int site = floor >= 0 ? -1 : Find(model, mjOBJ_SITE, "floor");
  const mjtNum *const p = floor >= 0 ? model.geom_pos + 3 * floor : model.site_pos + 3 * site,
                      *const q =
                          floor >= 0 ? model.geom_quat + 4 * floor : model.site_quat + 4 * site;
  const Eigen::Isometry3d X =
      Eigen::Translation3d(p[0], p[1], p[2]) * Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  const int start = mj_name2id(&model, mjOBJ_GEOM, "start");
  if (start < 0) return X;
  const Vector3d middle = X.inverse() * Eigen::Map<const Vector3d>(model.geom_pos + 3 * start);
  return X * Eigen::Translation3d(0.0, 0.0, middle.z() + model.geom_size[3 * start + 2]);
}

Eigen::Vector2d Simulation::sole_size() const {
  const mjtNum* const half = state_->model()->geom_size + 3 * state_->layout->soles[0];
  return {2 * half[0], 2 * half[1]};
}

void Simulation::Place(const Eigen::Isometry3d& X_WB, const std::array<Vector6d, 2>& q) {
  mjData* data = state_->data.get();
  mj_resetData(state_->model(), data);
  for (size_t side = 0; side < 2; ++side) {
    for (size_t j = 0; j < 6; ++j) {
      const double angle = q[side][static_cast<Eigen::Index>(j)];
      data->qpos[state_->layout->qpos[side][j]] = data->ctrl[6 * side + j] = angle;
    }
  }
  mj_kinematics(state_->model(), data);
  // Nothing that moves lies between the root and the waist.
  const Eigen::Isometry3d X_WRoot =
      X_WB * state_->Body(state_->layout->waist).inverse() * state_->Body(kRoot);
  const Eigen::Quaterniond turn(X_WRoot.linear());
  Eigen::Map<Vector3d>(data->qpos) = X_WRoot.translation();
  Eigen::Map<Eigen::Vector4d>(data->qpos + 3) << turn.w(), turn.x(), turn.y(), turn.z();
  MoveObstacles(0.0);
  mj_forward(state_->model(), data);
}

int Simulation::num_keyframes() const { return state_->model()->nkey; }

void Simulation::PlaceAtKeyframe(int index) {
  HALFSTEP_CHECK(index >= 0 && index < num_keyframes(), "keyframe " << index);
  mj_resetDataKeyframe(state_->model(), state_->data.get(), index);
  mj_forward(state_->model(), state_->data.get());
}

FloorForces Simulation::Step(const JointTargets& targets, const Eigen::Vector3d& push) {
  const State::Layout& layout = *state_->layout;
  const mjModel* model = layout.model.get();
  mjData* data = state_->data.get();
  for (size_t side = 0; side < 2; ++side) {
    for (size_t j = 0; j < 6; ++j) {
      const auto k = static_cast<Eigen::Index>(j);
      // The servos damp q̇ itself; shifted so that they damp q̇ − target.
      data->ctrl[6 * side + j] =
          targets.q[side][k] + layout.damping / layout.stiffness * targets.speed[side][k];
    }
  }
  Eigen::Map<Vector3d>(data->xfrc_applied + 6 * layout.waist) = push;
  mj_step(model, data);
  for (const int warning : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC}) {
    if (data->warning[warning].number > 0) RefuseMujoco("the simulation became unstable");
  }
  for (const int warning : {mjWARN_CONTACTFULL, mjWARN_CNSTRFULL}) {
    if (data->warning[warning].number > 0) RefuseMujoco("more contacts than it has room for");
  }
  FloorForces forces;
  for (int i = 0; i < data->ncon; ++i) {
    const auto contact = state_->SoleContactAt(i);
    if (!contact || !contact->upon) continue;
    const Vector3d& force = contact->force;
    const Eigen::Map<const Vector3d> place(data->contact[i].pos);
    forces.pressure += force.z() * place.head<2>();
    forces.vertical[contact->side] += force.z();
    forces.horizontal += force.head<2>();
    forces.moment += force.z() * place.head<2>() - place.z() * force.head<2>();
  }
  return forces;
}

RobotForces Simulation::Needed(const RobotMotion& motion) {
  constexpr double kHigh = 100.0;  // above the floor and all obstacles [m]
  const mjModel* model = state_->model();
  mjData* data = state_->data.get();
  Place(Eigen::Translation3d(0.0, 0.0, kHigh) * motion.X_WB, motion.q);
  const Eigen::Isometry3d X_WRoot = state_->Body(kRoot);
  const Vector3d arm = X_WRoot.translation() - X_WB().translation();
  const Eigen::Matrix3d R_RootW = X_WRoot.linear().transpose();
  // Of the free joint: the origin's motion in W, turning in the root's axes.
  Eigen::Map<Vector3d>(data->qvel) = motion.velocity + motion.turn.cross(arm);
  Eigen::Map<Vector3d>(data->qvel + 3) = R_RootW * motion.turn;
  Eigen::Map<Vector3d>(data->qacc) =
      motion.acceleration + motion.turn1.cross(arm) + motion.turn.cross(motion.turn.cross(arm));
  Eigen::Map<Vector3d>(data->qacc + 3) = R_RootW * motion.turn1;
  for (size_t side = 0; side < 2; ++side) {
    for (size_t j = 0; j < 6; ++j) {
      const int at = state_->layout->qpos[side][j] - 1;  // a free joint has 7 places, 6 speeds
      data->qvel[at] = motion.speeds[side][static_cast<Eigen::Index>(j)];
      data->qacc[at] = motion.accelerations[side][static_cast<Eigen::Index>(j)];
    }
  }
  mj_inverse(model, data);
  RobotForces needed;
  needed.force = Eigen::Map<const Vector3d>(data->qfrc_inverse);
  needed.moment = X_WRoot.linear() * Eigen::Map<const Vector3d>(data->qfrc_inverse + 3) +
                  arm.cross(needed.force);
  for (size_t side = 0; side < 2; ++side) {
    for (size_t j = 0; j < 6; ++j) {
      needed.torques[side][static_cast<Eigen::Index>(j)] =
          data->qfrc_inverse[state_->layout->qpos[side][j] - 1];
    }
  }
  return needed;
}

void Simulation::MoveObstacles(double t) {
  mjData* data = state_->data.get();
  const std::vector<SimulatedObstacle>& obstacles = state_->layout->obstacles;
  for (size_t i = 0; i < obstacles.size(); ++i) {
    const Eigen::Isometry3d X =
        obstacles[i].pose(t).value_or(Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, kNowhere)));
    const Eigen::Quaterniond turn(X.linear());
    Eigen::Map<Vector3d>(data->mocap_pos + 3 * i) = X.translation();
    Eigen::Map<Eigen::Vector4d>(data->mocap_quat + 4 * i) << turn.w(), turn.x(), turn.y(), turn.z();
  }
}

std::vector<Touch> Simulation::touches() const {
  std::map<std::pair<int, int>, Vector3d> forces;
  for (int i = 0; i < state_->data->ncon; ++i) {
    const mjContact& contact = state_->data->contact[i];
    const bool swapped = state_->ObstacleOf(contact.geom2) >= 0;
    const int obstacle = state_->ObstacleOf(swapped ? contact.geom2 : contact.geom1);
    if (obstacle < 0) continue;
    const int geom = swapped ? contact.geom1 : contact.geom2;
    const auto standing = state_->SoleContactAt(i);  // none where a sole meets an obstacle
    if (standing && standing->upon) continue;
    const int sole = state_->SoleOf(geom);
    const int body = sole >= 0 ? state_->layout->num_robot_bodies + sole
                               : Nth(state_->layout->robot_bodies, geom);
    const auto [at, is_new] = forces.try_emplace({body, obstacle}, Vector3d::Zero());
    at->second += swapped ? -state_->ForceOf(i) : state_->ForceOf(i);
  }
  std::vector<Touch> touches;
  for (const auto& [pair, force] : forces) {
    touches.push_back({pair.first, pair.second, force.norm()});
  }
  return touches;
}

Eigen::Isometry3d Simulation::X_WB() const { return state_->Body(state_->layout->waist); }

Eigen::Isometry3d Simulation::X_WObstacle(int index) const {
  const mjModel& model = *state_->model();
  for (int body = 0; body < model.nbody; ++body) {
    if (model.body_mocapid[body] == index) return state_->Body(body);
  }
  HALFSTEP_CHECK(false, "obstacle " << index);
  return {};
}

Eigen::Isometry3d Simulation::X_WSole(Side side) const {
  const int geom = Nth(state_->layout->soles, Index(side));
  const mjData& data = *state_->data;
  return Pose(data.geom_xpos + 3 * geom, data.geom_xmat + 9 * geom) *
         Eigen::Translation3d(0, 0, -state_->layout->sole_half);
}

Eigen::Vector3d Simulation::com() const {
  return Eigen::Map<const Vector3d>(state_->data->subtree_com + 3 * kRoot);
}

control::MeasuredState Simulation::Measure() const {
  const State::Layout& layout = *state_->layout;
  const mjModel* model = layout.model.get();
  const mjData* data = state_->data.get();
  control::MeasuredState measured;
  std::array<mjtNum, 6> turn{};
  mj_objectVelocity(model, data, mjOBJ_XBODY, layout.waist, turn.data(), /*flg_local=*/1);
  measured.R_WB = X_WB().linear();
  measured.turn_B = Eigen::Map<const Vector3d>(turn.data());
  for (size_t side = 0; side < 2; ++side) {
    for (size_t j = 0; j < 6; ++j) {
      const auto k = static_cast<Eigen::Index>(j);
      measured.q[side][k] = data->qpos[layout.qpos[side][j]];
      measured.speeds[side][k] = data->qvel[layout.qpos[side][j] - 1];  // as in Needed()
    }
    const Eigen::Isometry3d X_SoleW = X_WSole(static_cast<Side>(side)).inverse();
    control::SoleLoad& load = measured.loads[side];
    for (int i = 0; i < data->ncon; ++i) {
      const auto contact = state_->SoleContactAt(i);
      if (!contact || contact->side != side) continue;
      const Vector3d force = X_SoleW.linear() * contact->force;
      const Vector3d place = X_SoleW * Eigen::Map<const Vector3d>(data->contact[i].pos);
      load.force += force.z();
      load.centre += force.z() * place.head<2>() - place.z() * force.head<2>();
    }
    if (load.force > 0.0) load.centre /= load.force;
    if (!(load.force > 0.0)) load = {};
  }
  return measured;
}

}  // namespace halfstep::replay
