#pragma once

#include <filesystem>
#include <string>

#include "experiments/config/experiment_config.h"
#include "experiments/verify/certificate_text.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/run_manifest.h"
#include "planner/scene/scene.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

/// The parts of a run that must agree, as they were read.
struct RunParts {
  const ExperimentConfig& config;
  const RunManifest& manifest;
  const CertificateText& certificate;
  const RobotModel& robot;
  const Scene& scene;
  std::filesystem::path run;  ///< its folder
  std::string folder;         ///< of the method
  bool robot_given = false;   ///< on the command line: where the files are, is not compared
  bool scene_given = false;
};

/// Whether config, manifest and certificate speak of the same robot, scene, name, seed, methods and
/// number of half-steps, and whether these are the files that were parsed now.
void CheckRun(const RunParts& parts, const std::string& config_bytes, Findings* findings);

}  // namespace halfstep::verify
