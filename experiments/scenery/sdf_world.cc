#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "experiments/scenery/scenery_readers.h"
#include "experiments/scenery/scenery_shapes.h"
#include "experiments/scenery/scenery_xml.h"
#include "wpg/files/input_error.h"
#include "wpg/files/regular_file.h"
#include "wpg/files/text.h"
#include "wpg/geometry/rotation.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using Eigen::Isometry3d;
using Elements = SceneryElements;

constexpr std::uint64_t kMostSdfBytes = std::uint64_t{16} << 20;
constexpr int kMostIncludes = 16;     // one within the other
constexpr int kMostModels = 100'000;  // included ones count again and again
constexpr double kDegree = std::numbers::pi / 180;

// A file, kept while elements of it are read.
struct SdfFile {
  std::string path;
  TiXmlDocument document;
};

class SdfReader {
 public:
  explicit SdfReader(const SceneryRequest& request) : request_(request) {}

  Scenery Read(const std::string& path, const std::string& text) {
    auto file = std::make_unique<SdfFile>();
    file->path = path;
    ParseSceneryXml(path, text, &file->document);
    const SceneryElements xml(file->path);
    const TiXmlElement& root = *file->document.RootElement();
    const TiXmlElement* const world = root.FirstChildElement("world");
    const TiXmlElement& place = world != nullptr ? *world : root;
    if (world != nullptr) ReadState(xml, *world);
    ReadPlace(xml, place, Isometry3d::Identity(), 0);
    if (world != nullptr && world->NextSiblingElement("world") != nullptr) {
      scenery_.Tell("of several worlds the first one is taken");
    }
    return std::move(scenery_);
  }

 private:
  // What stands in a world, in a model or at the top of a file.
  void ReadPlace(const SceneryElements& xml, const TiXmlElement& place, const Isometry3d& X,
                 int includes) {
    for (auto* e = place.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      const std::string& tag = e->ValueStr();
      if (tag == "model") {
        ReadModel(xml, *e, X, {}, includes);
      } else if (tag == "include") {
        ReadInclude(xml, *e, X, includes);
      } else if (tag == "actor" || tag == "light" || tag == "road" || tag == "population" ||
                 tag == "plugin") {
        scenery_.Tell(tag + " " + Quote(Elements::AttributeText(*e, "name")) + " is left out");
      }
    }
  }

  // Saved worlds say last where their models are.
  void ReadState(const SceneryElements& xml, const TiXmlElement& world) {
    const TiXmlElement* const state = world.FirstChildElement("state");
    if (state == nullptr) return;
    for (auto* e = state->FirstChildElement("model"); e != nullptr;
         e = e->NextSiblingElement("model")) {
      if (e->FirstChildElement("pose") == nullptr) continue;
      states_.emplace(Elements::AttributeText(*e, "name"), Pose(xml, *e));
    }
    if (!states_.empty()) scenery_.Tell("models stand where the world's <state> has them");
  }

  Isometry3d Pose(const SceneryElements& xml, const TiXmlElement& of) const {
    Isometry3d X = Isometry3d::Identity();
    const TiXmlElement* const pose = of.FirstChildElement("pose");
    const std::string text = Elements::TextOf(of, "pose");
    if (pose == nullptr || text.empty()) return X;
    if (Elements::AttributeText(*pose, "rotation_format") == "quat_xyzw") {
      const Eigen::VectorXd n = xml.Numbers(*pose, text, 7);
      const auto turned = PoseOf(n.head<3>(), n.tail<4>());
      if (!turned) xml.Fail(*pose, kNoTurn);
      return *turned;
    }
    const Eigen::VectorXd n = xml.Numbers(*pose, text, 6);
    const std::string degrees = Elements::AttributeText(*pose, "degrees");
    const double unit = degrees == "true" || degrees == "1" ? kDegree : 1.0;
    X.translation() = n.head<3>();
    X.linear() = RollPitchYaw(unit * n[3], unit * n[4], unit * n[5]);
    return X;
  }

  // What a pose of a link or frame is relative to: "" the model.
  static std::string RelativeTo(const TiXmlElement& of) {
    const TiXmlElement* const pose = of.FirstChildElement("pose");
    if (pose == nullptr) return "";
    std::string frame = Elements::AttributeText(*pose, "relative_to");
    if (frame.empty()) frame = Elements::AttributeText(*pose, "frame");
    return frame == "__model__" || frame == "world" ? "" : frame;
  }

  // In the model, by way of the frames that it names.
  Isometry3d PoseInModel(const SceneryElements& xml, const TiXmlElement& model,
                         const TiXmlElement& of, std::set<const TiXmlElement*>* open) const {
    if (!open->insert(&of).second) xml.Fail(of, "its frames are a circle");
    Isometry3d X = Pose(xml, of);
    std::string frame = RelativeTo(of);
    if (frame.empty() && of.ValueStr() == "frame") {
      frame = Elements::AttributeText(of, "attached_to");
      if (frame == "__model__" || frame == "world") frame.clear();
    }
    if (frame.empty()) return X;
    for (auto* e = model.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      const bool has_pose = e->ValueStr() == "link" || e->ValueStr() == "frame" ||
                            e->ValueStr() == "model" || e->ValueStr() == "joint";
      if (!has_pose || Elements::AttributeText(*e, "name") != frame) continue;
      if (e->ValueStr() == "joint" && RelativeTo(*e).empty()) {
        xml.Fail(of, "its pose is relative to a joint, which is not understood");
      }
      return PoseInModel(xml, model, *e, open) * X;
    }
    xml.Fail(of, "its pose is relative to " + Quote(frame) + ", which its model has not");
  }

  // What an include says of its model.
  struct Included {
    std::string name;             // "": the model's own
    std::optional<Isometry3d> X;  // none: the model's own
  };

  void ReadModel(const SceneryElements& xml, const TiXmlElement& model, const Isometry3d& X_WPlace,
                 const Included& as, int includes) {
    if (++models_ > kMostModels) xml.Fail(model, "too many models (valid: at most 100,000)");
    const std::string name = as.name.empty() ? Elements::AttributeText(model, "name") : as.name;
    if (request_.LeavesOut(name)) return scenery_.Tell(name + ": left out by --without");
    Isometry3d X_WM = X_WPlace * (as.X ? *as.X : Pose(xml, model));
    const auto state = states_.find(name);
    if (state != states_.end() && X_WPlace.matrix().isIdentity(0.0)) X_WM = state->second;
    for (auto* e = model.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      const std::string& tag = e->ValueStr();
      std::set<const TiXmlElement*> open;
      if (tag == "link") {
        ReadLink(xml, *e, name, X_WM * PoseInModel(xml, model, *e, &open));
      } else if (tag == "model") {
        ReadModel(xml, *e, X_WM, {}, includes);
      } else if (tag == "include") {
        ReadInclude(xml, *e, X_WM, includes);
      } else if (tag == "plugin") {
        scenery_.Tell("plugins of models are left out");
      } else if (tag == "joint" && Elements::AttributeText(*e, "type") != "fixed") {
        scenery_.Tell("joints of models are held where their poses have them");
      }
    }
  }

  void ReadLink(const SceneryElements& xml, const TiXmlElement& link, const std::string& model,
                const Isometry3d& X_WL) {
    bool any = false;
    for (auto* e = link.FirstChildElement("collision"); e != nullptr;
         e = e->NextSiblingElement("collision")) {
      any = true;
      const TiXmlElement* const geometry = e->FirstChildElement("geometry");
      const TiXmlElement* const shape =
          geometry == nullptr ? nullptr : geometry->FirstChildElement();
      if (shape == nullptr || shape->ValueStr() == "empty") continue;
      if (scenery_.things.size() == kMostThings) xml.Fail(*e, kTooManyThings);
      SceneryThing thing{.name = model, .shape = {}, .X_WO = X_WL * Pose(xml, *e)};
      if (ReadShape(xml, *shape, &thing)) scenery_.things.push_back(std::move(thing));
    }
    if (!any && link.FirstChildElement("visual") != nullptr) {
      scenery_.Tell(model + ": " + Quote(Elements::AttributeText(link, "name")) +
                    " is only to be looked at (no collision), and left out");
    }
  }

  bool ReadShape(const SceneryElements& xml, const TiXmlElement& shape, SceneryThing* thing) {
    const auto text_of = [&](const char* name) { return Elements::TextOf(shape, name); };
    const auto size = [&](const char* name) { return xml.Size(shape, text_of(name)); };
    if (xml.TakeSolid(shape, text_of, thing)) return true;
    const std::string& kind = shape.ValueStr();
    if (kind == "cone") {
      thing->shape = ConeMesh(size("radius"), size("length"));
      scenery_.Tell(kConesTold);
    } else if (kind == "plane") {
      const std::string text = Elements::TextOf(shape, "normal");
      const Eigen::Vector3d normal =
          text.empty() ? Eigen::VectorXd(Eigen::Vector3d::UnitZ()) : xml.Numbers(shape, text, 3);
      if (!(normal.norm() > 1e-9)) xml.Fail(shape, "a plane without a normal");
      thing->shape = EndlessPlane{normal.normalized()};
    } else if (kind == "mesh") {
      const std::string text = Elements::TextOf(shape, "scale");
      const Eigen::Vector3d scale =
          text.empty() ? Eigen::VectorXd(Eigen::Vector3d::Ones()) : xml.Numbers(shape, text, 3);
      if (shape.FirstChildElement("submesh") != nullptr) {
        scenery_.Tell(thing->name + ": of a <submesh> the whole mesh is taken");
      }
      xml.TakeMesh(shape, Elements::TextOf(shape, "uri"), scale, request_.places, thing);
    } else if (kind == "heightmap" || kind == "image" || kind == "polyline" ||
               kind == "ellipsoid") {
      scenery_.Tell(thing->name + ": a " + kind +
                    " is left out: what it stands for has to be added by hand");
      return false;
    } else {
      xml.Fail(shape, "is no shape (valid: box, sphere, cylinder, capsule, cone, plane, mesh)");
    }
    return true;
  }

  void ReadInclude(const SceneryElements& xml, const TiXmlElement& include, const Isometry3d& X,
                   int includes) {
    const std::string uri = Elements::TextOf(include, "uri");
    std::string name = Elements::TextOf(include, "name");
    if (name.empty()) name = uri.substr(uri.find_last_of('/') + 1);
    if (request_.LeavesOut(name)) return scenery_.Tell(name + ": left out by --without");
    if (uri == "model://sun") return scenery_.Tell("sun is a light, and left out");
    if (includes >= kMostIncludes) xml.Fail(include, "includes nest too deeply (valid: 16)");
    const SdfFile* file = nullptr;
    try {
      file = &FileOf(ModelFile(request_.places.Find(uri, xml.path())));
    } catch (const InputError&) {
      throw;
    } catch (const std::runtime_error& error) {
      if (uri != "model://ground_plane") xml.Fail(include, error.what());
      scenery_.things.push_back(
          {.name = name, .shape = EndlessPlane{}, .X_WO = X * Pose(xml, include)});
      return;
    }
    const SceneryElements within(file->path);
    const TiXmlElement& root = *file->document.RootElement();
    const TiXmlElement* const model = root.FirstChildElement("model");
    if (model == nullptr && root.FirstChildElement("light") != nullptr) {
      return scenery_.Tell(name + " is a light, and left out");
    }
    if (model == nullptr) within.Fail(root, "has no <model>");
    Included as{.name = Elements::TextOf(include, "name"), .X = std::nullopt};
    if (include.FirstChildElement("pose") != nullptr) as.X = Pose(xml, include);
    ReadModel(within, *model, X, as, includes + 1);
  }

  // Of a model's folder the file that its model.config names, the newest one; else model.sdf.
  static fs::path ModelFile(const fs::path& place) {
    std::error_code ignored;
    if (!fs::is_directory(place, ignored)) return place;
    if (!fs::is_regular_file(place / "model.config", ignored)) return place / "model.sdf";
    const std::string config = (place / "model.config").string();
    TiXmlDocument document;
    ParseSceneryXml(config, ReadRegularFile(config, kMostSdfBytes), &document);
    fs::path found = place / "model.sdf";
    std::string newest;
    for (auto* e = document.RootElement()->FirstChildElement("sdf"); e != nullptr;
         e = e->NextSiblingElement("sdf")) {
      const char* const text = e->GetText();
      const std::string version = Elements::AttributeText(*e, "version");
      if (text == nullptr || version < newest) continue;
      newest = version;
      found = place / text;
    }
    return found;
  }

  const SdfFile& FileOf(const fs::path& path) {
    std::unique_ptr<SdfFile>& file = files_[path.string()];
    if (file == nullptr) {
      auto read = std::make_unique<SdfFile>();
      read->path = path.string();
      ParseSceneryXml(read->path, ReadRegularFile(read->path, kMostSdfBytes), &read->document);
      file = std::move(read);
    }
    return *file;
  }

  const SceneryRequest& request_;
  std::map<std::string, std::unique_ptr<SdfFile>> files_;
  std::map<std::string, Isometry3d> states_;
  int models_ = 0;
  Scenery scenery_;
};

}  // namespace

Scenery ReadSdfScenery(const std::string& path, const std::string& text,
                       const SceneryRequest& request) {
  return SdfReader(request).Read(path, text);
}

}  // namespace halfstep
