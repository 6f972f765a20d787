#include "wpg/robot/urdf_check.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "wpg/files/nesting.h"
#include "wpg/files/number_text.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/robot/urdf_elements.h"
#include "wpg/robot/urdf_grammar.h"
#include "wpg/robot/urdf_joint.h"
#include "wpg/robot/urdf_links.h"

namespace halfstep {
namespace {

// urdfdom and what reads its tree call themselves at each link of a chain.
constexpr size_t kMostLinks = 5000;
constexpr int kMostSuggestions = 20;  // each is a look at all names
// Tags of xacro that are no calls of macros.
constexpr std::string_view kOwnXacro[] = {
    "xacro:arg",     "xacro:attribute",    "xacro:call",  "xacro:element",  "xacro:if",
    "xacro:include", "xacro:insert_block", "xacro:macro", "xacro:property", "xacro:unless"};

bool IsZero(std::string_view word) {
  const NumberText number = ParseNumber(word);
  return number.kind == NumberText::Kind::kNumber && number.value == 0.0;
}

class Checker {
 public:
  Checker(const std::string& file, Complaints* complaints)
      : file_(file), elements_(file, complaints), warn_(file, &warnings_) {}

  // Repairs the elements on the way.
  UrdfFindings Check(TiXmlElement& robot) {
    if (robot.ValueStr() != "robot") {
      elements_.Complain(robot, robot.ValueStr(), "the top element must be <robot>");
      return std::move(found_);
    }
    if (IsXacro(robot)) return std::move(found_);
    const std::vector<TiXmlElement*> links = ChildrenOf(robot, "link");
    if (links.size() > kMostLinks) {
      elements_.Complain(robot, "robot",
                         "has " + std::to_string(links.size()) + " links (valid: at most " +
                             std::to_string(kMostLinks) + ")");
      return std::move(found_);
    }
    CheckUrdfGrammar(elements_, robot);
    found_.robot = {robot.Row(), robot.Column()};
    for (TiXmlElement* link : links) CheckLink(*link);
    for (TiXmlElement* joint : ChildrenOf(robot, "joint")) CheckJoint(*joint);
    CheckUrdfTree(elements_, warn_, &robot, &found_);
    found_.warnings = warnings_.lines();
    return std::move(found_);
  }

 private:
  // Whether the file waits for xacro: a tag of it, or an attribute with something to be replaced.
  // Looks where links and joints are, deeper where they nest; other extensions are not read.
  // A call of a macro beside links is left out, as urdfdom does: xacro did not know it either.
  bool IsXacro(const TiXmlElement& parent) {
    for (auto* e = parent.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      std::string found = e->ValueStr().starts_with("xacro:") ? e->ValueStr() : "";
      if (!found.empty() && std::ranges::find(kOwnXacro, found) == std::end(kOwnXacro) &&
          parent.FirstChildElement("link") != nullptr) {
        warn_.Complain(*e, found, "calls a macro of xacro that was not expanded: it is left out");
        found.clear();
      }
      for (auto* a = e->FirstAttribute(); a != nullptr && found.empty(); a = a->Next()) {
        const bool replaced = a->ValueStr().find("${") != std::string::npos ||
                              a->ValueStr().find("$(") != std::string::npos;
        if (replaced) found = "`" + a->ValueStr() + "`";
      }
      if (!found.empty()) {
        elements_.Complain(*e, found,
                           "is xacro, which has to be expanded (`xacro FILE > robot.urdf`)");
        return true;
      }
      static constexpr std::string_view kRead[] = {"link",   "joint", "visual",   "collision",
                                                   "origin", "limit", "inertial", "geometry"};
      if (std::ranges::find(kRead, e->ValueStr()) != std::end(kRead) && IsXacro(*e)) return true;
    }
    return false;
  }

  // Registers a name; complains when it is empty, unfit or taken.
  std::string Name(const TiXmlElement& element, std::map<std::string, UrdfPlace>* places) {
    const std::string name = AttributeOf(element, "name");
    const std::string mistake = NameMistake(name);
    if (name.empty()) elements_.Complain(element, element.ValueStr() + " name", "is missing");
    if (!mistake.empty()) elements_.Complain(element, element.ValueStr() + " name", mistake);
    if (!places->emplace(name, UrdfPlace{element.Row(), element.Column()}).second) {
      elements_.Complain(element, name, "a second " + element.ValueStr() + " of this name");
    }
    return name;
  }

  void CheckLink(TiXmlElement& link) {
    const std::string name = Name(link, &found_.links);
    if (TiXmlElement* inertial = link.FirstChildElement("inertial")) {
      elements_.CheckOrigin(*inertial);
      if (auto* mass = elements_.Required(*inertial, "mass")) {
        if (const auto value = elements_.Bounded(*mass, "value", 1, true)) {
          found_.masses[name] = value->front();
        }
      }
      CheckInertia(name, inertial);
    }
    std::vector<TiXmlElement*> points;
    for (TiXmlElement* shape : ChildrenOf(link, "collision")) {
      elements_.CheckOrigin(*shape);
      TiXmlElement* geometry = elements_.Required(*shape, "geometry");
      if (geometry != nullptr && !CheckGeometry(*geometry)) {
        points.push_back(shape);
      } else {
        found_.collisions[name].push_back({shape->Row(), shape->Column()});
      }
    }
    if (points.empty()) return;
    warn_.Complain(*points.front(), name,
                   points.size() == 1 ? "a collision shape without size is left out"
                                      : std::to_string(points.size()) +
                                            " collision shapes without size are left out");
    for (TiXmlElement* shape : points) link.RemoveChild(shape);
  }

  // What is missing or negative is repaired: what the whole robot's dynamics makes of it is told
  // where masses are added up.
  void CheckInertia(const std::string& link, TiXmlElement* inertial) {
    TiXmlElement* inertia = inertial->FirstChildElement("inertia");
    const bool is_given = inertia != nullptr;
    if (!is_given) {
      warn_.Complain(*inertial, link, "has no <inertia>: it is taken as 0");
      inertia = inertial->InsertEndChild(TiXmlElement("inertia"))->ToElement();
    }
    for (const char* attribute : {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}) {
      const bool is_there = inertia->Attribute(attribute) != nullptr;
      const bool is_moment = attribute[1] == attribute[2];
      if (is_there) {
        const auto value = elements_.Numbers(*inertia, attribute, 1);
        if (!value || !(is_moment && value->front() < 0.0)) continue;
      }
      if (is_given) {
        warn_.Complain(*inertia, link,
                       std::string(attribute) +
                           (is_there ? " " + AttributeOf(*inertia, attribute) + " is negative"
                                     : " is missing") +
                           ": it is taken as 0");
      }
      inertia->SetAttribute(attribute, "0");
    }
  }

  // False for a shape that has no size at all.
  bool CheckGeometry(TiXmlElement& geometry) {
    const TiXmlElement* shape = geometry.FirstChildElement();
    const std::string kind = shape == nullptr ? "" : shape->ValueStr();
    if (kind == "box") return HasSize(*shape, {{"size", 3}});
    if (kind == "sphere") return HasSize(*shape, {{"radius", 1}});
    if (kind == "cylinder") return HasSize(*shape, {{"radius", 1}, {"length", 1}});
    if (kind == "mesh") {
      if (AttributeOf(*shape, "filename").empty()) {
        elements_.Complain(*shape, "mesh filename", "is missing");
      }
      CheckScale(*shape);
    } else {
      elements_.Complain(
          geometry, "geometry",
          "`" + kind + "` is no shape of URDF (valid: box, sphere, cylinder, mesh" +
              (kind == "capsule" ? "; a capsule is a <collision> with its cylinder and two with "
                                   "the spheres at its ends)"
                                 : ")"));
    }
    return true;
  }

  // Complains about a shape that has a size in some directions only, and about what is no number.
  bool HasSize(const TiXmlElement& shape,
               const std::vector<std::pair<const char*, size_t>>& attributes) {
    bool is_point = true;
    for (const auto& [attribute, count] : attributes) {
      const std::string text = AttributeOf(shape, attribute);
      const std::vector<std::string_view> words = XmlWords(text);
      is_point = is_point && words.size() == count && std::ranges::all_of(words, IsZero);
    }
    if (is_point) return false;
    for (const auto& [attribute, count] : attributes) {
      (void)elements_.Bounded(shape, attribute, count, false);
    }
    return true;
  }

  // A negative scale mirrors the mesh, which is as good as any.
  void CheckScale(const TiXmlElement& mesh) {
    if (mesh.Attribute("scale") == nullptr) return;
    const auto scale = elements_.Numbers(mesh, "scale", 3);
    if (scale && std::ranges::find(*scale, 0.0) != scale->end()) {
      elements_.Complain(mesh, "mesh scale",
                         AttributeOf(mesh, "scale") + " flattens the mesh (valid: not 0)");
    }
  }

  void CheckJoint(TiXmlElement& joint) {
    const std::string name = Name(joint, &found_.joints);
    elements_.CheckOrigin(joint);
    const std::string type = AttributeOf(joint, "type");
    const std::vector<std::string> types = {"revolute", "continuous", "prismatic",
                                            "fixed",    "floating",   "planar"};
    if (std::find(types.begin(), types.end(), type) == types.end()) {
      elements_.Complain(joint, name,
                         "`" + type +
                             "` is no joint type (valid: revolute, continuous, prismatic, fixed, "
                             "floating, planar)");
    }
    if (const TiXmlElement* mimic = joint.FirstChildElement("mimic")) {
      found_.mimics[name] = AttributeOf(*mimic, "joint");
    }
    if (AttributeOf(joint, "type") == "continuous") found_.continuous.insert(name);
    if (auto faults = RepairMotion(file_, name, &joint); !faults.empty()) {
      found_.joint_faults[name] = std::move(faults);
    }
    for (const char* end : {"parent", "child"}) {
      const TiXmlElement* element = elements_.Required(joint, end);
      if (element != nullptr && !found_.links.contains(AttributeOf(*element, "link"))) {
        elements_.Complain(*element, name,
                           "no link is called `" + AttributeOf(*element, "link") + "`" +
                               NearestLinks(AttributeOf(*element, "link")));
      }
    }
  }

  std::string NearestLinks(const std::string& word) {
    if (++suggestions_ > kMostSuggestions) return "";
    std::vector<std::string> names;
    for (const auto& [name, place] : found_.links) names.push_back(name);
    return Suggestion(word, names);
  }

  const std::string& file_;
  Complaints warnings_;
  UrdfElements elements_, warn_;
  UrdfFindings found_;
  int suggestions_ = 0;
};

}  // namespace

UrdfFindings CheckUrdf(const std::string& text, const std::string& file, Complaints* complaints) {
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
  TiXmlElement& robot = *document.RootElement();
  if (const TiXmlElement* second = robot.NextSiblingElement()) {
    complaints->Add(file, second->Row(), second->Column(), second->ValueStr(),
                    "a second top element (valid: one)");
  }
  const bool was_empty = complaints->empty();
  UrdfFindings found = Checker(file, complaints).Check(robot);
  if (was_empty && complaints->empty()) found.text = PlainUrdf(robot);
  return found;
}

}  // namespace halfstep
