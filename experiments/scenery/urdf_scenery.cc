#include <map>
#include <utility>
#include <vector>

#include "experiments/scenery/scenery_readers.h"
#include "experiments/scenery/scenery_shapes.h"
#include "experiments/scenery/scenery_xml.h"
#include "wpg/files/text.h"
#include "wpg/geometry/rotation.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Elements = SceneryElements;

class UrdfEnvironment {
 public:
  UrdfEnvironment(const std::string& path, const SceneryRequest& request)
      : xml_(path), request_(request) {}

  Scenery Read(const TiXmlElement& robot) {
    ReadLinks(robot);
    ReadJoints(robot);
    for (const auto& [name, link] : links_) {
      if (request_.LeavesOut(name)) {
        scenery_.Tell(name + ": left out by --without");
        continue;
      }
      ReadLink(name, *link.element, PoseOfLink(name));
    }
    return std::move(scenery_);
  }

 private:
  struct Link {
    const TiXmlElement* element = nullptr;
    const TiXmlElement* joint = nullptr;  // the joint that it hangs on
    std::string parent;
  };

  void ReadLinks(const TiXmlElement& robot) {
    for (auto* e = robot.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      if (e->ValueStr().starts_with("xacro:")) {
        xml_.Fail(*e, "xacro is not expanded here (`xacro FILE > robot.urdf` does it)");
      }
    }
    for (auto* e = robot.FirstChildElement("link"); e != nullptr;
         e = e->NextSiblingElement("link")) {
      const std::string name = Elements::AttributeText(*e, "name");
      if (name.empty()) xml_.Fail(*e, "has no name");
      if (!links_.try_emplace(name, Link{e, nullptr, ""}).second) {
        xml_.Fail(*e, Quote(name) + " is there twice");
      }
    }
    if (links_.empty()) xml_.Fail(robot, "has no <link>");
  }

  const std::string LinkOf(const TiXmlElement& joint, const char* child) const {
    const TiXmlElement* const named = joint.FirstChildElement(child);
    const std::string link = named == nullptr ? "" : Elements::AttributeText(*named, "link");
    if (!links_.contains(link)) {
      xml_.Fail(joint, std::string(child) + " " + Quote(link) + " is no link of this file");
    }
    return link;
  }

  void ReadJoints(const TiXmlElement& robot) {
    int moving = 0;
    for (auto* e = robot.FirstChildElement("joint"); e != nullptr;
         e = e->NextSiblingElement("joint")) {
      Link& child = links_.at(LinkOf(*e, "child"));
      if (child.joint != nullptr) xml_.Fail(*e, "its child hangs on another joint, too");
      child.joint = e;
      child.parent = LinkOf(*e, "parent");
      if (Elements::AttributeText(*e, "type") != "fixed") ++moving;
    }
    if (moving > 0) {
      scenery_.Tell(Formatted("joints that move are held at zero: %d", moving));
    }
  }

  Isometry3d Origin(const TiXmlElement& parent) const {
    Isometry3d X = Isometry3d::Identity();
    const TiXmlElement* const origin = parent.FirstChildElement("origin");
    if (origin == nullptr) return X;
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(3);
    const Eigen::VectorXd rpy = xml_.Attribute(*origin, "rpy", zero);
    X.translation() = xml_.Attribute(*origin, "xyz", zero);
    X.linear() = RollPitchYaw(rpy[0], rpy[1], rpy[2]);
    return X;
  }

  Isometry3d PoseOfLink(const std::string& name) const {
    Isometry3d X = Isometry3d::Identity();
    const Link* link = &links_.at(name);
    for (size_t steps = 0; link->joint != nullptr; ++steps) {
      if (steps > links_.size()) xml_.Fail(*link->joint, "is part of a circle");
      X = Origin(*link->joint) * X;
      link = &links_.at(link->parent);
    }
    return X;
  }

  void ReadLink(const std::string& name, const TiXmlElement& link, const Isometry3d& X_WLink) {
    const bool has_collision = link.FirstChildElement("collision") != nullptr;
    const char* const tag = has_collision ? "collision" : "visual";
    for (auto* e = link.FirstChildElement(tag); e != nullptr; e = e->NextSiblingElement(tag)) {
      if (!has_collision) {
        scenery_.Tell(name + ": has no collision shape; its visual one is taken");
      }
      const TiXmlElement* const geometry = e->FirstChildElement("geometry");
      const TiXmlElement* const shape =
          geometry == nullptr ? nullptr : geometry->FirstChildElement();
      if (shape == nullptr) {
        scenery_.Tell(name + ": a " + tag + " without geometry is left out");
        continue;
      }
      if (scenery_.things.size() == kMostThings) xml_.Fail(*e, kTooManyThings);
      SceneryThing thing{.name = name, .shape = {}, .X_WO = X_WLink * Origin(*e)};
      ReadShape(*shape, &thing);
      scenery_.things.push_back(std::move(thing));
    }
  }

  void ReadShape(const TiXmlElement& shape, SceneryThing* thing) const {
    const auto text_of = [&](const char* name) { return Elements::AttributeText(shape, name); };
    if (xml_.TakeSolid(shape, text_of, thing)) return;
    if (shape.ValueStr() == "mesh") {
      const Eigen::Vector3d scale = xml_.Attribute(shape, "scale", Eigen::VectorXd::Ones(3));
      xml_.TakeMesh(shape, Elements::AttributeText(shape, "filename"), scale, request_.places,
                    thing);
    } else {
      xml_.Fail(shape, "is no shape (valid: box, sphere, cylinder, capsule, mesh)");
    }
  }

  SceneryElements xml_;
  const SceneryRequest& request_;
  std::map<std::string, Link> links_;
  Scenery scenery_;
};

}  // namespace

Scenery ReadUrdfScenery(const std::string& path, const std::string& text,
                        const SceneryRequest& request) {
  TiXmlDocument document;
  ParseSceneryXml(path, text, &document);
  return UrdfEnvironment(path, request).Read(*document.RootElement());
}

}  // namespace halfstep
