#include "experiments/config/footsteps_key.h"

#include <cstdint>
#include <filesystem>

#include "experiments/config/data_folder.h"
#include "experiments/config/experiment.h"
#include "experiments/config/footsteps_file.h"
#include "wpg/files/regular_file.h"
#include "wpg/files/text.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep {
namespace {

// The group as it is written.
struct FootstepsFileConfig {
  bool is_set = false;          // whether the config names a file
  std::string path;             // as written
  std::string poses = "world";  // what StepTargets are seen from: "world" or "support"
};

// Takes the footsteps of a file, and where the soles stand at the start if it says so and the
// config does not. Throws InputError.
void ReadFootstepsFile(const FootstepsFileConfig& file, const std::string& path,
                       ExperimentConfig* c) {
  const bool relative = file.poses == "support";
  std::optional<std::vector<Pose2>> start;
  if (c->has_start) {
    start = {c->start_left, c->start_right};
  } else if (relative) {
    const double y = 0.5 * MeasureRobot(RobotPath(*c).string()).standing_width;
    start = {Pose2{0.0, y, 0.0}, Pose2{0.0, -y, 0.0}};
  }
  const FiledFootsteps read = ReadFootsteps(path, relative, start);
  c->footsteps_file = RecordOf(path, TryReadRegularFile(path, std::uint64_t{1} << 30).bytes);
  c->footsteps_file->name = file.path;
  if (read.start && !c->has_start) {
    c->has_start = true;
    c->start_left = read.start->front();
    c->start_right = read.start->back();
    if (read.start_heights.size() == 2) {
      c->start_left_on.z = read.start_heights.front();
      c->start_right_on.z = read.start_heights.back();
    }
  }
  for (const FiledFootstep& step : read.steps) {
    c->footsteps.push_back({std::string(Name(step.foot)),
                            step.X_WF,
                            step.via_height,
                            step.duration,
                            {{}, step.z},
                            step.rest,
                            step.rest_on_one_foot,
                            step.crouch});
  }
}

}  // namespace

bool DeclareFootstepsFile(Fields& fields, ExperimentConfig* c) {
  FootstepsFileConfig file;
  const auto found = [&] {
    return (std::filesystem::path(fields.directory()) / file.path).lexically_normal();
  };
  bool is_there = false;
  fields.OptionalGroup(
      "footsteps_file", &file.is_set,
      {.meaning = "that `footsteps` are read from, in their place", .otherwise = "none"},
      [&](Fields& f) {
        f.Text("path", &file.path,
               {.meaning = "relative to the config: `.csv` as footsteps.csv of a run, or `.yaml`, "
                           "humanoid_nav_msgs/StepTarget[]",
                .required = true});
        std::error_code ignored;
        is_there = !file.path.empty() && std::filesystem::is_regular_file(found(), ignored);
        if (!file.path.empty() && !is_there) {
          f.Complain("path", "no such file: " + Quote(found().string()) + " (" +
                                 NearestFile(found()) + "valid: a path relative to this file)");
        }
        f.Text("poses", &file.poses,
               {.meaning = "what StepTargets are seen from: the world, or the sole that carries",
                .choices = {"world", "support"}});
      });
  if (!file.is_set || fields.Keys().empty()) return false;
  if (!c->footsteps.empty() || c->has_goal) {
    fields.Complain("footsteps_file", "there are `footsteps` or a `goal` as well (valid: one)");
  } else if (is_there) {
    ReadFootstepsFile(file, found().string(), c);
  }
  return true;
}

}  // namespace halfstep
