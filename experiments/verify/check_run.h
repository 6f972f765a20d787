#pragma once

#include <string>
#include <vector>

#include "experiments/config/experiment_config.h"
#include "experiments/verify/certificate_text.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/run_manifest.h"
#include "planner/scene/scene.h"
#include "wpg/files/input_file.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

/// The parts of a run that must agree, as they were read.
struct RunParts {
  const ExperimentConfig& config;      ///< config.yaml
  const RunManifest& manifest;         ///< manifest.json
  const CertificateText& certificate;  ///< certificate.json
  const RobotModel& robot;             ///< of which they speak
  const Scene& scene;                  ///< of which they speak
  std::string folder;                  ///< of the method
};

/// Whether the files that were parsed `now`, of the robot or the scene (`what`), are those of a
/// manifest: names, lengths and hashes, and the hash of them all.
void CheckManifestInputs(const std::string& what, const std::vector<InputFile>& now,
                         const std::vector<InputFile>& then, const std::string& hash,
                         Findings* findings);

/// Whether config, manifest and certificate speak of the same robot, scene, name, seed, objective,
/// methods, duration and number of half-steps, and whether robot and scene are the files that were
/// parsed now.
void CheckRun(const RunParts& parts, const std::string& config_bytes, Findings* findings);

}  // namespace halfstep::verify
