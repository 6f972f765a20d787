#include "wpg/robot/urdf_joint.h"

#include "wpg/elementary.h"

namespace halfstep {
namespace {

// What makes a joint move, of which a fixed one has nothing.
void ForgetMotion(TiXmlElement* joint) {
  for (const char* tag : {"axis", "limit"}) {
    for (TiXmlElement* element : ChildrenOf(*joint, tag)) joint->RemoveChild(element);
  }
}

void LimitToATurn(TiXmlElement* joint) {
  joint->SetAttribute("type", "revolute");
  TiXmlElement* limit = joint->FirstChildElement("limit");
  if (limit == nullptr) limit = joint->InsertEndChild(TiXmlElement("limit"))->ToElement();
  limit->SetAttribute("lower", "-3.141592653589793");
  limit->SetAttribute("upper", "3.141592653589793");
}

void CheckAxis(const UrdfElements& elements, const TiXmlElement& joint, const std::string& name) {
  const TiXmlElement* axis = joint.FirstChildElement("axis");
  if (axis == nullptr) return;
  const auto xyz = elements.Numbers(*axis, "xyz", 3);
  if (xyz && Hypot(Hypot((*xyz)[0], (*xyz)[1]), (*xyz)[2]) < 1e-6) {
    elements.Complain(*axis, name, "the axis has no direction: " + AttributeOf(*axis, "xyz"));
  }
}

void CheckRange(const UrdfElements& elements, const TiXmlElement& joint, const std::string& name) {
  const TiXmlElement* limit = joint.FirstChildElement("limit");
  if (limit == nullptr) {
    elements.Complain(joint, name, "has no <limit>");
    return;
  }
  if (limit->Attribute("lower") == nullptr && limit->Attribute("upper") == nullptr) {
    elements.Complain(*limit, name,
                      "has no lower and upper limit (valid: both in its <limit>; or the type "
                      "continuous)");
    return;
  }
  const auto lower = elements.Numbers(*limit, "lower", 1),
             upper = elements.Numbers(*limit, "upper", 1);
  if (lower && upper && !((*lower)[0] < (*upper)[0])) {
    elements.Complain(*limit, name,
                      "lower " + AttributeOf(*limit, "lower") + " is not below upper " +
                          AttributeOf(*limit, "upper"));
  }
}

void CheckSpeed(const UrdfElements& elements, TiXmlElement* joint, const std::string& name) {
  TiXmlElement* limit = joint->FirstChildElement("limit");
  if (limit == nullptr) return;
  const bool is_made = limit->Row() == 0;  // by LimitToATurn
  if (is_made) {
    elements.Complain(*joint, name,
                      "has no limits of speed and torque (valid: <limit velocity=\"…\" "
                      "effort=\"…\"/> in the URDF; effort 0: not known)");
  }
  for (const char* attribute : {"velocity", "effort"}) {
    const bool is_effort = attribute[0] == 'e';
    if (!is_made && elements.Bounded(*limit, attribute, 1, is_effort)) continue;
    limit->SetAttribute(attribute, "0");
  }
}

}  // namespace

std::vector<std::string> RepairMotion(const std::string& file, const std::string& name,
                                      TiXmlElement* joint) {
  const std::string type = AttributeOf(*joint, "type");
  if (type != "revolute" && type != "continuous" && type != "prismatic") {
    ForgetMotion(joint);  // an axis of no direction is usual where nothing turns
    return {};
  }
  Complaints faults;
  const UrdfElements elements(file, &faults);
  CheckAxis(elements, *joint, name);
  if (type == "continuous") {
    LimitToATurn(joint);
  } else {
    CheckRange(elements, *joint, name);
  }
  const bool understood = faults.empty();
  CheckSpeed(elements, joint, name);
  if (const TiXmlElement* mimic = joint->FirstChildElement("mimic")) {
    const std::string other = AttributeOf(*mimic, "joint");
    elements.Complain(*mimic, name, "mimics " + (other.empty() ? "another joint" : other));
  }
  if (!understood) {
    joint->SetAttribute("type", "fixed");
    ForgetMotion(joint);
  }
  return faults.lines();
}

}  // namespace halfstep
