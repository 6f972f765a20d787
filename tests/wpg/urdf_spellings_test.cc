// Every number of a URDF in every spelling: the robot of the plain file, or a refusal with place.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/replaced.h"
#include "tests/temporary_folder.h"
#include "tests/wpg/generated_robots.h"
#include "wpg/files/input_error.h"
#include "wpg/robot/robot_tree.h"

namespace halfstep {
namespace {

constexpr char kPack[] =
    "<link name='pack'><inertial><origin xyz='-0.05 0 0.125' rpy='0.25 0 0'/>"
    "<mass value='0.5'/><inertia ixx='0.5' ixy='0.125' ixz='0' iyy='0.25' iyz='0' izz='0.5'/>"
    "</inertial>"
    "<collision><origin xyz='-0.25 0 0.5' rpy='0 0.5 0'/>"
    "<geometry><box size='0.125 0.25 0.5'/></geometry></collision>"
    "<collision><geometry><sphere radius='0.25'/></geometry></collision>"
    "<collision><geometry><cylinder radius='0.25' length='0.5'/></geometry></collision>"
    "<collision><geometry><mesh filename='wedge.obj' scale='0.5 1 2'/></geometry></collision>"
    "</link><joint name='strap' type='fixed'><parent link='waist'/><child link='pack'/>"
    "<origin xyz='0 0 0.5' rpy='0 0 0.125'/></joint>\n";
constexpr char kWedge[] =
    "v 0 0 0\nv .2 0 0\nv 0 .2 0\nv 0 0 .2\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

// A number of the file, or three: what stands before them, up to the quote.
struct Place {
  std::string name, before;
};

std::vector<Place> Places() {
  const std::string pack = "<link name='pack'><inertial><origin xyz='";
  const std::string strap = "<child link='pack'/><origin xyz='";
  return {{"inertial origin xyz", pack},
          {"inertial origin rpy", pack + "-0.05 0 0.125' rpy='"},
          {"mass value", "0.25 0 0'/><mass value='"},
          {"inertia ixx", "<inertia ixx='"},
          {"inertia ixy", "<inertia ixx='0.5' ixy='"},
          {"inertia iyy", "ixz='0' iyy='"},
          {"inertia iyz", "iyy='0.25' iyz='"},
          {"collision origin xyz", "<collision><origin xyz='"},
          {"collision origin rpy", "-0.25 0 0.5' rpy='"},
          {"box size", "<box size='"},
          {"sphere radius", "<sphere radius='"},
          {"cylinder radius", "<cylinder radius='"},
          {"cylinder length", "<cylinder radius='0.25' length='"},
          {"mesh scale", "scale='"},
          {"joint origin xyz", strap},
          {"joint origin rpy", strap + "0 0 0.5' rpy='"},
          {"axis xyz", "<axis xyz='"},
          {"limit lower", "<limit lower='"},
          {"limit upper", "upper='"},
          {"limit velocity", "velocity='"},
          {"limit effort", "effort='"}};
}

using Spelling = std::function<std::string(const std::vector<std::string>&)>;

std::string Joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

// Each number for itself.
Spelling Each(const std::function<std::string(std::string)>& spell) {
  return [spell](std::vector<std::string> words) {
    for (std::string& word : words) word = spell(word);
    return Joined(words, " ");
  };
}

Spelling Around(const std::string& before, const std::string& between, const std::string& after) {
  return [=](const std::vector<std::string>& words) {
    return before + Joined(words, between) + after;
  };
}

// The last number alone.
Spelling Last(const std::string& from, const std::string& to) {
  return [=](std::vector<std::string> words) {
    const size_t at = words.back().find(from);
    if (from.empty()) {
      words.back() = to;
    } else if (at == std::string::npos) {
      words.back() += to;
    } else {
      words.back().replace(at, from.size(), to);
    }
    return Joined(words, " ");
  };
}

std::string WithoutZero(std::string word) {
  const size_t zero = word.find("0.");
  return zero == 0 || (zero == 1 && word[0] == '-') ? word.erase(zero, 1) : word;
}

std::vector<std::pair<std::string, Spelling>> SameNumbers() {
  const auto signed_word = [](const std::string& w) { return w[0] == '-' ? w : "+" + w; };
  return {{"tabs", Around("\t", "\t", "\t")},
          {"newlines", Around("\n", "\n", "\n")},
          {"CR LF", Around("\r\n", "\r\n", "\r\n")},
          {"&#10;", Around("", "&#10;", "&#10;")},
          {"leading blank", Around(" ", " ", "")},
          {"trailing blank", Around("", " ", " ")},
          {"several blanks", Around("  ", "   ", "  ")},
          {"+1", Each(signed_word)},
          {"1e-1", Each([](const std::string& w) { return w + "e-0"; })},
          {"1E+0", Each([](const std::string& w) { return w + "E+0"; })},
          {".5", Each(WithoutZero)},
          {"5.",
           Each([](const std::string& w) { return w.find('.') < w.size() ? w + "0" : w + "."; })}};
}

std::vector<std::pair<std::string, Spelling>> OtherNumbers() {
  return {{"non-breaking space", Around("", "\xC2\xA0", "\xC2\xA0")},
          {"form feed", Around("", "\f", "\f")},
          {"decimal comma", Last(".", ",")},
          {"NaN", Last("", "NaN")},
          {"inf", Last("", "inf")},
          {"1e999", Last("", "1e999")},
          {"hexadecimal", Last("", "0x1p-1")},
          {"010", Last("", "010")},
          {"1_0", Last("", "1_0")},
          {"minus sign U+2212", Last("",
                                     "\xE2\x88\x92"
                                     "1")},
          {"a unit", Last("", "0.5m")},
          {"two points", Last("", "0.5.0")},
          {"empty", [](const std::vector<std::string>&) { return std::string(); }},
          {"one more", [](const std::vector<std::string>& w) { return Joined(w, " ") + " 1"; }}};
}

std::string Spelled(std::string urdf, const Place& place, const Spelling& spelling) {
  const size_t found = urdf.find(place.before);
  EXPECT_NE(found, std::string::npos) << place.name;
  const size_t begin = found + place.before.size(), size = urdf.find('\'', begin) - begin;
  std::istringstream in(urdf.substr(begin, size));
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return urdf.replace(begin, size, spelling(words));
}

class UrdfSpellings : public testing::Test {
 protected:
  UrdfSpellings() : robot_(GeneratedRobots()[0]) {
    WriteText(folder_ / "wedge.obj", kWedge);
    WriteText(folder_ / "robot.yaml", GeneratedYaml(robot_, "robot.urdf"));
    plain_ = Replaced(GeneratedUrdf(robot_), "<link name='waist'",
                      std::string(kPack) + "<link name='waist'");
  }

  // Everything that is read of the robot, or the complaints.
  std::string Read(const std::string& urdf) {
    WriteText(folder_ / "robot.urdf", urdf);
    std::ostringstream out;
    out.precision(17);
    try {
      const WholeRobot whole = LoadWholeRobot((folder_ / "robot.yaml").string());
      const RobotModel& robot = whole.model;
      for (const UrdfLink& link : whole.tree.urdf.links) {
        out << link.name << link.mass << link.com << link.inertia << link.collisions.size() << "\n";
      }
      for (const RobotBody& body : robot.bodies) {
        out << body.name << body.shape.vertices << body.shape.radius << "\n";
      }
      for (const auto& [a, b] : robot.self_pairs) out << a << "-" << b << " ";
      for (const UnwatchedPair& pair : robot.unwatched_pairs) out << pair.why << " ";
      for (const Leg& leg : robot.legs) {
        for (const LegJoint& joint : leg.joints) {
          out << joint.name << joint.axis_B << joint.point_B << joint.lower << joint.upper
              << joint.max_speed << joint.max_torque;
        }
      }
      out << robot.mass << robot.masses.waist.com << robot.masses.waist.inertia
          << robot.masses.fault;
      for (const std::string& warning : robot.warnings) out << warning;
    } catch (const InputError& error) {
      refused_ = error.what();
      return "";
    }
    return out.str();
  }

  const GeneratedRobot robot_;
  const TemporaryFolder folder_;
  std::string plain_, refused_;
};

TEST_F(UrdfSpellings, OfTheSameNumbersMakeTheSameRobot) {
  const std::string plain = Read(plain_);
  ASSERT_NE(plain, "") << refused_;
  int cases = 0;
  for (const auto& [name, spelling] : SameNumbers()) {
    for (const Place& place : Places()) {
      EXPECT_TRUE(Read(Spelled(plain_, place, spelling)) == plain)
          << place.name << " with " << name << ": " << refused_;
      ++cases;
    }
  }
  EXPECT_EQ(cases, 12 * 21);
}

TEST_F(UrdfSpellings, OfNoNumbersAreRefusedWithTheirPlace) {
  for (const auto& [name, spelling] : OtherNumbers()) {
    for (const Place& place : Places()) {
      const std::string text = Spelled(plain_, place, spelling);
      EXPECT_EQ(Read(text), "") << place.name << " with " << name;
      const std::string key = place.name.substr(place.name.rfind(' ') + 1);
      EXPECT_THAT(refused_, testing::ContainsRegex("robot.urdf:[0-9]+:[0-9]+: .*" + key))
          << place.name << " with " << name;
      refused_.clear();
    }
  }
}

}  // namespace
}  // namespace halfstep
