#include "wpg/robot/urdf_links.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace halfstep {
namespace {

// Whether the way up from a link never ends; `known` remembers it of all links on the way.
bool LeadsToARing(const std::string& link, const std::map<std::string, std::string>& parent_of,
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

void LeaveOutStrayLinks(const std::map<std::string, std::string>& parent_of,
                        const std::set<std::string>& parents, const UrdfElements& warn,
                        TiXmlElement* robot, UrdfFindings* found) {
  for (TiXmlElement* link : ChildrenOf(*robot, "link")) {
    const std::string name = AttributeOf(*link, "name");
    if (parent_of.contains(name) || parents.contains(name)) continue;
    warn.Complain(*link, name, "hangs on nothing, and nothing on it: it is left out");
    found->links.erase(name);
    robot->RemoveChild(link);
  }
}

}  // namespace

void CheckUrdfTree(const UrdfElements& elements, const UrdfElements& warn, TiXmlElement* robot,
                   UrdfFindings* found) {
  std::map<std::string, std::string> parent_of;  // by child link
  for (const TiXmlElement* joint : ChildrenOf(*robot, "joint")) {
    const TiXmlElement* parent = joint->FirstChildElement("parent");
    const TiXmlElement* child = joint->FirstChildElement("child");
    if (parent == nullptr || child == nullptr) continue;
    const std::string name = AttributeOf(*child, "link");
    if (!parent_of.emplace(name, AttributeOf(*parent, "link")).second) {
      elements.Complain(*joint, AttributeOf(*joint, "name"),
                        "link `" + name + "` hangs on another joint already");
    }
  }
  std::set<std::string> roots, parents;
  for (const auto& [child, parent] : parent_of) parents.insert(parent);
  if (!parents.empty()) LeaveOutStrayLinks(parent_of, parents, warn, robot, found);
  std::map<std::string, bool> in_ring;
  for (const TiXmlElement* link : ChildrenOf(*robot, "link")) {
    const std::string name = AttributeOf(*link, "name");
    if (!parent_of.contains(name)) roots.insert(name);
    if (LeadsToARing(name, parent_of, &in_ring)) {
      elements.Complain(*link, name, "hangs on itself through a ring of joints");
    }
  }
  if (roots.empty()) elements.Complain(*robot, "robot", "has no root link");
  if (roots.size() > 1) {
    std::string list;
    for (const std::string& root : roots) list += (list.empty() ? "" : ", ") + root;
    elements.Complain(*robot, "robot",
                      "has " + std::to_string(roots.size()) + " root links (valid: 1): " + list);
  }
}

}  // namespace halfstep
