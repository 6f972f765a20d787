#include "experiments/export/frame_files.h"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "experiments/export/npz_archive.h"
#include "wpg/files/number_text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using nlohmann::ordered_json;

std::vector<std::string> JointNames(const BodyMotion& motion, const std::vector<int>& joints) {
  std::vector<std::string> names;
  for (const int joint : joints) names.push_back(Nth(motion.tree().urdf.joints, joint).name);
  return names;
}

std::vector<std::string> LinkNames(const BodyMotion& motion, const std::vector<int>& links) {
  std::vector<std::string> names;
  for (const int link : links) names.push_back(Nth(motion.tree().urdf.links, link).name);
  return names;
}

// The rotations of a link frame by frame: w ≥ 0 in the first, and no sign jumps.
class LinkRotation {
 public:
  Eigen::Quaterniond Next(const Eigen::Matrix3d& R) {
    Eigen::Quaterniond q = Eigen::Quaterniond(R).normalized();
    if (q.coeffs().dot(last_.coeffs()) < 0.0) q.coeffs() *= -1.0;
    last_ = q;
    return q;
  }

 private:
  Eigen::Quaterniond last_{1.0, 0.0, 0.0, 0.0};
};

void Append(const Eigen::Vector3d& p, std::vector<double>* values) {
  values->insert(values->end(), {p.x(), p.y(), p.z()});
}

std::string MjlabFile(const BodyMotion& motion, const std::vector<BodyFrame>& frames,
                      const FrameFileOptions& options, const std::string& path) {
  const BodyOrder order = motion.Order(options.all_links);
  std::vector<double> q, speeds, places, rotations, velocities, turns;
  std::vector<LinkRotation> rotation(order.links.size());
  for (const BodyFrame& frame : frames) {
    for (const int joint : order.joints) {
      q.push_back(Nth(frame.q, joint));
      speeds.push_back(Nth(frame.speeds, joint));
    }
    for (size_t i = 0; i < order.links.size(); ++i) {
      const int link = order.links[i];
      const Eigen::Isometry3d& X = Nth(frame.X_W, link);
      const Eigen::Quaterniond r = rotation[i].Next(X.linear());
      Append(X.translation(), &places);
      rotations.insert(rotations.end(), {r.w(), r.x(), r.y(), r.z()});
      Append(Nth(frame.velocity, link), &velocities);
      Append(Nth(frame.turn, link), &turns);
    }
  }
  NpzArchive archive(path, "a lower --fps");
  const size_t n = frames.size(), joints = order.joints.size(), links = order.links.size();
  archive.Add("fps", {1}, std::vector<std::int64_t>{options.fps});
  archive.Add("joint_pos", {n, joints}, q);
  archive.Add("joint_vel", {n, joints}, speeds);
  archive.Add("body_pos_w", {n, links, 3}, places);
  archive.Add("body_quat_w", {n, links, 4}, rotations);
  archive.Add("body_lin_vel_w", {n, links, 3}, velocities);
  archive.Add("body_ang_vel_w", {n, links, 3}, turns);
  archive.Add("joint_names", JointNames(motion, order.joints));
  archive.Add("body_names", LinkNames(motion, order.links));
  return archive.Finished();
}

std::string LafanFile(const std::vector<BodyFrame>& frames, const FrameFileOptions& options) {
  std::string text;
  LinkRotation rotation;
  for (const BodyFrame& frame : frames) {
    const Eigen::Isometry3d& X = frame.X_W.front();
    const Eigen::Vector3d p = X.translation();
    const Eigen::Quaterniond r = rotation.Next(X.linear());
    std::string line;
    for (const double value : {p.x(), p.y(), p.z(), r.x(), r.y(), r.z(), r.w()}) {
      line += (line.empty() ? "" : ",") + ShortestText(value);
    }
    for (const int joint : options.joints) line += "," + ShortestText(Nth(frame.q, joint));
    text += line + "\n";
  }
  return text;
}

ordered_json List(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

std::string JsonFile(const BodyMotion& motion, const std::vector<BodyFrame>& frames,
                     const FrameFileOptions& options) {
  const BodyOrder order = motion.Order(options.all_links);
  std::vector<LinkRotation> rotation(order.links.size());
  const auto dump = [](const ordered_json& json) {
    return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  };
  const ordered_json head = {
      {"format", 1},
      {"program", "halfstep"},
      {"kind", "frames"},
      {"robot", motion.robot().name},
      {"fps", options.fps},
      {"units",
       {{"t", "s"},
        {"joint_pos", "rad"},
        {"joint_vel", "rad/s"},
        {"com", "m"},
        {"body_pos", "m"},
        {"body_quat", "1"},
        {"body_lin_vel", "m/s"},
        {"body_ang_vel", "rad/s"}}},
      {"expressed_in",
       "the world: z up, the floor at z = 0; body_quat is w, x, y, z of the rotation from body to "
       "world, body_lin_vel that of the body's origin"},
      {"joint_names", JointNames(motion, order.joints)},
      {"body_names", LinkNames(motion, order.links)}};
  std::string text = dump(head);
  text.back() = ',';
  text += "\"frames\":[";
  std::string separator = "\n";
  for (const BodyFrame& frame : frames) {
    ordered_json q = ordered_json::array(), speeds = q, places = q, rotations = q, velocities = q,
                 turns = q;
    for (const int joint : order.joints) {
      q.push_back(Nth(frame.q, joint));
      speeds.push_back(Nth(frame.speeds, joint));
    }
    for (size_t i = 0; i < order.links.size(); ++i) {
      const Eigen::Isometry3d& X = Nth(frame.X_W, order.links[i]);
      const Eigen::Quaterniond r = rotation[i].Next(X.linear());
      places.push_back(List(X.translation()));
      rotations.push_back({r.w(), r.x(), r.y(), r.z()});
      velocities.push_back(List(Nth(frame.velocity, order.links[i])));
      turns.push_back(List(Nth(frame.turn, order.links[i])));
    }
    text += separator + dump({{"t", frame.t},
                              {"support", !frame.stands[0]   ? "right"
                                          : !frame.stands[1] ? "left"
                                                             : "both"},
                              {"com", List(frame.com)},
                              {"joint_pos", q},
                              {"joint_vel", speeds},
                              {"body_pos", places},
                              {"body_quat", rotations},
                              {"body_lin_vel", velocities},
                              {"body_ang_vel", turns}});
    separator = ",\n";
  }
  return text + "\n]}\n";
}

}  // namespace

const std::vector<FrameFormat>& FrameFormats() {
  static const std::vector<FrameFormat> formats = {
      {"mjlab", ".npz", 50}, {"lafan1", ".csv", 30}, {"json", ".json", 50}};
  return formats;
}

const FrameFormat* FindFrameFormat(const std::string& name) {
  const auto found = std::ranges::find(FrameFormats(), name, &FrameFormat::name);
  return found == FrameFormats().end() ? nullptr : &*found;
}

std::string FrameFile(const FrameFormat& format, const BodyMotion& motion,
                      const std::vector<BodyFrame>& frames, const FrameFileOptions& options,
                      const std::string& path) {
  if (format.name == "mjlab") return MjlabFile(motion, frames, options, path);
  if (format.name == "lafan1") return LafanFile(frames, options);
  return JsonFile(motion, frames, options);
}

}  // namespace halfstep
