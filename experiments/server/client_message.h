#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "experiments/live/live_config.h"
#include "planner/scene/scene.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// What a client of an episode says; keys: README.md.
struct Subscribe {
  double state_period = 0.0;  ///< [s]; 0: no states
  double motion = 0.0;        ///< how far ahead the motion is told [s]; 0: not at all
};
struct Draw {};
/// It is told the swept volumes of each walk from now on.
struct TellVolumes {};
/// A measurement of everything that is there.
struct MeasuredFrame {
  /// A measured obstacle.
  struct Seen {
    size_t obstacle = 0;     ///< index in the scene
    Eigen::Isometry3d X_WO;  ///< finite, a rotation and a translation
  };
  double age = 0.0;                          ///< how long ago it was measured [s]
  std::vector<Seen> seen;                    ///< in the scene's order, each at most once
  std::optional<Eigen::Vector2d> goal;       ///< none: as before [m]
  std::optional<std::vector<size_t>> areas;  ///< those that are there, from 0; none: as before
};
/// What a person does to the true world.
struct Carry {
  size_t obstacle = 0;  ///< index into the scene
  Eigen::Vector3d to;   ///< origin of its frame in W [m]
  double turn = 0.0;    ///< about the world's z meanwhile [rad]
};
/// The goal's place is moved.
struct MoveGoal {
  Eigen::Vector2d to;  ///< [m]
};
/// A spare box is put on the floor.
struct AddBox {
  Eigen::Vector3d at;  ///< [m]
  double turn = 0.0;   ///< about the world's z [rad]
};
/// An obstacle is taken away.
struct Remove {
  size_t obstacle = 0;  ///< index into the scene
};
/// Where to go on in place of the goal: an event of a script, but for its time.
struct Command {
  ScriptEvent event;  ///< walk, follow or footsteps
};
using Edit = std::variant<Carry, MoveGoal, AddBox, Remove, Command>;  ///< what a person does
/// No half-step is to begin for the time being.
struct Hold {
  bool held = true;  ///< false: release
};
struct End {};
/// The episode is to end, and to begin anew.
struct Again {};
/// The client controls the simulated robot from now on.
struct Controls {};
/// What it commands.
struct Commanded {
  long number = 0;                    ///< of the question, from 1
  std::array<Vector6d, 2> q, speeds;  ///< of the legs' joints, by Index(Side) [rad], [rad/s]
};
/// All that a client may say.
using ClientMessage = std::variant<Subscribe, Draw, TellVolumes, MeasuredFrame, Edit, Hold, End,
                                   Again, Controls, Commanded>;

/// What clients do beside looking on: what is there, they change or measure (the config's
/// live.sensing.source), or one of them controls a simulated robot, and nobody does either.
enum class ClientPart { kWorld, kControl };

/// Reads messages of clients, strictly. Immutable.
class ClientMessageReader {
 public:
  /// `scene`: with the spare boxes.
  ClientMessageReader(const Scene& scene, const LiveOptions& options,
                      ClientPart part = ClientPart::kWorld);

  /// Throws InputError with a sentence that says what is wrong. Nothing else is thrown for any
  /// text.
  ClientMessage Read(std::string_view text) const;

 private:
  Scene scene_;
  ClientPart part_;
  bool client_measures_;
  bool commands_;  // whether the policy takes courses
  double control_period_;
};

}  // namespace halfstep
