#include "experiments/verify/not_examined.h"

#include <algorithm>

namespace halfstep::verify {
namespace {

constexpr char kHow[] = "how it went, not what came of it";
constexpr char kBuild[] = "of the program and the machine that wrote it";
constexpr char kDescription[] = "describes what is there";
constexpr char kPicture[] = "a picture of what is there";
constexpr char kNeverBegan[] = "of steps that never began";
constexpr char kSimulated[] = "what a simulation did";
constexpr char kBelieved[] = "what was measured is believed";

constexpr NotExamined kOfRun[] = {
    {"*.schema.json", "*", kDescription},
    {"report.html", "*", kPicture},
    {"plan.json", "*", "how the footsteps were found"},
    {"swept_volumes.json", "*", kPicture},
    {"given/*", "*", "where the walk was taken from: half_steps.csv says what it is"},
    {"METHOD/iterates.csv", "*", "how it went; its rows are counted for summary.csv"},
    {"METHOD/pareto.csv", "*", "other walks than this one"},
    {"METHOD/replay.csv", "*", kSimulated},
    {"METHOD/replays.csv", "*", kSimulated},
    {"config.yaml", "goal", "footsteps.csv says where it led"},
    {"config.yaml", "planner", kHow},
    {"config.yaml", "step_set", kHow},
    {"config.yaml", "swept_volumes", kHow},
    {"config.yaml", "output.directory", "where it was written"},
    {"config.yaml", "replay", kSimulated},
    {"config.yaml", "smoothing.optimizer",
     "how a search went; but its program, and which forms it may move"},
    {"config.yaml", "smoothing.dichotomy", "how a search went; but its caps"},
    {"config.yaml", "smoothing.horizon", kHow},
    {"config.yaml", "smoothing.acceptance", kHow},
    {"config.yaml", "smoothing.sampling_s", kHow},
    {"config.yaml", "smoothing.threads", kHow},
    {"config.yaml", "smoothing.repair_plan", "footsteps.csv says what came of it"},
    {"config.yaml", "smoothing.given", "half_steps.csv says what the walk is"},
    {"config.yaml", "smoothing.margins", "that it demands less than the certificate, which counts"},
    {"config.yaml", "smoothing.limits", "that it allows more than the certificate, which counts"},
    {"config.yaml", "half_step.support_point_m",
     "where a search begins: half_steps.csv says what came of it"},
    {"manifest.json", "version", kBuild},
    {"manifest.json", "commit", kBuild},
    {"manifest.json", "build_type", kBuild},
    {"manifest.json", "compiler", kBuild},
    {"manifest.json", "written", kBuild},
    {"manifest.json", "host", kBuild},
    {"manifest.json", "libraries", kBuild},
    {"manifest.json", "wall_s", kHow},
    {"manifest.json", "acceptance",
     "how methods judged; but what it says of `smoothing.stop_branches`"},
    {"manifest.json", "scene_warnings", "words about the scene"},
    {"manifest.json", "physics", kSimulated},
    {"manifest.json", "methods.requested", kHow},
    {"manifest.json", "methods.message", kHow},
    {"manifest.json", "methods.judged_by", kHow},
    {"manifest.json", "methods.work", kHow},
    {"manifest.json", "methods.wall_s", kHow},
    {"manifest.json", "methods.processor_s", kHow},
    {"summary.csv", "cost", "of objectives other than `fastest`"},
    {"summary.csv", "worst_margin", "where its family has no column in trajectory.csv"},
    {"summary.csv", "worst_margin_name", "beyond that no family with a column is nearer its limit"},
    {"summary.csv", "instants", kHow},
    {"summary.csv", "effort", kHow},
    {"summary.csv", "collision_queries", kHow},
    {"summary.csv", "wall_s", kHow},
    {"summary.csv", "time_to_first_improvement_s", kHow},
    {"summary.csv", "stands", kSimulated},
    {"summary.csv", "replay_tilt_rad", kSimulated},
    {"summary.csv", "gap_lipm", "the bound itself, but that there is one for all methods"},
    {"config.yaml", "smoothing.resolution_s", kHow},
    {"METHOD/certificate.json", "resolution_s", "how fine its proof was"},
    {"METHOD/certificate.json", "robot", "a place to look for it: its hash says which it is"},
    {"METHOD/certificate.json", "scene", "a place to look for it: its hash says which it is"},
    {"METHOD/certificate.csv", "subject",
     "that it is the tightest of the row's statements; its margin is computed again"},
    {"METHOD/certificate.csv", "margin", "of distances, that it is not less than need be"},
    {"METHOD/certificate.csv", "bound",
     "that it is not more than need be; it is tried at five instants, distances at three"},
    {"METHOD/overlaps.csv", "limited_by", kHow},
    {"METHOD/overlaps.csv", "limited_by_family", kHow},
    {"METHOD/overlaps.csv", "limited_by_scale", kHow},
    {"METHOD/overlaps.csv", "price_s", kHow},
    {"METHOD/overlaps.csv", "multiplier_s", kHow},
};

constexpr NotExamined kOfEpisode[] = {
    {"*.schema.json", "*", kDescription},
    {"report.html", "*", kPicture},
    {"timings.csv", "*", kHow},
    {"physics.csv", "*", kSimulated},
    {"config.yaml", "planner", kHow},
    {"config.yaml", "step_set", kHow},
    {"config.yaml", "swept_volumes", kHow},
    {"config.yaml", "output.directory", "where it was written"},
    {"config.yaml", "smoothing", "how searches went; but margins and limits"},
    {"config.yaml", "live", "how it went; but what error, speed and horizon follow from"},
    {"manifest.json", "version", kBuild},
    {"manifest.json", "commit", kBuild},
    {"manifest.json", "build_type", kBuild},
    {"manifest.json", "message", kHow},
    {"manifest.json", "waited_s",
     "how long the robot waited before time 0; but that no stand-in measured before that"},
    {"manifest.json", "end_s",
     "to within the time between two frames of a stand-in; of `killed` not at all"},
    {"manifest.json", "ending", "which of those that are not `arrived`"},
    {"manifest.json", "scene_warnings", "words about the scene"},
    {"manifest.json", "physics", kSimulated},
    {"manifest.json", "promise.touched.body", "but that the robot touches it, and from when on"},
    {"manifest.json", "promise.touched.depth_m", "the same"},
    {"manifest.json", "promise.touched.deepest_s", "the same"},
    {"events.csv", "t_s", "of other events than `begins`, but that it is not after the end"},
    {"events.csv", "event",
     "but `begins`, `near`, how many are `contradicted` by a world, `commanded` by a script, and "
     "`stopped` where a walk was not followed"},
    {"events.csv", "world", kHow},
    {"events.csv", "walk", "but of `stopped` where a walk was not followed"},
    {"events.csv", "half_step", "but of `begins`, `near`, `stopped`"},
    {"events.csv", "text", kHow},
    {"worlds.csv", "known_s", "but its order, and that no grant is older"},
    {"worlds.csv", "measured_s", kBelieved},
    {"worlds.csv", "goal_x_m", "where the goal was said to be; of the last world it counts"},
    {"worlds.csv", "goal_y_m", "where the goal was said to be; of the last world it counts"},
    {"worlds.csv", "areas", kBelieved},
    {"obstacles.csv", "x_m", kBelieved},
    {"obstacles.csv", "y_m", kBelieved},
    {"obstacles.csv", "z_m", kBelieved},
    {"obstacles.csv", "qw", kBelieved},
    {"obstacles.csv", "qx", kBelieved},
    {"obstacles.csv", "qy", kBelieved},
    {"obstacles.csv", "qz", kBelieved},
    {"begun.csv", "grant", "which of those that allow the half-step"},
    {"plans.csv", "handed_over_s",
     "where between two beginnings; but its order, and what had begun"},
    {"walks/NNN/footsteps.csv", "x_m", kNeverBegan},
    {"walks/NNN/footsteps.csv", "y_m", kNeverBegan},
    {"walks/NNN/footsteps.csv", "yaw_rad", kNeverBegan},
    {"walks/NNN/footsteps.csv", "via_height_m", kNeverBegan},
    {"walks/NNN/footsteps.csv", "duration_s", "as planned; half_steps.csv says what it is"},
    {"walks/NNN/half_steps.csv", "rows of half-steps that never began",
     "but that they make a walk"},
    {"plans.csv", "kind", "but of `commanded`, that the script has these footsteps"},
    {"plans.csv", "asked_s", kHow},
    {"plans.csv", "measured_s", kHow},
    {"plans.csv", "first_changed", kHow},
    {"plans.csv", "reason", kHow},
    {"grants.csv", "t_s", "of grants by which nothing began, but their order"},
    {"grants.csv", "world", "of grants by which nothing began, but that it was known"},
    {"grants.csv", "proved_from_s", "but that it is no later than what began by it"},
    {"grants.csv", "through", "but that it reaches what began by it"},
    {"trajectory.csv", "zmp_margin_m", "of an episode; the proof of its half-steps counts"},
    {"trajectory.csv", "joint_margin_rad", "the same"},
    {"trajectory.csv", "joint_speed_margin_rad_s", "the same"},
    {"trajectory.csv", "foot_speed_margin_m_s", "the same"},
    {"trajectory.csv", "clearance_m", "the same"},
    {"trajectory.csv", "self_clearance_m", "the same"},
    {"trajectory.csv", "zmp_robot_margin_m", "the same"},
    {"trajectory.csv", "torque_margin_n_m", "the same"},
    {"trajectory.csv", "friction_margin", "the same"},
    {"trajectory.csv", "joint_acceleration_margin_rad_s2", "the same"},
};

// Whether a file of a folder is one that an entry is about.
bool IsOf(std::string_view entry, std::string_view file) {
  if (entry.starts_with('*')) return file.ends_with(entry.substr(1));
  if (entry.ends_with('*')) return file.starts_with(entry.substr(0, entry.size() - 1));
  constexpr std::string_view kNumber = "NNN";
  if (const size_t at = entry.find(kNumber); at != std::string_view::npos) {
    return file.size() == entry.size() && file.starts_with(entry.substr(0, at)) &&
           file.ends_with(entry.substr(at + kNumber.size()));
  }
  constexpr std::string_view kMethod = "METHOD";
  if (!entry.starts_with(kMethod)) return entry == file;
  const size_t slash = file.find('/');
  return slash != std::string_view::npos && file.substr(slash) == entry.substr(kMethod.size());
}

// Whether a key is the entry's, or one within it.
bool IsWithin(std::string_view entry, std::string_view name) {
  return entry == "*" || entry == name ||
         (name.starts_with(entry) && name.substr(entry.size()).starts_with('.'));
}

}  // namespace

std::span<const NotExamined> NotExaminedOfRun() { return kOfRun; }
std::span<const NotExamined> NotExaminedOfEpisode() { return kOfEpisode; }

const NotExamined* FindNotExamined(std::span<const NotExamined> list, std::string_view file,
                                   std::string_view name) {
  const auto found = std::ranges::find_if(list, [&](const NotExamined& one) {
    return IsOf(one.file, file) && IsWithin(one.name, name);
  });
  return found == list.end() ? nullptr : &*found;
}

std::string NotExaminedText(std::span<const NotExamined> list) {
  std::string text;
  for (const NotExamined& one : list) {
    text += std::string(one.file) + ": " +
            (one.name == "*" ? "beyond its hash" : std::string(one.name)) + ": " +
            std::string(one.why) + "\n";
  }
  return text;
}

}  // namespace halfstep::verify
