#include "experiments/survey/robot_draft.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "wpg/elementary.h"
#include "wpg/files/text.h"
#include "wpg/geometry/side.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

constexpr double kDegrees = 180 / std::numbers::pi;

// A decimal number of at most so many places, without zeros at its end.
std::string Decimal(double value, int places) {
  std::string text = Formatted("%.*f", places, value);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string List(const Eigen::VectorXd& values, int places) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + Decimal(value, places);
  return "[" + text + "]";
}

std::string Times(const Eigen::Vector2d& size) {
  return Decimal(size.x(), 4) + " x " + Decimal(size.y(), 4);
}

// Roll, pitch and yaw about fixed axes [deg]. Where x becomes upright any yaw will do: roll is that
// of R turned back by the yaw that was taken.
Eigen::Vector3d RpyOf(const Eigen::Matrix3d& R) {
  const double yaw = Atan2(R(1, 0), R(0, 0)), pitch = Atan2(-R(2, 0), Hypot(R(1, 0), R(0, 0)));
  const auto [s, c] = SinCos(yaw);
  const double roll = Atan2(s * R(0, 2) - c * R(1, 2), c * R(1, 1) - s * R(0, 1));
  return kDegrees * Eigen::Vector3d(roll, pitch, yaw);
}

// Text as YAML takes it, whatever is in it.
std::string Quoted(const std::string& text) {
  std::string quoted;
  for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return "'" + quoted + "'";
}

// A joint's angle [deg] as it is written: of the nearest such numbers, one within its limits.
std::string WithinLimits(double angle, const std::array<double, 2>& limits) {
  constexpr int kPlaces = 4;
  constexpr double kUnit = 1e-4;
  std::string text = Decimal(angle, kPlaces);
  const double written = kUnit * std::round(angle / kUnit);
  if (written < limits[0]) text = Decimal(kUnit * std::ceil(limits[0] / kUnit), kPlaces);
  if (written > limits[1]) text = Decimal(kUnit * std::floor(limits[1] / kUnit), kPlaces);
  return text;
}

std::string LinkName(const RobotDraft& draft, int link) { return Nth(draft.urdf.links, link).name; }

std::string LegsText(const RobotDraft& draft) {
  const FoundSole& sole = draft.soles[0];
  const Eigen::Vector2d common = sole.size.cwiseMin(draft.soles[1].size);
  if (common.isZero()) return "# The soles were not looked for.\n";
  std::string text = "# The soles: " + sole.what + ", " + Decimal(1e3 * sole.depth, 1) +
                     " mm below the frame of the foot's link.\n";
  if (sole.tilt > 0.1 / kDegrees) {
    text += "# With all joints at zero it tilts by " + Decimal(sole.tilt * kDegrees, 1) + " deg.\n";
  }
  text += "legs:\n";
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Eigen::Isometry3d& X = Nth(draft.soles, side).X_FootSole;
    text += "  " + std::string(Name(side)) +
            ":\n    foot_link: " + Quoted(LinkName(draft, Nth(draft.legs.feet, side))) +
            "\n    sole_xyz: " + List(X.translation(), 7) + "\n";
    const Eigen::Vector3d rpy = RpyOf(X.linear());
    if (rpy.cwiseAbs().maxCoeff() > 1e-9) text += "    sole_rpy_deg: " + List(rpy, 9) + "\n";
  }
  // Inwards, so that what carries is there.
  const Eigen::Vector2d size = (1e4 * common).array().floor() / 1e4;
  if ((sole.size - draft.soles[1].size).cwiseAbs().maxCoeff() > 1e-4) {
    text += "# What both soles have: " + Times(sole.size) + " m and " + Times(draft.soles[1].size) +
            " m.\n";
  }
  return text + "sole_size_m: " + List(size, 4) + "\n";
}

std::string PostureText(const RobotDraft& draft) {
  const UrdfTree& urdf = draft.urdf;
  if (draft.standing.width == 0.0) return "# A posture was not looked for.\n";
  std::string text = "# Hip and ankle are " + Decimal(100 * draft.standing.bend, 0) +
                     " % of the stretched leg apart" +
                     (draft.why_bend.empty() ? "" : " (" + draft.why_bend + ")") +
                     "; the soles' centres are below the CoM, " + Decimal(draft.standing.width, 4) +
                     " m apart:\n# " + draft.why_width + ".\nstanding_posture_deg:\n";
  for (size_t i = 0; i < urdf.joints.size(); ++i) {
    if (urdf.joints[i].kind != UrdfJoint::Kind::kRevolute) continue;
    const std::string angle =
        WithinLimits(kDegrees * draft.posture[i],
                     {kDegrees * urdf.joints[i].lower, kDegrees * urdf.joints[i].upper});
    const auto why = draft.why_posture.find(static_cast<int>(i));
    if (angle == "0" && why == draft.why_posture.end()) continue;
    text += "  " + Quoted(urdf.joints[i].name) + ": " + angle +
            (why == draft.why_posture.end() ? "" : "  # " + why->second) + "\n";
  }
  return text;
}

std::string ExcludedText(const RobotDraft& draft) {
  if (draft.excluded.empty()) return "";
  std::string text =
      "# Neighbours whose convex hulls touch as they stand, or come that near in six steps.\n"
      "excluded_self_pairs:\n";
  for (const ExcludedPair& pair : draft.excluded) {
    text += "  - {links: [" + Quoted(pair.links[0]) + ", " + Quoted(pair.links[1]) +
            "], why: " + Quoted(pair.why) + "}\n";
  }
  return text;
}

}  // namespace

std::string YamlOf(const RobotDraft& draft) {
  const fs::path folder = draft.path.parent_path();
  std::string text =
      "# A guess by `halfstep robot`, to be looked at. Keys: wpg/README.md, \"Robots\".\n";
  text += "name: " + Quoted(draft.name) + "\n";
  text += "urdf: " + Quoted(fs::proximate(draft.urdf_path, folder).string()) + "\n";
  if (!draft.packages.empty()) {
    text += "packages:\n";
    for (const auto& [name, place] : draft.packages) {
      text += "  " + Quoted(name) + ": " + Quoted(fs::proximate(place, folder).string()) + "\n";
    }
  }
  if (draft.dae_up_axis) {
    text +=
        "# Turned by it, the meshes of the legs lie nearer to the legs' joints.\n"
        "dae_up_axis: applied\n";
  }
  if (draft.hull_vertices != RobotFile{}.hull_vertices) {
    text += "# With " + std::to_string(RobotFile{}.hull_vertices) + ", bodies are up to " +
            Decimal(1e3 * draft.excess, 1) + " mm larger than their meshes' hulls.\n" +
            "hull_vertices: " + std::to_string(draft.hull_vertices) + "\n";
  }
  if (!draft.mesh_parts.empty()) {
    text += "# Meshes that are filled too much by one convex hull.\nmesh_parts:\n";
    for (const auto& [link, parts] : draft.mesh_parts) {
      text += "  " + Quoted(link) + ": " + std::to_string(parts) + "  # " +
              draft.why_parts.at(link) + "\n";
    }
  }
  if (draft.legs.waist < 0) return text + "# Waist and legs were not found.\n";
  text +=
      "# Both legs hang on it.\nwaist_link: " + Quoted(LinkName(draft, draft.legs.waist)) + "\n";
  if (const Eigen::Vector3d rpy = RpyOf(draft.R_LinkB); rpy.cwiseAbs().maxCoeff() > 1e-9) {
    text +=
        "# z from the feet to the hips, y from the right hip to the left one.\nwaist_rpy_deg: " +
        List(rpy, 9) + "\n";
  }
  if (draft.lift) {
    text += "# " + draft.why_lift + "\nlift_m: " + Decimal(*draft.lift, 3) + "\n";
  }
  if (draft.support_point != 0.0) {
    text +=
        "# " + draft.why_support + "\nsupport_point_m: " + Decimal(draft.support_point, 3) + "\n";
  }
  for (const std::string& joint : draft.legs.beyond) {
    text += "# " + joint + " is beyond the sixth joint: it is held still.\n";
  }
  return text + LegsText(draft) + PostureText(draft) + ExcludedText(draft);
}

std::string RefusedYamlOf(const RobotDraft& draft, const std::vector<std::string>& complaints) {
  const std::string yaml = YamlOf(draft), file = draft.path.string() + ":";
  std::vector<std::string> at_end;
  std::map<int, std::string> at_line;  // from 1
  for (const std::string& complaint : complaints) {
    int line = 0;
    if (complaint.starts_with(file)) {
      std::from_chars(complaint.data() + file.size(), complaint.data() + complaint.size(), line);
    }
    const std::string mark = "# REFUSED: " + complaint;
    if (line > 0) {
      at_line[line] += "  " + mark;
    } else {
      at_end.push_back(mark);
    }
  }
  std::string text = "# REFUSED, as said below.";
  int line = 1;
  for (const char c : std::string_view(yaml).substr(1)) {
    if (c == '\n') text += at_line[line++];
    text += c;
  }
  for (const std::string& mark : at_end) text += mark + "\n";
  return text;
}

RobotModel ModelOf(const RobotDraft& draft, RobotParts parts) {
  const std::string path = draft.path.string(), text = YamlOf(draft);
  return BuildRobot(path, text, ReadRobotFile(path, text), parts);
}

}  // namespace halfstep
