#include "tests/oracle/plain_robot.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>

#include "tests/oracle/plain_files.h"

namespace halfstep::oracle {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

std::string Between(const std::string& text, const std::string& from, const std::string& to) {
  const size_t begin = text.find(from);
  if (begin == std::string::npos) throw std::runtime_error("oracle: no " + from + " in " + text);
  const size_t first = begin + from.size();
  return text.substr(first, text.find_first_of(to, first) - first);
}

Eigen::Matrix3d Inertia(const XmlTag& tag) {
  const auto of = [&tag](const char* key) { return std::stod(tag[key]); };
  const double xy = of("ixy"), xz = of("ixz"), yz = of("iyz");
  Eigen::Matrix3d I;
  I << of("ixx"), xy, xz, xy, of("iyy"), yz, xz, yz, of("izz");
  return I;
}

Eigen::Isometry3d Placed(const PlainRobot::Joint& joint, double q) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = joint.xyz;
  if (joint.turns) X.linear() = Eigen::AngleAxisd(q, joint.axis).toRotationMatrix();
  return X;
}

}  // namespace

PlainRobot::PlainRobot(const std::string& yaml_path) {
  const std::filesystem::path folder = std::filesystem::path(yaml_path).parent_path();
  const std::string yaml = ReadPlainFile(yaml_path);
  for (const YamlLine& line : YamlLines(yaml)) {
    if (line.key == "urdf") ReadUrdf((folder / line.value).string());
  }
  ReadYaml(yaml_path);
  FindLegs();
  ReadMeshes(folder.string());
  ChoosePairs();
  // What the model takes from the posture of standing.
  const std::vector<Eigen::Isometry3d> X = PlaceLinks({Standing(0), Standing(1)});
  Eigen::Vector3d moment(0, 0, 0);
  for (size_t i = 0; i < links.size(); ++i) {
    mass += links[i].mass;
    moment += links[i].mass * (X[i] * links[i].com);
  }
  com_x = moment.x() / mass;
  const Eigen::Vector3d left = PlaceLeg(0, Standing(0))[6].translation();
  const Eigen::Vector3d right = PlaceLeg(1, Standing(1))[6].translation();
  waist_height = -0.5 * (left.z() + right.z());
  standing_width = left.y() - right.y();
  if (com_height == 0.0) com_height = moment.z() / mass + waist_height;
}

int PlainRobot::LinkNamed(const std::string& name) const {
  for (size_t i = 0; i < links.size(); ++i) {
    if (links[i].name == name) return static_cast<int>(i);
  }
  throw std::runtime_error("oracle: no link " + name);
}

int PlainRobot::JointNamed(const std::string& name) const {
  for (size_t i = 0; i < joints.size(); ++i) {
    if (joints[i].name == name) return static_cast<int>(i);
  }
  throw std::runtime_error("oracle: no joint " + name);
}

void PlainRobot::ReadUrdf(const std::string& path) {
  for (const XmlTag& tag : XmlTags(ReadPlainFile(path))) {
    if (tag.attributes.contains("rpy")) throw std::runtime_error("oracle: rpy is not read");
    if (tag.within == "robot" && tag.name == "link") {
      links.emplace_back();
      links.back().name = tag["name"];
    }
    if (tag.within == "robot/link/inertial") {
      if (tag.name == "mass") links.back().mass = std::stod(tag["value"]);
      if (tag.name == "origin") links.back().com = ThreeNumbers(tag["xyz"]);
      if (tag.name == "inertia") links.back().inertia = Inertia(tag);
    }
    if (tag.within.starts_with("robot/link/collision")) {
      if (tag.name == "mesh" && links.back().mesh.empty() && tag.attributes.size() == 1) {
        links.back().mesh = tag["filename"];
      } else if (tag.name != "geometry") {
        throw std::runtime_error("oracle: a <collision> with <" + tag.name + ">");
      }
    }
    if (tag.within == "robot" && tag.name == "joint") {
      joints.push_back({.name = tag["name"], .child = {}, .parent = {}});
      joints.back().turns = tag["type"] == "revolute";
    }
    if (tag.within == "robot/joint") {
      Joint& joint = joints.back();
      if (tag.name == "parent") joint.parent = tag["link"];
      if (tag.name == "child") joint.child = tag["link"];
      if (tag.name == "origin") joint.xyz = ThreeNumbers(tag["xyz"]);
      if (tag.name == "axis") joint.axis = ThreeNumbers(tag["xyz"]).normalized();
      if (tag.name == "limit") {
        joint.lower = std::stod(tag["lower"]);
        joint.upper = std::stod(tag["upper"]);
        joint.speed = std::stod(tag["velocity"]);
        const double effort = std::stod(tag["effort"]);
        if (effort > 0) joint.effort = effort;
      }
    }
  }
  for (size_t j = 0; j < joints.size(); ++j) {
    Link& link = links[static_cast<size_t>(LinkNamed(joints[j].child))];
    link.joint = static_cast<int>(j);
    link.parent = LinkNamed(joints[j].parent);
  }
}

void PlainRobot::ReadYaml(const std::string& path) {
  std::string section;
  for (const YamlLine& line : YamlLines(ReadPlainFile(path))) {
    if (line.indent == 0 && !line.key.empty()) section = line.key;
    if (line.key == "waist_link") waist = LinkNamed(line.value);
    if (line.key == "com_height_m") com_height = std::stod(line.value);
    if (line.key == "sole_size_m") {
      const std::vector<double> size = NumbersIn(line.value);
      sole_size = {size.at(0), size.at(1)};
    }
    if (section == "legs" && line.indent > 0) {
      if (line.value.find("rpy") != std::string::npos) throw std::runtime_error("oracle: rpy");
      Leg& leg = legs[line.key == "left" ? 0 : 1];
      leg.foot_link = LinkNamed(Between(line.value, "foot_link: ", ","));
      leg.sole = ThreeNumbers(Between(line.value, "sole_xyz: [", "]"));
    }
    if (section == "standing_posture_deg" && line.indent > 0) {
      joints[static_cast<size_t>(JointNamed(line.key))].standing = kDegree * std::stod(line.value);
    }
    if (section == "joint_limits_deg" && line.indent > 0) {
      Joint& joint = joints[static_cast<size_t>(JointNamed(line.key))];
      const std::vector<double> limits = NumbersIn(line.value);
      joint.lower = kDegree * limits.at(0);
      joint.upper = kDegree * limits.at(1);
    }
    if (line.indent > 0 &&
        (section == "effort_limits_n_m" || section == "acceleration_limits_rad_s2")) {
      Joint& joint = joints[static_cast<size_t>(JointNamed(line.key))];
      (section[0] == 'e' ? joint.effort : joint.acceleration) =
          line.value == "none" ? kUnknown : std::stod(line.value);
    }
    if (section == "excluded_self_pairs" && line.key.empty()) {
      excluded.push_back({Between(line.value, "links: [", ","), Between(line.value, ", ", "]")});
    }
  }
}

void PlainRobot::FindLegs() {
  for (Leg& leg : legs) {
    int link = leg.foot_link;
    for (size_t j = 6; j-- > 0; link = links[static_cast<size_t>(link)].parent) {
      leg.joints[j] = links[static_cast<size_t>(link)].joint;
    }
    if (link != waist) throw std::runtime_error("oracle: a leg of another kind");
    const auto at = [&](size_t j) { return joints[static_cast<size_t>(leg.joints[j])].xyz; };
    leg.axes_meet = at(1).norm() + at(2).norm() + at(5).norm() == 0;
  }
}

void PlainRobot::ReadMeshes(const std::string& folder) {
  constexpr const char *kPackage = "package://", *kBodies = "_bodies/";
  for (size_t i = 0; i < links.size(); ++i) {
    const std::string& mesh = links[i].mesh;
    if (mesh.empty()) continue;
    // package://NAME_bodies/FILE is NAME/FILE beside the robot.
    const size_t end = mesh.find(kBodies);
    if (!mesh.starts_with(kPackage) || end == std::string::npos) {
      throw std::runtime_error("oracle: mesh " + mesh);
    }
    const size_t begin = std::string(kPackage).size();
    const std::string name = mesh.substr(begin, end - begin);
    const std::string file =
        folder + "/" + name + "/" + mesh.substr(end + std::string(kBodies).size());
    Body body{.name = links[i].name, .link = static_cast<int>(i), .points = {}};
    body.points = ObjPoints(ReadPlainFile(file));
    for (const Eigen::Vector3d& p : body.points) {
      body.center += p / static_cast<double>(body.points.size());
    }
    for (const Eigen::Vector3d& p : body.points) {
      body.radius = std::max(body.radius, (p - body.center).norm());
    }
    bodies.push_back(std::move(body));
  }
}

Vector6 PlainRobot::Standing(int leg) const {
  Vector6 q;
  for (int j = 0; j < 6; ++j) {
    const int joint = legs[static_cast<size_t>(leg)].joints[static_cast<size_t>(j)];
    q[j] = joints[static_cast<size_t>(joint)].standing;
  }
  return q;
}

std::vector<Eigen::Isometry3d> PlainRobot::PlaceLinks(const std::array<Vector6, 2>& q) const {
  std::vector<Eigen::Isometry3d> X(links.size(), Eigen::Isometry3d::Identity());
  std::vector<double> angles;
  for (const Joint& joint : joints) angles.push_back(joint.standing);
  for (size_t leg = 0; leg < 2; ++leg) {
    for (size_t j = 0; j < 6; ++j) {
      angles[static_cast<size_t>(legs[leg].joints[j])] = q[leg][static_cast<Eigen::Index>(j)];
    }
  }
  for (size_t i = 0; i < links.size(); ++i) {  // parents come first in the file
    const Link& link = links[i];
    if (link.parent < 0) continue;
    if (link.parent >= static_cast<int>(i)) throw std::runtime_error("oracle: links out of order");
    const size_t joint = static_cast<size_t>(link.joint);
    X[i] = X[static_cast<size_t>(link.parent)] * Placed(joints[joint], angles[joint]);
  }
  return X;
}

// Two links that one joint joins, or two whose axes meet in one point.
bool PlainRobot::JoinedAtOnePoint(int a, int b) const {
  std::vector<int> way;  // joints between the two
  int first = a, second = b;
  while (first != second) {
    int& lower = first > second ? first : second;
    if (joints[static_cast<size_t>(links[static_cast<size_t>(lower)].joint)].turns) {
      way.push_back(links[static_cast<size_t>(lower)].joint);
    }
    lower = links[static_cast<size_t>(lower)].parent;
  }
  if (way.size() != 2) return way.size() < 2;
  // The axes of two joints in a row meet when the second lies at the first one's origin.
  const Joint &one = joints[static_cast<size_t>(way[0])],
              &other = joints[static_cast<size_t>(way[1])];
  return (one.child == other.parent && other.xyz.norm() < 1e-9) ||
         (other.child == one.parent && one.xyz.norm() < 1e-9);
}

void PlainRobot::ChoosePairs() {
  const auto leg_of = [this](int link) {
    for (; link >= 0; link = links[static_cast<size_t>(link)].parent) {
      for (int leg = 0; leg < 2; ++leg) {
        const auto& its = legs[static_cast<size_t>(leg)].joints;
        if (std::find(its.begin(), its.end(), links[static_cast<size_t>(link)].joint) !=
            its.end()) {
          return leg;
        }
      }
    }
    return -1;
  };
  for (size_t a = 0; a < bodies.size(); ++a) {
    for (size_t b = a + 1; b < bodies.size(); ++b) {
      const int link_a = bodies[a].link, link_b = bodies[b].link;
      const bool rigid = leg_of(link_a) < 0 && leg_of(link_b) < 0;
      const bool named = std::any_of(excluded.begin(), excluded.end(), [&](const auto& pair) {
        return (pair[0] == bodies[a].name && pair[1] == bodies[b].name) ||
               (pair[1] == bodies[a].name && pair[0] == bodies[b].name);
      });
      if (!rigid && !named && !JoinedAtOnePoint(link_a, link_b)) {
        watched.push_back({static_cast<int>(a), static_cast<int>(b)});
      }
    }
  }
}

}  // namespace halfstep::oracle
