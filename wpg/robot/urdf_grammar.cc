#include "wpg/robot/urdf_grammar.h"

#include <algorithm>
#include <vector>

#include "wpg/files/number_text.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

struct Attribute {
  const char* name;
  bool numbers = true;
};

// An element that is read. Everything else in its parent is left out.
struct Element {
  const char* tag;
  std::vector<Attribute> attributes;
  std::vector<Element> children = {};
  bool many = false;      // else a second one in the same parent is a mistake
  bool is_whole = false;  // has no other attributes: one that nobody reads would move something
  bool one_child = false;
  std::vector<const char*> others = {};  // tags of URDF that no walk needs
};

Element Origin() { return {.tag = "origin", .attributes = {{"xyz"}, {"rpy"}}, .is_whole = true}; }

Element Geometry() {
  return {.tag = "geometry",
          .attributes = {},
          .children =
              {{.tag = "box", .attributes = {{"size"}}, .is_whole = true},
               {.tag = "sphere", .attributes = {{"radius"}}, .is_whole = true},
               {.tag = "cylinder", .attributes = {{"radius"}, {"length"}}, .is_whole = true},
               {.tag = "mesh", .attributes = {{"filename", false}, {"scale"}}, .is_whole = true}},
          .one_child = true};
}

Element Inertial() {
  return {.tag = "inertial",
          .attributes = {},
          .children = {Origin(),
                       {.tag = "mass", .attributes = {{"value"}}},
                       {.tag = "inertia",
                        .attributes = {{"ixx"}, {"ixy"}, {"ixz"}, {"iyy"}, {"iyz"}, {"izz"}}}}};
}

Element Link() {
  return {.tag = "link",
          .attributes = {{"name", false}},
          .children = {Inertial(),
                       {.tag = "collision",
                        .attributes = {},
                        .children = {Origin(), Geometry()},
                        .many = true}},
          .many = true,
          .others = {"visual"}};
}

Element Joint() {
  return {.tag = "joint",
          .attributes = {{"name", false}, {"type", false}},
          .children = {Origin(),
                       {.tag = "parent", .attributes = {{"link", false}}},
                       {.tag = "child", .attributes = {{"link", false}}},
                       {.tag = "axis", .attributes = {{"xyz"}}},
                       {.tag = "limit",
                        .attributes = {{"lower"}, {"upper"}, {"effort"}, {"velocity"}}}},
          .many = true,
          .others = {"mimic", "dynamics", "calibration", "safety_controller"}};
}

const Element& Robot() {
  static const Element robot = {
      .tag = "robot",
      .attributes = {{"name", false}, {"version", false}},
      .children = {Link(), Joint()},
      .others = {"material", "transmission", "gazebo", "sensor", "group", "force_sensor"}};
  return robot;
}

const Element* Find(const Element& parent, const std::string& tag) {
  const auto found = std::ranges::find_if(
      parent.children, [&tag](const Element& child) { return child.tag == tag; });
  return found == parent.children.end() ? nullptr : &*found;
}

std::string Lower(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return text;
}

// Says so when a tag that nobody reads is nearly one that is read.
void CheckTag(const UrdfElements& elements, const TiXmlElement& child, const Element& parent) {
  const std::string tag = child.ValueStr();
  std::vector<std::string> known(parent.others.begin(), parent.others.end());
  if (std::ranges::find(known, tag) != known.end()) return;
  for (const Element& read : parent.children) known.emplace_back(read.tag);
  const std::string meant = NearestWord(Lower(tag), known);
  if (Find(parent, meant) == nullptr) return;
  elements.Complain(child, tag, "is no element of URDF (did you mean <" + meant + ">?)");
}

void CheckAttributes(const UrdfElements& elements, const TiXmlElement& at, const Element& read) {
  if (!read.is_whole) return;
  std::vector<std::string> known;
  for (const Attribute& attribute : read.attributes) known.emplace_back(attribute.name);
  for (auto* a = at.FirstAttribute(); a != nullptr; a = a->Next()) {
    if (std::ranges::find(known, a->Name()) != known.end()) continue;
    std::string valid;
    for (const std::string& name : known) valid += (valid.empty() ? "" : ", ") + name;
    elements.Complain(at, at.ValueStr() + " " + a->Name(),
                      "is read by nobody, and might move something (valid: " + valid + ")");
  }
}

// Elements of other programs, such as <drake:declare_convex/>, say nothing of URDF.
bool IsForeign(const TiXmlElement& child) {
  return child.ValueStr().find(':') != std::string::npos;
}

void CheckElement(const UrdfElements& elements, TiXmlElement& at, const Element& read) {
  CheckAttributes(elements, at, read);
  std::vector<const Element*> seen;
  int own = 0;  // children
  for (auto* child = at.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    if (IsForeign(*child)) continue;
    const Element* const known = Find(read, child->ValueStr());
    if (known == nullptr) CheckTag(elements, *child, read);
    const bool again = std::ranges::find(seen, known) != seen.end();
    if (read.one_child && own++ > 0) {
      elements.Complain(*child, child->ValueStr(),
                        "a second shape in one <" + at.ValueStr() +
                            "> (valid: one; another one has a <collision> of its own)");
    } else if (known != nullptr && again && !known->many) {
      elements.Complain(*child, child->ValueStr(),
                        "a second one in this <" + at.ValueStr() + "> (valid: one)");
    }
    if (known == nullptr) continue;
    seen.push_back(known);
    CheckElement(elements, *child, *known);
  }
}

std::string PlainNumbers(const std::string& text) {
  std::string plain;
  for (const std::string_view word : XmlWords(text)) {
    if (!plain.empty()) plain += ' ';
    plain += ShortestText(ParseNumber(word).value);
  }
  return plain;
}

TiXmlElement Plain(TiXmlElement& at, const Element& read) {
  TiXmlElement plain(at.ValueStr());
  for (const Attribute& attribute : read.attributes) {
    if (at.Attribute(attribute.name) == nullptr) continue;
    const std::string text = AttributeOf(at, attribute.name);
    plain.SetAttribute(attribute.name, attribute.numbers ? PlainNumbers(text) : text);
  }
  for (auto* child = at.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    const Element* const known = Find(read, child->ValueStr());
    if (known != nullptr) plain.InsertEndChild(Plain(*child, *known));
  }
  return plain;
}

}  // namespace

void CheckUrdfGrammar(const UrdfElements& elements, TiXmlElement& robot) {
  CheckElement(elements, robot, Robot());
}

std::string PlainUrdf(TiXmlElement& robot) {
  const TiXmlElement plain = Plain(robot, Robot());
  TiXmlPrinter printer;
  printer.SetStreamPrinting();
  plain.Accept(&printer);
  return printer.Str();
}

}  // namespace halfstep
