#include "tests/oracle/unequal_legs.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "tests/oracle/nasty_draws.h"
#include "tests/oracle/plain_files.h"
#include "tests/oracle/plain_robot.h"
#include "tests/oracle/project_side.h"
#include "tests/places.h"

namespace halfstep::oracle {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

std::string Text(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string Text(const Eigen::Vector3d& v) {
  return Text(v.x()) + " " + Text(v.y()) + " " + Text(v.z());
}

// How a joint, and the link that it moves, differ from the shipped robot's.
struct JointChange {
  Eigen::Vector3d moved{0, 0, 0}, turned{0, 0, 0};  // [m], [rad]
  double lower = 0, upper = 0;                      // tighter by [rad]
  double speed = 1, torque = 1, acceleration = 1, mass = 1;
};
struct LegChange {
  std::array<JointChange, 6> joints;
  Eigen::Vector3d sole{0, 0, 0};                    // moved [m]
  Eigen::Vector3d foot = Eigen::Vector3d(1, 1, 1);  // scale of its body, and of the sole's height
};

LegChange DrawLeg(double size, bool offset, Draw* draw) {
  LegChange leg;
  for (size_t j = 0; j < 6; ++j) {
    JointChange& joint = leg.joints[j];
    const Eigen::Vector3d moved = 0.005 * size * draw->Vector(-1, 1);
    if (j == 0 || j == 3 || j == 4 || offset) joint.moved = moved;
    if (j == 3 || j == 4) joint.moved.z() *= 2;
    joint.turned = kDegree * draw->Uniform(0, 1) * draw->Vector(-1, 1).normalized();
    joint.lower = kDegree * draw->Uniform(0, 3);
    joint.upper = kDegree * draw->Uniform(0, 3);
    joint.speed = draw->Uniform(0.85, 1.15);
    joint.torque = draw->Uniform(0.8, 1.2);
    joint.acceleration = draw->Uniform(0.8, 1.2);
    joint.mass = draw->Uniform(0.9, 1.1);
  }
  leg.sole = 0.004 * size * draw->Vector(-1, 1);
  leg.sole.z() = 0;
  leg.foot = {draw->Uniform(0.97, 1.08), draw->Uniform(0.97, 1.08), draw->Uniform(0.97, 1.03)};
  return leg;
}

// The right leg as a control's oracle knows it.
void Forget(Unknown unknown, const LegChange& left, LegChange* right) {
  for (size_t j = 0; j < 6; ++j) {
    JointChange& its = right->joints[j];
    const JointChange plain;
    if (unknown == Unknown::kLengths) {
      its.moved = left.joints[j].moved.cwiseProduct(Eigen::Vector3d(1, -1, 1));
    }
    if (unknown == Unknown::kAxes) its.turned = plain.turned;
    if (unknown == Unknown::kAngleLimits) its.lower = its.upper = 0;
    if (unknown == Unknown::kSpeedLimits) its.speed = 1;
    if (unknown == Unknown::kTorques) its.torque = 1;
    if (unknown == Unknown::kAccelerations) its.acceleration = 1;
    if (unknown == Unknown::kMasses) its.mass = 1;
  }
  if (unknown == Unknown::kFeet) {
    right->sole = LegChange().sole;
    right->foot = LegChange().foot;
  }
}

// The value of an attribute in a line of XML, replaced.
void Replace(std::string* line, const std::string& attribute, const std::string& value) {
  const std::string key = " " + attribute + "=\"";
  const size_t begin = line->find(key);
  if (begin == std::string::npos) throw std::runtime_error("oracle: no" + key + " in " + *line);
  const size_t from = begin + key.size();
  line->replace(from, line->find('"', from) - from, value);
}

// The robot's files with some of what they say changed: one element of the URDF a line.
class Rewriter {
 public:
  Rewriter(const std::string& name, const std::string& folder)
      : name_(name), folder_(folder), path_(WriteJudgedRobot(name, folder)), shipped_(path_) {
    const std::filesystem::path bodies = folder_ / name_, urdf = folder_ / (name_ + ".urdf");
    urdf_ = ReadPlainFile(urdf.string());
    yaml_ = ReadPlainFile(path_);
    // Links to the shipped files until here.
    std::filesystem::remove(urdf);
    std::filesystem::remove(bodies);
    std::filesystem::create_directory(bodies);
    for (const auto& entry :
         std::filesystem::directory_iterator(InSources("wpg/robots/") + name_)) {
      std::filesystem::create_symlink(entry.path(), bodies / entry.path().filename());
    }
  }

  const std::string& path() const { return path_; }
  const PlainRobot& shipped() const { return shipped_; }

  void WriteUrdf(const std::array<LegChange, 2>& legs) const {
    std::map<std::string, JointChange> by_joint, by_link;
    for (size_t leg = 0; leg < 2; ++leg) {
      for (size_t j = 0; j < 6; ++j) {
        const auto& joint = shipped_.joints[static_cast<size_t>(shipped_.legs[leg].joints[j])];
        by_joint[joint.name] = by_link[joint.child] = legs[leg].joints[j];
      }
    }
    std::istringstream in(urdf_);
    std::ofstream out(folder_ / (name_ + ".urdf"));
    const JointChange *joint = nullptr, *link = nullptr;
    for (std::string line; std::getline(in, line); out << line << "\n") {
      if (line.find("</joint>") != std::string::npos) joint = nullptr;
      if (line.find("</link>") != std::string::npos) link = nullptr;
      if (line.find("<joint name") != std::string::npos) joint = Find(by_joint, line);
      if (line.find("<link name") != std::string::npos) link = Find(by_link, line);
      if (joint != nullptr) ChangeJoint(*joint, &line);
      if (link != nullptr) ChangeLink(*link, &line);
    }
  }

  // The foot's body, seen from the foot's frame, about the sole's centre.
  void WriteFeet(const std::array<LegChange, 2>& legs) const {
    for (size_t leg = 0; leg < 2; ++leg) {
      const PlainRobot::Leg& its = shipped_.legs[leg];
      const std::string& mesh = shipped_.links[static_cast<size_t>(its.foot_link)].mesh;
      const std::filesystem::path file = folder_ / name_ / mesh.substr(mesh.find_last_of('/') + 1);
      std::istringstream in(ReadPlainFile(file.string()));
      std::filesystem::remove(file);
      std::ofstream out(file);
      const Eigen::Vector3d about(its.sole.x(), its.sole.y(), 0);
      for (std::string line; std::getline(in, line); out << line << "\n") {
        if (!line.starts_with("v ")) continue;
        const Eigen::Vector3d p = ThreeNumbers(line.substr(2)) - about;
        line = "v " + Text(about + p.cwiseProduct(legs[leg].foot));
      }
    }
  }

  // `standing` [rad] of both legs.
  void WriteYaml(const std::array<LegChange, 2>& legs, double sole_share, bool offset,
                 const std::array<Vector6, 2>& standing) const {
    std::map<std::string, std::string> sections;
    for (size_t leg = 0; leg < 2; ++leg) {
      for (size_t j = 0; j < 6; ++j) {
        const auto& joint = shipped_.joints[static_cast<size_t>(shipped_.legs[leg].joints[j])];
        const JointChange& change = legs[leg].joints[j];
        const std::string key = "  " + joint.name + ": ";
        sections["standing_posture_deg"] +=
            key + Text(standing[leg][static_cast<Eigen::Index>(j)] / kDegree) + "\n";
        sections["joint_limits_deg"] += key + "[" + Text((joint.lower + change.lower) / kDegree) +
                                        ", " + Text((joint.upper - change.upper) / kDegree) + "]\n";
        sections["effort_limits_n_m"] += key + Text(joint.effort * change.torque) + "\n";
        if (joint.acceleration < PlainRobot::kUnknown) {
          sections["acceleration_limits_rad_s2"] +=
              key + Text(joint.acceleration * change.acceleration) + "\n";
        }
      }
    }
    if (offset) sections["excluded_self_pairs"] = PairsOfJoinedBodies();
    std::istringstream in(yaml_);
    std::ofstream out(path_);
    std::string section;
    for (std::string line; std::getline(in, line);) {
      const std::vector<YamlLine> read = YamlLines(line);
      if (!read.empty() && read[0].indent == 0) section = read[0].key;
      const bool of_leg =
          !read.empty() && read[0].indent > 0 && sections.contains(section) && IsLegs(read[0].key);
      if (of_leg) continue;
      for (size_t leg = 0; leg < 2 && section == "legs"; ++leg) {
        if (read.empty() || read[0].key != (leg == 0 ? "left" : "right")) continue;
        const Eigen::Vector3d sole = Sole(leg, legs[leg]);
        line = line.substr(0, line.find("sole_xyz")) + "sole_xyz: [" + Text(sole.x()) + ", " +
               Text(sole.y()) + ", " + Text(sole.z()) + "]}";
      }
      if (section == "sole_size_m" && !read.empty()) {
        line = "sole_size_m: [" + Text(sole_share * shipped_.sole_size.x()) + ", " +
               Text(sole_share * shipped_.sole_size.y()) + "]";
      }
      out << line << "\n";
      if (!read.empty() && read[0].indent == 0 && sections.contains(section)) {
        out << sections[section];
        sections[section].clear();
      }
    }
    for (const auto& [key, lines] : sections) {
      if (!lines.empty()) out << key << ":\n" << lines;
    }
  }

  Eigen::Vector3d Sole(size_t leg, const LegChange& change) const {
    Eigen::Vector3d sole = shipped_.legs[leg].sole + change.sole;
    sole.z() *= change.foot.z();
    return sole;
  }

 private:
  static const JointChange* Find(const std::map<std::string, JointChange>& changes,
                                 const std::string& line) {
    const size_t from = line.find("name=\"") + 6;
    const auto found = changes.find(line.substr(from, line.find('"', from) - from));
    return found == changes.end() ? nullptr : &found->second;
  }
  static Eigen::Vector3d Xyz(const std::string& line) {
    const size_t from = line.find("xyz=\"") + 5;
    return ThreeNumbers(line.substr(from, line.find('"', from) - from));
  }
  static double Number(const std::string& line, const std::string& attribute) {
    const size_t from = line.find(" " + attribute + "=\"") + attribute.size() + 3;
    return std::stod(line.substr(from, line.find('"', from) - from));
  }
  static void ChangeJoint(const JointChange& joint, std::string* line) {
    if (line->find("<origin") != std::string::npos) {
      Replace(line, "xyz", Text(Xyz(*line) + joint.moved));
    } else if (line->find("<axis") != std::string::npos) {
      const double angle = joint.turned.norm();
      if (angle == 0) return;
      Replace(line, "xyz", Text(Eigen::AngleAxisd(angle, joint.turned / angle) * Xyz(*line)));
    } else if (line->find("<limit") != std::string::npos) {
      Replace(line, "velocity", Text(Number(*line, "velocity") * joint.speed));
    }
  }
  static void ChangeLink(const JointChange& link, std::string* line) {
    if (line->find("<mass ") != std::string::npos) {
      Replace(line, "value", Text(Number(*line, "value") * link.mass));
    } else if (line->find("<inertia ") != std::string::npos) {
      for (const char* of : {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}) {
        Replace(line, of, Text(Number(*line, of) * link.mass));
      }
    }
  }
  bool IsLegs(const std::string& joint) const {
    for (const PlainRobot::Leg& leg : shipped_.legs) {
      for (const int j : leg.joints) {
        if (shipped_.joints[static_cast<size_t>(j)].name == joint) return true;
      }
    }
    return false;
  }
  // Bodies that two axes which meet join on the shipped robot; on an offset one these miss.
  std::string PairsOfJoinedBodies() const {
    std::string lines;
    for (const PlainRobot::Leg& leg : shipped_.legs) {
      std::vector<int> chain = {shipped_.waist};
      for (const int j : leg.joints) {
        for (size_t i = 0; i < shipped_.links.size(); ++i) {
          if (shipped_.links[i].joint == j) chain.push_back(static_cast<int>(i));
        }
      }
      for (const auto& [a, b] : {std::array{0, 2}, std::array{1, 3}, std::array{4, 6}}) {
        const auto &one = shipped_.links[static_cast<size_t>(chain[static_cast<size_t>(a)])],
                   &other = shipped_.links[static_cast<size_t>(chain[static_cast<size_t>(b)])];
        if (one.mesh.empty() || other.mesh.empty()) continue;
        lines += "  - {links: [" + one.name + ", " + other.name + "], why: joined}\n";
      }
    }
    return lines;
  }

  const std::string name_;
  const std::filesystem::path folder_;
  const std::string path_;
  const PlainRobot shipped_;
  std::string urdf_, yaml_;
};

}  // namespace

std::string WriteUnequalRobot(const std::string& name, const UnequalLegs& drawn,
                              const std::string& folder) {
  const Rewriter files(name, folder);
  const PlainRobot& shipped = files.shipped();
  Draw draw(drawn.seed ^ 0x2545f491u);
  std::array<LegChange, 2> legs;
  for (LegChange& leg : legs) leg = DrawLeg(shipped.size(), drawn.offset, &draw);
  const double sole_share = draw.Uniform(0.9, 1);
  Forget(drawn.unknown, legs[0], &legs[1]);
  files.WriteUrdf(legs);
  files.WriteFeet(legs);
  std::array<Vector6, 2> standing = {shipped.Standing(0), shipped.Standing(1)};
  files.WriteYaml(legs, sole_share, drawn.offset, standing);
  const PlainRobot robot(files.path());
  for (int leg = 0; leg < 2; ++leg) {
    Eigen::Isometry3d X_BSole = Eigen::Isometry3d::Identity();
    X_BSole.translation()
        << shipped.PlaceLeg(leg, standing[static_cast<size_t>(leg)])[6].translation().x(),
        (leg == 0 ? 0.5 : -0.5) * shipped.standing_width, -shipped.waist_height;
    if (!robot.SolveLeg(leg, X_BSole, &standing[static_cast<size_t>(leg)])) {
      throw std::runtime_error("oracle: a drawn robot does not stand");
    }
  }
  files.WriteYaml(legs, sole_share, drawn.offset, standing);
  return files.path();
}

std::string StudiedRobot(const std::string& name, const std::string& folder) {
  const size_t dash = name.find('-');
  if (dash == std::string::npos) return InSources("wpg/robots/") + name + ".yaml";
  const bool offset = name.substr(dash) == "-offset";
  return WriteUnequalRobot(name.substr(0, dash), {.seed = 1, .offset = offset}, folder);
}

}  // namespace halfstep::oracle
