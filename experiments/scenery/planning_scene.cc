#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "experiments/scenery/scenery_readers.h"
#include "experiments/scenery/scenery_shapes.h"
#include "wpg/files/mesh_text.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"
#include "wpg/files/yaml_node.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Kind = YamlNode::Kind;

constexpr YamlLimits kPlanningSceneLimits{.bytes = std::size_t{64} << 20, .values = 5'000'000};

class PlanningSceneReader {
 public:
  PlanningSceneReader(const std::string& path, const SceneryRequest& request)
      : path_(path), request_(request), complaints_(path) {}

  Scenery Read(const std::string& text) {
    const YamlNode root = ParseYaml(text, "", &complaints_, kPlanningSceneLimits);
    complaints_.ThrowIfAny();
    if (root.kind != Kind::kMap) Fail(root, "", "is no map (valid: a planning scene)");
    if (root.Find("obstacles") != nullptr) {
      Fail(*root.Find("obstacles"), "obstacles", "this is a scene file already");
    }
    const YamlNode* inner = root.Find("planning_scene");
    const YamlNode& scene = inner != nullptr ? *inner : root;
    const YamlNode* world = scene.Find("world");
    const YamlNode* objects = (world != nullptr ? *world : scene).Find("collision_objects");
    if (objects == nullptr) {
      Fail(scene, "world", "has no collision_objects (valid: world: {collision_objects: [...]})");
    }
    for (const char* key : {"fixed_frame_transforms", "fixed_frame_transform"}) {
      if (const YamlNode* frames = scene.Find(key)) ReadFrames(*frames, key);
    }
    TellTheRest(scene, world);
    for (size_t i = 0; i < Items(*objects, "collision_objects").size(); ++i) {
      ReadObject(objects->items[i], "collision_objects[" + std::to_string(i) + "]");
    }
    return std::move(scenery_);
  }

 private:
  [[noreturn]] void Fail(const YamlNode& at, const std::string& key, const std::string& what) {
    complaints_.Fail(at.place, key, what);
  }

  static bool IsEmpty(const YamlNode* node) {
    return node == nullptr || node->kind == Kind::kNull ||
           (node->kind != Kind::kScalar && node->items.empty());
  }

  const std::vector<YamlNode>& Items(const YamlNode& node, const std::string& key) {
    static const std::vector<YamlNode> kNone;
    if (node.kind == Kind::kNull) return kNone;
    if (node.kind != Kind::kList) Fail(node, key, "is " + Describe(node) + " (valid: a list)");
    return node.items;
  }

  double Number(const YamlNode& node, const std::string& key) {
    const NumberText number = ParseNumber(node.kind == Kind::kScalar ? node.text : "");
    if (number.kind != NumberText::Kind::kNumber || std::abs(number.value) > kMaxMeshCoordinate) {
      Fail(node, key, "is " + Describe(node) + " (valid: a number of at most 1e9)");
    }
    return number.value;
  }

  // A list of numbers, or a map of the letters of `names`.
  Eigen::VectorXd Numbers(const YamlNode& node, const std::string& key, const std::string& names) {
    Eigen::VectorXd numbers(std::ssize(names));
    if (node.kind == Kind::kList && node.items.size() == names.size()) {
      for (size_t i = 0; i < names.size(); ++i) {
        numbers[static_cast<Eigen::Index>(i)] = Number(node.items[i], key);
      }
      return numbers;
    }
    for (size_t i = 0; i < names.size(); ++i) {
      const YamlNode* const item =
          node.kind == Kind::kMap ? node.Find(std::string(1, names[i])) : nullptr;
      if (item == nullptr) {
        Fail(node, key,
             "is no " + names + " (valid: a map of them, or a list of " +
                 std::to_string(names.size()) + " numbers)");
      }
      numbers[static_cast<Eigen::Index>(i)] = Number(*item, key);
    }
    return numbers;
  }

  Isometry3d Pose(const YamlNode* node, const std::string& key) {
    if (IsEmpty(node)) return Isometry3d::Identity();
    Eigen::Vector3d p(0, 0, 0);
    Eigen::Vector4d q(0, 0, 0, 0);
    for (const char* name : {"position", "translation"}) {
      if (const YamlNode* found = node->Find(name)) p = Numbers(*found, key, "xyz");
    }
    for (const char* name : {"orientation", "rotation"}) {
      const YamlNode* found = node->Find(name);
      if (found == nullptr) continue;
      q = Numbers(*found, key, "xyzw");
      if (!PoseOf(p, q)) Fail(*found, key, kNoTurn);
    }
    return *PoseOf(p, q);
  }

  void ReadFrames(const YamlNode& frames, const std::string& key) {
    for (const YamlNode& item : Items(frames, key)) {
      const YamlNode* const child = item.Find("child_frame_id");
      const YamlNode* const header = item.Find("header");
      const YamlNode* const parent = header == nullptr ? nullptr : header->Find("frame_id");
      if (child == nullptr || child->kind != Kind::kScalar) {
        Fail(item, key, "a frame without child_frame_id");
      }
      frames_[child->text] = {parent == nullptr ? "" : parent->text,
                              Pose(item.Find("transform"), key)};
    }
  }

  // Of a frame in what is taken for the world: the last one of the chain, which has no other.
  Isometry3d FramePose(const YamlNode& at, std::string frame) {
    Isometry3d X = Isometry3d::Identity();
    for (size_t steps = 0;; ++steps) {
      const auto found = frames_.find(frame);
      if (found == frames_.end() || found->second.parent == frame) break;
      if (steps > frames_.size()) Fail(at, "header.frame_id", "its frames are a circle");
      X = found->second.X_ParentFrame * X;
      frame = found->second.parent;
    }
    if (!frame.empty() && !frames_.contains(frame)) {
      scenery_.Tell("frame " + Quote(frame) + " is taken for the world (--pose places it)");
    }
    return X;
  }

  void TellTheRest(const YamlNode& scene, const YamlNode* world) {
    for (const char* key : {"robot_state", "allowed_collision_matrix", "link_padding", "link_scale",
                            "object_colors"}) {
      if (!IsEmpty(scene.Find(key))) scenery_.Tell(std::string(key) + " is left out");
    }
    const YamlNode* const map = world == nullptr ? nullptr : world->Find("octomap");
    const YamlNode* const inner = map == nullptr ? nullptr : map->Find("octomap");
    if (inner != nullptr && !IsEmpty(inner->Find("data"))) {
      scenery_.Tell("world.octomap is left out (a .bt or .ot file can be named beside it)");
    }
  }

  double Size(const YamlNode& dimensions, size_t index, const std::string& key) {
    const std::vector<YamlNode>& items = Items(dimensions, key);
    if (index >= items.size()) {
      Fail(dimensions, key, "has too few numbers (" + std::to_string(items.size()) + ")");
    }
    const double size = Number(items[index], key);
    if (!(size >= kLeastSize && size <= kMostSize)) Fail(items[index], key, SizeMistake(size));
    return size;
  }

  void ReadPrimitive(const YamlNode& node, const std::string& key, SceneryThing* thing) {
    const YamlNode* const type = node.Find("type");
    const YamlNode* const sizes = node.Find("dimensions");
    if (type == nullptr || sizes == nullptr) Fail(node, key, "has no type or no dimensions");
    std::string kind;
    for (const char c : type->text) kind += static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
    const std::string at = key + ".dimensions";
    if (kind == "1" || kind == "box") {
      thing->shape = Box{{Size(*sizes, 0, at), Size(*sizes, 1, at), Size(*sizes, 2, at)}};
    } else if (kind == "2" || kind == "sphere") {
      thing->shape = Sphere{Size(*sizes, 0, at)};
    } else if (kind == "3" || kind == "cylinder") {
      thing->shape = Cylinder{Size(*sizes, 1, at), Size(*sizes, 0, at)};
    } else if (kind == "4" || kind == "cone") {
      thing->shape = ConeMesh(Size(*sizes, 1, at), Size(*sizes, 0, at));
      scenery_.Tell(kConesTold);
    } else {
      Fail(*type, key + ".type",
           "is " + Describe(*type) + " (valid: 1 box, 2 sphere, 3 cylinder, 4 cone)");
    }
  }

  int Corner(const YamlNode& node, const std::string& key, Eigen::Index vertices) {
    const double corner = Number(node, key);
    if (!(corner >= 0 && corner < static_cast<double>(vertices)) || corner != std::floor(corner)) {
      Fail(node, key, "is no vertex (valid: 0 … " + std::to_string(vertices - 1) + ")");
    }
    return static_cast<int>(corner);
  }

  void ReadMesh(const YamlNode& node, const std::string& key, SceneryThing* thing) {
    if (const YamlNode* const resource = node.Find("resource")) {
      Eigen::Vector3d scale(1, 1, 1);
      if (const YamlNode* const sizes = node.Find("dimensions"))
        scale = Numbers(*sizes, key, "xyz");
      if ((scale.array() == 0.0).any()) Fail(node, key + ".dimensions", "a scale of 0");
      try {
        thing->shape = MeshReference{request_.places.Find(resource->text, path_), scale};
      } catch (const std::runtime_error& error) {
        Fail(*resource, key + ".resource", error.what());
      }
      return;
    }
    const YamlNode* const points = node.Find("vertices");
    const YamlNode* const faces = node.Find("triangles");
    if (IsEmpty(points) || IsEmpty(faces)) Fail(node, key, "has no vertices or no triangles");
    OwnMesh mesh{Eigen::Matrix3Xd(3, std::ssize(Items(*points, key))),
                 Eigen::Matrix3Xi(3, std::ssize(Items(*faces, key)))};
    for (Eigen::Index i = 0; i < mesh.vertices.cols(); ++i) {
      mesh.vertices.col(i) = Numbers(Nth(points->items, i), key + ".vertices", "xyz");
    }
    for (Eigen::Index i = 0; i < mesh.triangles.cols(); ++i) {
      const YamlNode& face = Nth(faces->items, i);
      const YamlNode* const named = face.kind == Kind::kMap ? face.Find("vertex_indices") : &face;
      const std::string at = key + ".triangles";
      if (named == nullptr || Items(*named, at).size() != 3) Fail(face, at, "has no three corners");
      for (int k = 0; k < 3; ++k) {
        mesh.triangles(k, i) = Corner(Nth(named->items, k), at, mesh.vertices.cols());
      }
    }
    thing->shape = std::move(mesh);
  }

  void ReadPlane(const YamlNode& node, const std::string& key, SceneryThing* thing) {
    const YamlNode* const coefficients = node.Find("coef");
    if (coefficients == nullptr) Fail(node, key, "has no coef");
    const auto plane = PlaneOf(Numbers(*coefficients, key, "abcd"));
    if (!plane) Fail(*coefficients, key, "a plane without a normal");
    thing->shape = EndlessPlane{plane->normal};
    thing->X_WO.translation() = plane->point;
  }

  void ReadObject(const YamlNode& object, const std::string& key) {
    const YamlNode* const id = object.Find("id");
    const std::string name = id == nullptr ? "object" : id->text;
    const YamlNode* const operation = object.Find("operation");
    if (request_.LeavesOut(name)) return scenery_.Tell(name + ": left out by --without");
    if (operation != nullptr && (operation->text == "1" || operation->text == "remove")) {
      return scenery_.Tell(name + ": left out, for its operation is to remove it");
    }
    const YamlNode* const header = object.Find("header");
    const YamlNode* const frame = header == nullptr ? nullptr : header->Find("frame_id");
    const Isometry3d X_WObject = FramePose(object, frame == nullptr ? "" : frame->text) *
                                 Pose(object.Find("pose"), key + ".pose");
    const size_t before = scenery_.things.size();
    const auto read_all = [&](const char* shapes, const char* poses, auto read) {
      const YamlNode* const list = object.Find(shapes);
      if (IsEmpty(list)) return;
      const std::string at = key + "." + shapes;
      const YamlNode* const places = object.Find(poses);
      const size_t count = Items(*list, at).size();
      const size_t placed = IsEmpty(places) ? 0 : Items(*places, key + "." + poses).size();
      // Newer messages may leave the poses out where the object has one.
      if (placed != count && (placed != 0 || object.Find("pose") == nullptr)) {
        Fail(*list, at,
             std::to_string(count) + " of them and " + std::to_string(placed) + " " + poses +
                 " (valid: as many)");
      }
      for (size_t i = 0; i < count; ++i) {
        if (scenery_.things.size() == kMostThings) Fail(*list, at, kTooManyThings);
        SceneryThing thing{.name = name, .shape = {}};
        (this->*read)(list->items[i], at + "[" + std::to_string(i) + "]", &thing);
        const Isometry3d X =
            placed == 0 ? Isometry3d::Identity() : Pose(&places->items[i], key + "." + poses);
        thing.X_WO = X_WObject * X * thing.X_WO;
        scenery_.things.push_back(std::move(thing));
      }
    };
    read_all("primitives", "primitive_poses", &PlanningSceneReader::ReadPrimitive);
    read_all("meshes", "mesh_poses", &PlanningSceneReader::ReadMesh);
    read_all("planes", "plane_poses", &PlanningSceneReader::ReadPlane);
    if (scenery_.things.size() == before) scenery_.Tell(name + ": has no shape");
  }

  struct Frame {
    std::string parent;
    Isometry3d X_ParentFrame;
  };

  const std::string& path_;
  const SceneryRequest& request_;
  YamlComplaints complaints_;
  std::map<std::string, Frame> frames_;
  Scenery scenery_;
};

}  // namespace

Scenery ReadPlanningScene(const std::string& path, const std::string& text,
                          const SceneryRequest& request) {
  return PlanningSceneReader(path, request).Read(text);
}

}  // namespace halfstep
