#include "wpg/robot/urdf_check.h"

#include <tinyxml.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>

#include "wpg/files/nesting.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

// urdfdom and what reads its tree call themselves at each link of a chain.
constexpr size_t kMostLinks = 5000;
constexpr int kMostSuggestions = 20;  // each is a look at all names

using Elements = std::vector<const TiXmlElement*>;

Elements ChildrenOf(const TiXmlElement& parent, const char* tag) {
  Elements children;
  for (auto* e = parent.FirstChildElement(tag); e != nullptr; e = e->NextSiblingElement(tag)) {
    children.push_back(e);
  }
  return children;
}

std::string Attribute(const TiXmlElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value == nullptr ? "" : value;
}

class Checker {
 public:
  Checker(const std::string& file, Complaints* complaints) : file_(file), complaints_(complaints) {}

  UrdfPlaces Check(const TiXmlElement& robot) {
    if (robot.ValueStr() != "robot") {
      Complain(robot, robot.ValueStr(), "the top element must be <robot>");
      return places_;
    }
    const Elements links = ChildrenOf(robot, "link");
    if (links.size() > kMostLinks) {
      Complain(robot, "robot",
               "has " + std::to_string(links.size()) + " links (valid: at most " +
                   std::to_string(kMostLinks) + ")");
      return places_;
    }
    for (const TiXmlElement* link : links) CheckLink(*link);
    for (const TiXmlElement* joint : ChildrenOf(robot, "joint")) CheckJoint(*joint);
    CheckTree(robot);
    return places_;
  }

 private:
  void Complain(const TiXmlElement& at, const std::string& key, const std::string& what) {
    complaints_->Add(file_, at.Row(), at.Column(), key, what);
  }

  // `count` finite numbers of an attribute; complains and returns nothing otherwise.
  std::optional<std::vector<double>> Numbers(const TiXmlElement& element, const char* attribute,
                                             size_t count) {
    const std::string key = element.ValueStr() + " " + attribute;
    if (element.Attribute(attribute) == nullptr) {
      Complain(element, key, "is missing");
      return std::nullopt;
    }
    std::istringstream words(Attribute(element, attribute));
    std::vector<double> values;
    for (std::string word; words >> word;) {
      const NumberText number = ParseNumber(word);
      if (number.kind != NumberText::Kind::kNumber) {
        Complain(element, key, "`" + word + "` is not a finite number");
        return std::nullopt;
      }
      values.push_back(number.value);
    }
    if (values.size() != count) {
      Complain(element, key,
               "has " + std::to_string(values.size()) +
                   " numbers (valid: " + std::to_string(count) + ")");
      return std::nullopt;
    }
    return values;
  }

  // Numbers that must all be above `bound`, or at least it.
  void Bounded(const TiXmlElement& element, const char* attribute, size_t count,
               bool zero_allowed) {
    const auto values = Numbers(element, attribute, count);
    if (!values) return;
    const double least = *std::min_element(values->begin(), values->end());
    if (least < 0 || (least == 0 && !zero_allowed)) {
      Complain(element, element.ValueStr() + " " + attribute,
               Attribute(element, attribute) +
                   " is out of range (valid: " + (zero_allowed ? "≥ 0" : "> 0") + ")");
    }
  }

  void CheckOrigin(const TiXmlElement& parent) {
    for (const TiXmlElement* origin : ChildrenOf(parent, "origin")) {
      for (const char* attribute : {"xyz", "rpy"}) {
        if (origin->Attribute(attribute) != nullptr) Numbers(*origin, attribute, 3);
      }
    }
  }

  // Registers a name; complains when it is empty, unfit or taken.
  std::string Name(const TiXmlElement& element, std::map<std::string, UrdfPlace>* places) {
    const std::string name = Attribute(element, "name");
    const std::string mistake = NameMistake(name);
    if (name.empty()) Complain(element, element.ValueStr() + " name", "is missing");
    if (!mistake.empty()) Complain(element, element.ValueStr() + " name", mistake);
    if (!places->emplace(name, UrdfPlace{element.Row(), element.Column()}).second) {
      Complain(element, name, "a second " + element.ValueStr() + " of this name");
    }
    return name;
  }

  void CheckLink(const TiXmlElement& link) {
    const std::string name = Name(link, &places_.links);
    if (const TiXmlElement* inertial = link.FirstChildElement("inertial")) {
      CheckOrigin(*inertial);
      if (auto* mass = Required(*inertial, "mass")) Bounded(*mass, "value", 1, true);
      if (auto* inertia = Required(*inertial, "inertia")) {
        for (const char* moment : {"ixx", "iyy", "izz"}) Bounded(*inertia, moment, 1, true);
        for (const char* product : {"ixy", "ixz", "iyz"}) Numbers(*inertia, product, 1);
      }
    }
    for (const char* tag : {"visual", "collision"}) {
      for (const TiXmlElement* shape : ChildrenOf(link, tag)) {
        CheckOrigin(*shape);
        if (auto* geometry = Required(*shape, "geometry")) CheckGeometry(*geometry);
      }
    }
    for (const TiXmlElement* shape : ChildrenOf(link, "collision")) {
      places_.collisions[name].push_back({shape->Row(), shape->Column()});
    }
  }

  const TiXmlElement* Required(const TiXmlElement& parent, const char* tag) {
    const TiXmlElement* child = parent.FirstChildElement(tag);
    if (child == nullptr) {
      std::string what = "has no <";
      what += tag;
      what += '>';
      Complain(parent, parent.ValueStr(), what);
    }
    return child;
  }

  void CheckGeometry(const TiXmlElement& geometry) {
    const TiXmlElement* shape = geometry.FirstChildElement();
    const std::string kind = shape == nullptr ? "" : shape->ValueStr();
    if (kind == "box") {
      Bounded(*shape, "size", 3, false);
    } else if (kind == "sphere") {
      Bounded(*shape, "radius", 1, false);
    } else if (kind == "cylinder") {
      Bounded(*shape, "radius", 1, false);
      Bounded(*shape, "length", 1, false);
    } else if (kind == "mesh") {
      if (Attribute(*shape, "filename").empty()) Complain(*shape, "mesh filename", "is missing");
      if (shape->Attribute("scale") != nullptr) Bounded(*shape, "scale", 3, false);
    } else {
      Complain(geometry, "geometry",
               "`" + kind + "` is no shape of URDF (valid: box, sphere, cylinder, mesh)");
    }
  }

  void CheckJoint(const TiXmlElement& joint) {
    const std::string name = Name(joint, &places_.joints);
    CheckOrigin(joint);
    const std::string type = Attribute(joint, "type");
    const std::vector<std::string> types = {"revolute", "continuous", "prismatic",
                                            "fixed",    "floating",   "planar"};
    if (std::find(types.begin(), types.end(), type) == types.end()) {
      Complain(joint, name,
               "`" + type +
                   "` is no joint type (valid: revolute, continuous, prismatic, fixed, "
                   "floating, planar)");
    }
    if (const TiXmlElement* axis = joint.FirstChildElement("axis")) {
      const auto xyz = Numbers(*axis, "xyz", 3);
      if (xyz && std::hypot((*xyz)[0], (*xyz)[1], (*xyz)[2]) < 1e-6) {
        Complain(*axis, name, "the axis has no direction: " + Attribute(*axis, "xyz"));
      }
    }
    if (type == "revolute" || type == "prismatic") CheckLimit(joint, name);
    for (const char* end : {"parent", "child"}) {
      const TiXmlElement* element = Required(joint, end);
      if (element != nullptr && !places_.links.contains(Attribute(*element, "link"))) {
        Complain(*element, name,
                 "no link is called `" + Attribute(*element, "link") + "`" +
                     Suggestion(Attribute(*element, "link")));
      }
    }
  }

  std::string Suggestion(const std::string& word) {
    if (++suggestions_ > kMostSuggestions) return "";
    std::vector<std::string> names;
    for (const auto& [name, place] : places_.links) names.push_back(name);
    const std::string nearest = NearestWord(word, names);
    return nearest.empty() ? "" : " (did you mean `" + nearest + "`?)";
  }

  void CheckLimit(const TiXmlElement& joint, const std::string& name) {
    const TiXmlElement* limit = joint.FirstChildElement("limit");
    if (limit == nullptr) {
      Complain(joint, name, "has no <limit>");
      return;
    }
    const auto lower = Numbers(*limit, "lower", 1), upper = Numbers(*limit, "upper", 1);
    if (lower && upper && !((*lower)[0] < (*upper)[0])) {
      Complain(*limit, name,
               "lower " + Attribute(*limit, "lower") + " is not below upper " +
                   Attribute(*limit, "upper"));
    }
    Bounded(*limit, "velocity", 1, false);
    Bounded(*limit, "effort", 1, true);
  }

  // Whether the way up from a link never ends; `known` remembers it of all links on the way.
  static bool LeadsToARing(const std::string& link,
                           const std::map<std::string, std::string>& parent_of,
                           std::map<std::string, bool>* known) {
    std::vector<std::string> way;
    bool ring = false;
    for (std::string at = link;;) {
      const auto [judged, is_new] = known->emplace(at, true);  // true: until it is known better
      if (!is_new) {
        ring = judged->second;
        break;
      }
      way.push_back(at);
      const auto up = parent_of.find(at);
      if (up == parent_of.end()) break;
      at = up->second;
    }
    for (const std::string& passed : way) (*known)[passed] = ring;
    return ring;
  }

  void CheckTree(const TiXmlElement& robot) {
    std::map<std::string, std::string> parent_of;  // by child link
    for (const TiXmlElement* joint : ChildrenOf(robot, "joint")) {
      const TiXmlElement* parent = joint->FirstChildElement("parent");
      const TiXmlElement* child = joint->FirstChildElement("child");
      if (parent == nullptr || child == nullptr) continue;
      const std::string name = Attribute(*child, "link");
      if (!parent_of.emplace(name, Attribute(*parent, "link")).second) {
        Complain(*joint, Attribute(*joint, "name"),
                 "link `" + name + "` hangs on another joint already");
      }
    }
    std::set<std::string> roots;
    std::map<std::string, bool> in_ring;
    for (const TiXmlElement* link : ChildrenOf(robot, "link")) {
      const std::string name = Attribute(*link, "name");
      if (!parent_of.contains(name)) roots.insert(name);
      if (LeadsToARing(name, parent_of, &in_ring)) {
        Complain(*link, name, "hangs on itself through a ring of joints");
      }
    }
    if (roots.empty()) Complain(robot, "robot", "has no root link");
    if (roots.size() > 1) {
      std::string list;
      for (const std::string& root : roots) list += (list.empty() ? "" : ", ") + root;
      Complain(robot, "robot",
               "has " + std::to_string(roots.size()) + " root links (valid: 1): " + list);
    }
  }

  const std::string& file_;
  Complaints* complaints_;
  UrdfPlaces places_;
  int suggestions_ = 0;
};

}  // namespace

UrdfPlaces CheckUrdf(const std::string& text, const std::string& file, Complaints* complaints) {
  if (XmlDepth(text) > kMostXmlLevels) {
    complaints->Add(file, 0, 0, "",
                    "nests too deeply, or its XML declaration is not plain (valid: at most " +
                        std::to_string(kMostXmlLevels) + " levels)");
    return {};
  }
  TiXmlDocument document;
  document.Parse(text.c_str(), nullptr, TIXML_ENCODING_UTF8);
  if (document.Error()) {
    complaints->Add(file, document.ErrorRow(), document.ErrorCol(), "XML", document.ErrorDesc());
    return {};
  }
  if (document.RootElement() == nullptr) {
    complaints->Add(file, 1, 1, "XML", "there is no element in the file");
    return {};
  }
  return Checker(file, complaints).Check(*document.RootElement());
}

}  // namespace halfstep
