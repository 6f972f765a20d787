#include <fnmatch.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

#include "experiments/scenery/scenery_readers.h"
#include "experiments/scenery/scenery_xml.h"
#include "wpg/files/input_error.h"
#include "wpg/files/mesh_text.h"
#include "wpg/files/point_data.h"
#include "wpg/files/regular_file.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKinds =
    "valid: .scene, .yaml of a planning scene, .urdf, .sdf, .world, .ply, .gltf, .glb, .stl, .obj, "
    ".dae, .pcd, .bt, .ot, .pgm, .png";

std::string LowerExtension(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

Scenery Alone(const std::string& path, decltype(SceneryThing::shape) shape) {
  Scenery scenery;
  scenery.things.push_back({.name = fs::path(path).stem().string(), .shape = std::move(shape)});
  return scenery;
}

// Clouds and maps are named as they are.
Scenery NamedCloud(const std::string& path, bool is_map, const SceneryRequest& request) {
  if (request.scale != 1.0) {
    throw InputError(
        {"--scale: is of meshes; a scene names clouds and maps as they are, in metres"});
  }
  return Alone(path,
               CloudReference{path, is_map, is_map ? 0.0 : request.radius, request.floor_below});
}

Scenery ReadXml(const std::string& path, const std::string& text, const SceneryRequest& request) {
  TiXmlDocument document;
  ParseSceneryXml(path, text, &document);
  const TiXmlElement& root = *document.RootElement();
  if (root.ValueStr() == "robot") return ReadUrdfScenery(path, text, request);
  if (root.ValueStr() == "sdf" || root.ValueStr() == "gazebo") {
    return ReadSdfScenery(path, text, request);
  }
  SceneryElements(path).Fail(root, "is neither a URDF nor an SDF (valid: <robot> or <sdf>)");
}

bool HasFaces(const std::string& path, const std::string& bytes) {
  MeshText text(path, bytes);
  const PlyHeader header = ReadPlyHeader(&text);
  const PlyElement* const faces = header.Find("face");
  return faces != nullptr && faces->count > 0;
}

}  // namespace

bool SceneryRequest::LeavesOut(const std::string& name) const {
  return std::any_of(without.begin(), without.end(), [&name](const std::string& pattern) {
    return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
  });
}

Scenery ReadScenery(const std::string& path, const SceneryRequest& request) {
  const std::string kind = LowerExtension(path);
  if (kind == ".stl" || kind == ".obj" || kind == ".dae") {
    return Alone(path, MeshReference{path, Eigen::Vector3d::Constant(request.scale)});
  }
  if (kind == ".pcd") {
    return NamedCloud(path, false, request);
  }
  if (kind == ".bt" || kind == ".ot") {
    return NamedCloud(path, true, request);
  }
  const bool is_known = kind == ".scene" || kind == ".yaml" || kind == ".yml" || kind == ".urdf" ||
                        kind == ".sdf" || kind == ".world" || kind == ".xml" || kind == ".xacro" ||
                        kind == ".ply" || kind == ".gltf" || kind == ".glb" || kind == ".pgm" ||
                        kind == ".png";
  if (!is_known) throw InputError({path + ": unknown kind of file (" + kKinds + ")"});
  const std::string bytes = ReadRegularFile(path, kMaxMeshBytes);
  if (kind == ".pgm" || kind == ".png") return ReadHeightmap(path, bytes, request);
  if (kind == ".ply") {
    if (request.as_points || !HasFaces(path, bytes)) {
      return NamedCloud(path, false, request);
    }
    OwnMesh mesh = ReadPlyMesh(path, bytes);
    mesh.vertices *= request.scale;
    return Alone(path, std::move(mesh));
  }
  if (kind == ".gltf" || kind == ".glb") {
    std::vector<std::string> told;
    OwnMesh mesh = ReadGltfMesh(path, bytes, &told);
    mesh.vertices *= request.scale;
    Scenery scenery = Alone(path, std::move(mesh));
    scenery.told = std::move(told);
    scenery.Tell("glTF calls y up: it is turned so that z is");
    return scenery;
  }
  if (FindInvalidUtf8(bytes) != std::string::npos) {
    throw InputError(
        {path + ": byte " + std::to_string(FindInvalidUtf8(bytes)) + ": is no text in UTF-8"});
  }
  if (kind == ".scene") return ReadMoveItScene(path, bytes, request);
  if (kind == ".yaml" || kind == ".yml") return ReadPlanningScene(path, bytes, request);
  return ReadXml(path, bytes, request);
}

}  // namespace halfstep
