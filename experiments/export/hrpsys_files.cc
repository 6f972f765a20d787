#include "experiments/export/hrpsys_files.h"

#include <fnmatch.h>

#include <algorithm>

#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

void AppendLine(double t, const Eigen::Ref<const Eigen::VectorXd>& numbers, std::string* text) {
  *text += ShortestText(t);
  for (const double number : numbers) *text += " " + ShortestText(number);
  *text += '\n';
}

}  // namespace

HrpsysFiles WriteHrpsys(const RobotModel& robot, const RobotTree& tree,
                        const std::vector<int>& joints, const std::vector<TrajectoryRow>& rows,
                        size_t stride, double period) {
  HrpsysFiles files;
  for (const int joint : joints) {
    files.joints += Nth(tree.urdf.joints, joint).name + "\n";
  }
  const size_t last = rows.size() - 1;
  for (size_t line = 0;; ++line) {
    const TrajectoryRow& row = rows[std::min(line * stride, last)];
    const double t = static_cast<double>(line) * period;
    const std::vector<double> angles = JointAngles(robot, tree, row.q);
    Eigen::VectorXd q(static_cast<Eigen::Index>(joints.size()));
    for (size_t j = 0; j < joints.size(); ++j) {
      q[static_cast<Eigen::Index>(j)] = Nth(angles, joints[j]);
    }
    Eigen::Matrix<double, 6, 1> waist;
    waist << row.waist.head<3>(), 0.0, 0.0, row.waist[3];
    const Eigen::Vector3d p_WZ(row.zmp.x(), row.zmp.y(), row.zmp_z);
    AppendLine(t, q, &files.pos);
    AppendLine(t, row.X_WB().inverse() * p_WZ, &files.zmp);
    AppendLine(t, waist, &files.waist);
    if (line * stride >= last) return files;
  }
}

std::vector<int> OrderedJoints(const RobotTree& tree, const std::vector<std::string>& patterns) {
  const std::vector<int> all = JointsInFileOrder(tree.urdf);
  if (patterns.empty()) return all;
  const auto name = [&](int joint) { return Nth(tree.urdf.joints, joint).name; };
  Complaints complaints;
  std::vector<int> ordered;
  for (const std::string& pattern : patterns) {
    const size_t before = ordered.size();
    for (const int joint : all) {
      if (fnmatch(pattern.c_str(), name(joint).c_str(), 0) != 0) continue;
      if (std::count(ordered.begin(), ordered.end(), joint) > 0) {
        complaints.Add("--joints", 0, 0, pattern, name(joint) + " is there already");
      }
      ordered.push_back(joint);
    }
    if (ordered.size() == before) complaints.Add("--joints", 0, 0, pattern, "no such joint");
  }
  for (const int joint : all) {
    if (std::count(ordered.begin(), ordered.end(), joint) == 0) {
      complaints.Add("--joints", 0, 0, name(joint), "is missing (valid: every joint once)");
    }
  }
  complaints.ThrowIfAny();
  return ordered;
}

}  // namespace halfstep
