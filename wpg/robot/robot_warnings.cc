#include "wpg/robot/robot_warnings.h"

#include <map>
#include <string_view>

#include "wpg/files/input_error.h"
#include "wpg/files/text.h"

namespace halfstep {

std::vector<std::string> OffsetWarnings(const Leg& leg, const UrdfJoint& first,
                                        const std::string& urdf_file) {
  if (leg.closed_form()) return {};
  Complaints told;
  told.Add(urdf_file, first.place.line, first.place.column, first.name,
           leg.offsets +
               ": the closed form does not apply; joint angles are those of a leg whose "
               "axes meet, continued with proof to this one, which takes longer");
  return told.lines();
}

std::vector<std::string> HeldJointWarnings(const UrdfTree& urdf) {
  std::vector<std::string> warnings;
  std::map<std::string, size_t> told;  // fault → its warning
  for (const UrdfJoint& joint : urdf.joints) {
    for (const std::string& line : joint.faults) {
      std::string_view fault = std::string_view(line).substr(line.find(": ", urdf.file.size()));
      if (fault.substr(2).starts_with(joint.name)) fault.remove_prefix(2 + joint.name.size());
      const auto [known, first] = told.try_emplace(std::string(fault), warnings.size());
      if (first) warnings.push_back(line + "; it is held still");
      std::string& warning = warnings[known->second];
      if (!first) warning += (warning.ends_with("still") ? ", so are " : ", ") + joint.name;
    }
  }
  return warnings;
}

std::vector<std::string> SimplifiedWarnings(const UrdfTree& urdf,
                                            const std::vector<RobotBody>& bodies,
                                            int hull_vertices) {
  int count = 0;
  const RobotBody* largest = nullptr;
  for (const RobotBody& body : bodies) {
    if (body.mesh_vertices == 0) continue;
    ++count;
    if (largest == nullptr || body.excess > largest->excess) largest = &body;
  }
  if (count == 0) return {};
  return {urdf.file + ": " + std::to_string(count) + " of " + std::to_string(bodies.size()) +
          " bodies are meshes whose hull has more than " + std::to_string(hull_vertices) +
          " vertices; they get simpler hulls around these, at most " +
          Formatted("%.2g", 1e3 * largest->excess) + " mm larger (" + largest->name + ", " +
          std::to_string(largest->mesh_vertices) + " vertices; `hull_vertices` of the robot file)"};
}

}  // namespace halfstep
