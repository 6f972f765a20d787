#include "planner/swept/swept_volume_cache.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/swept/swept_volume_bytes.h"
#include "wpg/files/checked_file.h"
#include "wpg/files/sha256.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

constexpr int kFormat = 1;     // of the file: change when the bytes change
constexpr int kGenerator = 5;  // change when the same input bakes another volume

std::string Exactly(double value) { return Formatted("%a", value); }

template <typename Matrix>
void Append(const Matrix& matrix, std::string* text) {
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) *text += Exactly(matrix(i, j)) + " ";
  }
  *text += "\n";
}

// Everything of a robot that moves its bodies' points.
std::string RobotText(const RobotModel& robot) {
  std::string text;
  for (const Leg& leg : robot.legs) {
    for (const LegJoint& joint : leg.joints) {
      Append(joint.axis_B, &text);
      Append(joint.point_B, &text);
      Append(joint.X_BLink.matrix(), &text);
    }
    Append(leg.hip_B, &text);
    Append(leg.ankle_B, &text);
    Append(leg.X_BSole.matrix(), &text);
    if (!leg.closed_form()) Append(leg.standing_q, &text);  // whence the sole is followed
    for (int sign : {leg.branch.knee, leg.branch.ankle, leg.branch.hip}) {
      text += std::to_string(sign) + " ";
    }
  }
  for (double value : {robot.waist_height, robot.com_height, robot.com_x_B}) {
    text += Exactly(value) + "\n";
  }
  for (const RobotBody& body : robot.bodies) {
    text += std::to_string(body.leg) + " " + std::to_string(body.link) + "\n";
    Append(body.shape.vertices, &text);
    Append(body.shape.normals, &text);
    text += Exactly(body.shape.disc_radius) + " " + Exactly(body.shape.ball_radius) + "\n";
  }
  return text;
}

// The elements that a bake kept one by one, once the whole file is there; also those that a bake
// left which was killed between the two.
void RemoveParts(const std::string& cache_path) {
  std::error_code ignored;
  std::filesystem::remove_all(cache_path + ".parts", ignored);
}

std::string PartHeader(const std::string& provenance, int element) {
  return provenance + "element " + std::to_string(element) + "\n";
}

}  // namespace

std::string DefaultCacheFolder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache == '/') {
    return std::string(cache) + "/halfstep";
  }
  const char* home = std::getenv("HOME");
  return home != nullptr && *home == '/' ? std::string(home) + "/.cache/halfstep" : "";
}

std::string SweptVolumeProvenance(const RobotModel& robot, const MotionModel& model,
                                  const StepSet& set, const SweptVolumeOptions& options) {
  std::string placements;
  for (const Foothold& X_SF : set.placements) {
    if (set.on_levels) {
      Append(Eigen::Vector4d(X_SF.x, X_SF.y, X_SF.height, X_SF.yaw), &placements);
    } else {
      X_SF.CheckLevel();
      Append(Eigen::Vector3d(X_SF.x, X_SF.y, X_SF.yaw), &placements);
    }
  }
  std::string text = "swept volumes, format " + std::to_string(kFormat) + "\n";
  const auto line = [&](std::string_view key, const std::string& value) {
    text += std::string(key) + " " + value + "\n";
  };
  line("generator", std::to_string(kGenerator));
  line("robot", Sha256(RobotText(robot)));
  for (const auto& [name, value] : model.numbers()) line(name, Exactly(value));
  line("duration", Exactly(set.prototype.duration));
  line("via_height", Exactly(set.prototype.via_height));
  line("via_lateral", Exactly(set.prototype.via_lateral));
  // All its numbers: one more does not compile before it is here.
  const auto& [shift, delay, bump_ramp, foot_ramp, lift_share, support, rise_begin, rise_end,
               crouch] = set.prototype.shape;
  line("shift", Exactly(shift));
  line("foot_delay", Exactly(delay));
  // Those that a shape has as always are left out, so that older files stay valid.
  const auto line_unless = [&](const char* key, double value, double always) {
    if (value != always) line(key, Exactly(value));
  };
  line_unless("bump_ramp", bump_ramp, 1.0);
  line_unless("foot_ramp", foot_ramp, 0.5);
  line_unless("lift_share", lift_share, 1.0);
  line_unless("support_point", support, 0.0);
  line_unless("rise_begin", rise_begin, 0.525);
  line_unless("rise_end", rise_end, 1.0);
  line_unless("crouch", crouch, 0.0);
  line_unless("via_along", set.prototype.via_along, 0.0);
  for (const auto& [lower, via_height] : set.forms) {
    line("form", Exactly(lower) + " " + Exactly(via_height));
  }
  if (!set.forms.empty()) {
    std::string changes;
    for (const auto& [from, to] : set.changes) {
      changes += std::to_string(from) + " " + std::to_string(to) + "\n";
    }
    line("changes", Sha256(changes));
  }
  if (set.on_levels) line("on_levels", "feet apart, with plates, in half the cell");
  line("elements", std::to_string(set.size()));
  line("placements", Sha256(placements));
  line("cell", Exactly(options.cell));
  line("displacement", Exactly(options.displacement));
  line("clearance", Exactly(options.clearance));
  line("shortest_interval", Exactly(options.shortest_interval));
  return text;
}

std::string PartPath(const std::string& cache_path, int element) {
  return cache_path + ".parts/" + std::to_string(element);
}

namespace {

// The volumes of an element that begin at `first`.
ElementVolumes Taken(std::optional<BoxTree>* first, const StepSet& set) {
  ElementVolumes element;
  ForEachVolume(element, set.on_levels,
                [&first](std::optional<BoxTree>& volume) { volume = std::move(*first++); });
  for (auto* foot :
       {&element.down_swing, &element.up_swing, &element.down_stand, &element.up_stand}) {
    if (*foot) (*foot)->cell = FootCell((*foot)->cell);
  }
  return element;
}

std::string BytesOf(const ElementVolumes& element, const StepSet& set) {
  std::string bytes;
  ForEachVolume(element, set.on_levels,
                [&bytes](const std::optional<BoxTree>& volume) { bytes += VolumeBytes(volume); });
  return bytes;
}

// What a whole file holds: `result->volumes`, or why it was refused.
void ReadVolumes(const std::string& provenance, const StepSet& set, double cell,
                 CachedVolumes* result) {
  const CheckedFile file = ReadCheckedFile(result->path, provenance);
  result->refused = file.refused;
  if (!file.body) return;
  const size_t each = VolumesOfElement(set);
  auto volumes = ParseVolumes(*file.body, each * set.placements.size(), cell);
  if (!volumes) {
    result->refused = result->path + ": refused: its volumes make no sense";
    return;
  }
  result->volumes = {.set = set, .down = {}, .up = {}};
  MakeRoom(&*result->volumes);
  for (int i = 0; i < set.size(); ++i) {
    PutElement(i, Taken(&(*volumes)[each * static_cast<size_t>(i)], set), &*result->volumes);
  }
}

}  // namespace

CachedVolumes LoadOrBakeSweptVolumes(const RobotModel& robot, const MotionModel& model,
                                     const StepSet& set, const SweptVolumeOptions& options,
                                     const std::string& folder, BakeHooks hooks) {
  const std::string provenance = SweptVolumeProvenance(robot, model, set, options);
  CachedVolumes result;
  if (folder.empty()) {
    result.volumes = BakeSweptVolumes(robot, model, set, options, hooks);
    result.baked = result.volumes.has_value();
    result.not_kept =
        "swept volumes are not kept: neither XDG_CACHE_HOME nor HOME is the path of a folder from "
        "/ (valid: one of them, or the config's swept_volumes.cache)";
    return result;
  }
  result.path = (std::filesystem::path(folder) /
                 (robot.name + "-" + Sha256(provenance).substr(0, 16) + ".swept"))
                    .string();
  ReadVolumes(provenance, set, options.cell, &result);
  if (result.volumes) {
    RemoveParts(result.path);
    return result;
  }
  std::mutex mutex;  // of not_kept
  const auto try_to_write = [&](const std::string& path, const std::string& header,
                                const std::string& body) {
    try {
      WriteCheckedFile(path, header, body);
      return true;
    } catch (const std::runtime_error& error) {
      const std::lock_guard lock(mutex);
      if (result.not_kept.empty()) result.not_kept = error.what();
      return false;
    }
  };
  hooks.recall = [&](int i) -> std::optional<ElementVolumes> {
    const CheckedFile part = ReadCheckedFile(PartPath(result.path, i), PartHeader(provenance, i));
    if (!part.body) return std::nullopt;
    auto volumes = ParseVolumes(*part.body, VolumesOfElement(set), options.cell);
    if (!volumes) return std::nullopt;
    return Taken(volumes->data(), set);
  };
  hooks.keep = [&](int i, const ElementVolumes& element) {
    try_to_write(PartPath(result.path, i), PartHeader(provenance, i), BytesOf(element, set));
  };
  result.volumes = BakeSweptVolumes(robot, model, set, options, hooks);
  if (!result.volumes) return result;
  result.baked = true;
  std::string body;
  for (size_t i = 0; i < result.volumes->down.size(); ++i) {
    ForEachVolume(*result.volumes, set.on_levels,
                  [&](const SweptVolumes::Volumes& all) { body += VolumeBytes(all[i]); });
  }
  // Another bake may have removed the parts' folder under us; only the whole file matters.
  result.not_kept.clear();
  if (try_to_write(result.path, provenance, body)) RemoveParts(result.path);
  return result;
}

}  // namespace halfstep
