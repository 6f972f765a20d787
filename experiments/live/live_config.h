#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/config/experiment_config.h"
#include "experiments/live/script_event.h"
#include "planner/scene/scene.h"
#include "wpg/files/fields.h"
#include "wpg/files/key_description.h"

namespace halfstep {

/// Where measurements come from, and what is assumed of them.
struct SensingConfig {
  std::string source = "stand_in";  ///< or client: what clients of the episode's server send
  double period = 0.2;              ///< between frames [s]
  double delay = 0.02;              ///< from a frame to when it is known [s]
  double noise = 0.005;  ///< positions are drawn from a ball of this radius around the true one [m]
  double error = 0.005;  ///< r: what is assumed of that radius [m]
  /// An obstacle that was measured at one place, up to the error, for so long is taken to rest, v =
  /// 0, until it is measured elsewhere [s]; none: it may move at any time.
  std::optional<double> rests_after;
  double lost = 0.0;  ///< the part of frames that never arrives
};

/// What thinking costs in lockstep [s].
struct BudgetConfig {
  double check = 0.005;  ///< looking at what is to come
  double plan = 0.04;    ///< planning anew, and proving the result
  double smooth = 0.04;  ///< the overlaps of a few junctions
  /// A unit of effort (Work::effort()), in place of the three, which then only say how long an
  /// answer is waited for; 0: they are charged.
  double effort = 0.0;
};

/// How an episode goes.
struct LiveOptions {
  /// "lockstep": computing takes the times of `budget`; "wall": the time that it takes.
  std::string clock = "lockstep";
  /// What is done when the world changes: "replan", "paper" or "stop_and_replan".
  std::string policy = "replan";
  double period = 0.005;   ///< of control [s]
  double horizon = 2.5;    ///< H: the uncertainty of a measurement grows no longer than this [s]
  double drift = 0.0;      ///< the robot strays from where it believes to be, at most at this [m/s]
  double longest = 120.0;  ///< an episode ends then [s]
  double ahead = 0.0;      ///< of a course, so much walk is planned [s]; 0: as Ahead() says
  int spare_boxes = 0;     ///< not there until they appear
  int smooth_at_once = 3;  ///< junctions
  double down_up_cap = 1.0;         ///< of overlaps between steps, share of their natural bounds
  int smooth_ahead = 8;             ///< junctions behind the latest half-step that has begun
  double tolerance = 0.02;          ///< of their overlaps [s]
  SensingConfig sensing;            ///< how the world is measured
  BudgetConfig budget;              ///< what computing costs in lockstep
  std::vector<ScriptEvent> script;  ///< what happens to the world, in the order of time
};

/// Names of the boxes of `live.spare_boxes`: "spare_1", … They are obstacles of an episode that no
/// scene file has, and are not there until something makes them appear.
std::vector<std::string> SpareNames(const LiveOptions& options);

/// An experiment of an episode without keys: its planner ends soon.
ExperimentConfig EpisodeDefaults();

/// An episode as its YAML file says it: an experiment with a goal, and `live:`.
struct LiveConfig {
  ExperimentConfig experiment =
      EpisodeDefaults();  ///< robot, scene, goal and all that the walk keeps
  LiveOptions live;       ///< how it goes on while the world changes
};

/// How much walk is planned where a course is commanded [s]: `live.ahead`, or what two footsteps
/// take without overlaps.
double Ahead(const LiveConfig& config);

/// A key of `live`, or of an event of its script, that does not fit the scene.
struct SceneMistake {
  std::string key;   ///< "obstacle"
  std::string what;  ///< "'crate' is not in the scene (valid: bar)"
};
/// Those of an event: it names an obstacle or an area that the scene, with its spare boxes, does
/// not have.
std::vector<SceneMistake> MistakesOf(const ScriptEvent& event, const Scene& scene);
/// Those of all else.
std::vector<SceneMistake> MistakesOf(const LiveOptions& options, const Scene& scene);

/// Declares every key once: those of an experiment, and `live`. With a scene, which has its spare
/// boxes, what does not fit it is complained about.
void DeclareFields(Fields& fields, LiveConfig* config, const Scene* scene = nullptr);

/// The keys that DeclareFields declares, as data; defaults that go by the robot as formulas.
std::vector<KeyDescription> EpisodeKeys(Toolbox tools = {});

/// Reads a config file strictly. Throws InputError with every complaint at once.
LiveConfig LoadLiveConfig(const std::string& path, const std::vector<YamlOverride>& overrides,
                          Toolbox tools = {});
/// The same for a config file's text; `scene` as in DeclareFields.
LiveConfig ParseLiveConfig(const std::string& path, const std::string& text,
                           const std::vector<YamlOverride>& overrides, const Scene* scene = nullptr,
                           Toolbox tools = {});

}  // namespace halfstep
