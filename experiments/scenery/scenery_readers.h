#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/scenery/scenery.h"
#include "experiments/scenery/scenery_places.h"

namespace halfstep {

/// What is asked beside the file.
struct SceneryRequest {
  SceneryPlaces places;                ///< where packages and models lie
  std::vector<std::string> without;    ///< names of things, links, models that are left out
  double scale = 1.0;                  ///< metres per unit of a mesh
  bool as_points = false;              ///< a PLY mesh is taken for its points
  double radius = 0.02;                ///< of the balls around points [m]
  std::optional<double> floor_below;   ///< of points, maps and heights [m]
  std::optional<double> cell, height;  ///< of a pixel, and of white, of a heightmap [m]

  /// Whether a thing of this name is to be left out.
  bool LeavesOut(const std::string& name) const;
};

/// Reads what another program wrote, by the extension of its name and its content. Numbers in
/// metres unless `scale` says otherwise; poses as the file has them, in its own frame. Throws
/// InputError "file:line:column: …" (binary data: "file: byte N: …") for what cannot be read, for a
/// file that it names and that is not there, and for more than kMostThings things.
Scenery ReadScenery(const std::string& path, const SceneryRequest& request);

// Each kind by itself; `path` stands for the file in complaints, and paths in it start there.

/// MoveIt's planning-scene geometry as RViz exports it, the older form and that with poses of
/// objects and subframes.
Scenery ReadMoveItScene(const std::string& path, const std::string& text,
                        const SceneryRequest& request);
/// A message moveit_msgs/PlanningScene as YAML, or the objects of one.
Scenery ReadPlanningScene(const std::string& path, const std::string& text,
                          const SceneryRequest& request);
/// A URDF, all joints at zero: collision shapes; of links that have none the visual ones.
Scenery ReadUrdfScenery(const std::string& path, const std::string& text,
                        const SceneryRequest& request);
/// An SDF world or model, with what it includes: collision shapes.
Scenery ReadSdfScenery(const std::string& path, const std::string& text,
                       const SceneryRequest& request);
/// A heightmap in PGM: boxes on z = 0, the image's centre at the origin, its upper edge at +y.
Scenery ReadHeightmap(const std::string& path, const std::string& bytes,
                      const SceneryRequest& request);
/// A mesh in PLY, ascii or binary.
OwnMesh ReadPlyMesh(const std::string& path, const std::string& bytes);
/// A mesh in glTF 2.0, as text (`.gltf`) or binary (`.glb`), turned so that its y, which is up,
/// becomes z. `told` gets what was left out.
OwnMesh ReadGltfMesh(const std::string& path, const std::string& bytes,
                     std::vector<std::string>* told);

/// The round cone along z with its tip at +length/2, as a mesh of 64 sides that contains it.
OwnMesh ConeMesh(double radius, double length);

}  // namespace halfstep
