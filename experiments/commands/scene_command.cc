#include <filesystem>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>

#include "experiments/commands/command_line.h"
#include "experiments/commands/command_mistake.h"
#include "experiments/commands/commands.h"
#include "experiments/scenery/scenery_floor.h"
#include "experiments/scenery/scenery_scene.h"
#include "planner/scene/scene.h"
#include "wpg/files/input_error.h"
#include "wpg/files/partial_sibling.h"
#include "wpg/files/text.h"
#include "wpg/files/whole_file.h"
#include "wpg/geometry/rotation.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

Eigen::Isometry3d PoseOf(const SceneCommand& command) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  if (!command.pose.empty()) {
    X.translation() << command.pose[0], command.pose[1], command.pose[2];
    X.linear() = RollPitchYaw(0, 0, command.pose[3] * std::numbers::pi / 180);
  }
  X.translation().z() += command.up;
  return X;
}

// Reads the scene as it will be, so that nothing is written that would be refused.
Scene Checked(const Scenery& scenery, const SceneFiles& files, const fs::path& out) {
  if (files.meshes.empty()) return ParseScene(out.string(), files.text);
  fs::path place = fs::absolute(out).lexically_normal().parent_path();
  while (!fs::is_directory(place)) place = place.parent_path();
  const PartialSibling folder(place / (out.stem().string() + ".check"),
                              PartialSibling::Kind::kFolder);
  const SceneFiles there = SceneFilesOf(scenery, folder.path() / out.filename(), {});
  for (const auto& [path, text] : there.meshes) WriteWhole(path, {text});
  try {
    return ParseScene((folder.path() / out.filename()).string(), there.text);
  } catch (const InputError& error) {
    std::vector<std::string> complaints = error.complaints();
    const std::string from = folder.path().string();
    for (std::string& line : complaints) {
      for (size_t at = line.find(from); at != std::string::npos; at = line.find(from)) {
        line.replace(at, from.size(), place.string());
      }
    }
    throw InputError(std::move(complaints));
  }
}

std::string Counted(int count, const std::string& kind) {
  const char* const plural = kind == "box" || kind == "mesh" ? "es" : kind == "points" ? "" : "s";
  return std::to_string(count) + " " + kind + (count == 1 ? "" : plural);
}

void Tell(const SceneCommand& command, const SceneFiles& files, const Scenery& scenery,
          const Scene& scene) {
  std::string kinds;
  for (const auto& [kind, count] : files.kinds) {
    kinds += (kinds.empty() ? " (" : ", ") + Counted(count, kind);
  }
  std::cout << "written: " << command.out << ": "
            << Counted(static_cast<int>(scenery.things.size()), "obstacle") << kinds
            << (kinds.empty() ? "" : ")");
  if (!files.meshes.empty()) {
    std::cout << ", and " << Counted(static_cast<int>(files.meshes.size()), "mesh") << " beside it";
  }
  std::cout << '\n';
  for (const std::string& line : scenery.told) std::cout << "  " << Printable(line) << '\n';
  for (const std::string& warning : scene.warnings) {
    std::cout << "  " << Printable(warning) << '\n';
  }
  std::cout << "next:    halfstep init my_walk --scene " << command.out << " --goal 2 0\n";
}

}  // namespace

ExitStatus ConvertScene(const SceneCommand& command) {
  const fs::path out = command.out;
  if (out.extension() != ".yaml") {
    throw InputError({"--out " + command.out + ": no scene file (valid: a name in .yaml)"});
  }
  if (const std::string mistake = NameMistake(out.stem().string()); !mistake.empty()) {
    throw InputError({"--out: " + mistake});
  }
  std::error_code ignored;
  if (fs::equivalent(out, command.file, ignored)) {
    throw InputError({"--out " + command.out + ": is the file that is read (valid: another name)"});
  }
  Scenery scenery = ReadScenery(command.file, command.request);
  const Eigen::Isometry3d X = PoseOf(command);
  for (SceneryThing& thing : scenery.things) thing.X_WO = X * thing.X_WO;
  TakeFloorOut(&scenery);
  if (scenery.things.empty()) scenery.Tell("nothing of it is in the way");
  std::vector<std::string> head = {"By `halfstep scene` of " +
                                   fs::path(command.file).filename().string() + "."};
  head.insert(head.end(), scenery.told.begin(), scenery.told.end());
  const SceneFiles files = SceneFilesOf(scenery, out, head);
  const auto refuse_older = [&command](const fs::path& path) {
    if (command.overwrite || !fs::exists(path)) return;
    throw InputError({path.string() + ": is there already (--overwrite replaces it)"});
  };
  refuse_older(out);
  for (const auto& [path, text] : files.meshes) refuse_older(path);
  const Scene scene = Checked(scenery, files, out);
  for (const auto& [path, text] : files.meshes) WriteWhole(path, {text});
  WriteWhole(out, {files.text});
  if (!command.quiet) Tell(command, files, scenery, scene);
  return kSuccess;
}

CommandAction DeclareScene(CLI::App* app, const Toolbox&) {
  const auto command = std::make_shared<SceneCommand>();
  struct Texts {
    std::vector<std::string> packages, models;
    std::string as;
  };
  const auto texts = std::make_shared<Texts>();
  SceneryRequest* const request = &command->request;
  app->add_option("FILE", command->file,
                  "MoveIt .scene, planning-scene YAML, URDF, SDF world, PLY, glTF, STL, OBJ, DAE, "
                  "PCD, OctoMap, or PGM heightmap")
      ->required();
  app->add_option("--out", command->out, "the scene file")->required();
  app->add_option("--package", texts->packages,
                  "NAME=FOLDER of package:// and model:// names; repeatable")
      ->allow_extra_args(false);
  app->add_option("--models", texts->models, "a folder of model:// folders; repeatable")
      ->allow_extra_args(false);
  app->add_option("--without", request->without,
                  "leave out things of this name (or pattern, 'table*'); repeatable")
      ->allow_extra_args(false);
  app->add_option("--pose", command->pose, "X Y Z YAW_DEG: where its frame lies [m, deg]")
      ->expected(4)
      ->check(CLI::Range(-1000.0, 1000.0));
  app->add_option("--up", command->up, "moves it up, so that its floor lies at 0 [m]")
      ->check(CLI::Range(-1000.0, 1000.0));
  app->add_option("--scale", request->scale, "metres per unit of a mesh (default: 1)")
      ->check(CLI::Range(1e-6, 1e6));
  app->add_option("--as", texts->as, "of a PLY: mesh or points (default: mesh if it has faces)")
      ->check(OneOf({"mesh", "points"}));
  app->add_option("--radius", request->radius, "of the ball around each point [m] (default: 0.02)")
      ->check(CLI::Range(1e-3, 1.0));
  app->add_option("--floor-below", request->floor_below,
                  "of points, maps, heights: what is not higher is floor [m]")
      ->check(CLI::Range(-1.0, 0.1));
  app->add_option("--cell", request->cell, "of a heightmap: edge of a pixel [m]")
      ->check(CLI::Range(1e-4, 100.0));
  app->add_option("--height", request->height, "of a heightmap: how high white is [m]")
      ->check(CLI::Range(1e-4, 1000.0));
  app->add_flag("--overwrite", command->overwrite, "replace older files");
  app->add_flag("--quiet", command->quiet, "print nothing but errors");
  return [command, texts] {
    for (const YamlOverride& package : ParseOverrides(texts->packages, "--package")) {
      command->request.places.packages[package.key] =
          fs::absolute(package.value).lexically_normal().string();
    }
    for (const std::string& folder : texts->models) {
      command->request.places.models.push_back(fs::absolute(folder).lexically_normal());
    }
    command->request.as_points = texts->as == "points";
    return ConvertScene(*command);
  };
}

}  // namespace halfstep
