#include "experiments/verify/check_run.h"
#include "smoothing/methods/solver_method_options.h"

#include "wpg/files/sha256.h"
#include "wpg/files/text.h"

namespace halfstep::verify {
namespace {

// The first file that is not as it was, as a sentence; "": all are.
std::string Changed(const std::vector<InputFile>& now, const std::vector<InputFile>& then) {
  for (size_t i = 0; i < std::max(now.size(), then.size()); ++i) {
    if (i >= now.size()) return Quote(then[i].name) + " is no longer one of them";
    if (i >= then.size()) return Quote(now[i].name) + " was not one of them";
    if (now[i].name != then[i].name) return Quote(now[i].name) + " was " + Quote(then[i].name);
    if (now[i].bytes != then[i].bytes || now[i].sha256 != then[i].sha256) {
      return Quote(now[i].name) + " has changed";
    }
  }
  return "";
}

void CheckInputs(const std::string& what, const std::vector<InputFile>& now,
                 const std::vector<InputFile>& then, const std::string& certificate_hash,
                 const std::string& manifest_hash, Findings* findings) {
  const std::string hash = CombinedSha256(now), changed = Changed(now, then);
  if (hash != certificate_hash) {
    findings->Disagree(what + ": not the one that the certificate is about (SHA-256 differs" +
                       (changed.empty() ? ")" : "; " + changed + ")"));
  }
  CheckManifestInputs(what, now, then, manifest_hash, findings);
}

void CheckMethods(const RunParts& parts, Findings* findings) {
  std::vector<std::string> wanted = {"raw"}, named;
  const auto& methods = parts.config.smoothing.methods;
  wanted.insert(wanted.end(), methods.begin(), methods.end());
  for (const RunManifest::Method& method : parts.manifest.methods) named.push_back(method.name);
  if (wanted != named) {
    findings->Disagree("the methods of manifest.json are not raw and those of config.yaml");
  }
  const RunManifest::Method* const method = parts.manifest.MethodOf(parts.folder);
  if (method == nullptr) {
    findings->Disagree("manifest.json knows no method with this folder");
    return;
  }
  if (method->duration != parts.certificate.duration) {
    findings->Disagree(Formatted("duration: manifest.json has %.9g s, the certificate %.9g s",
                                 method->duration, parts.certificate.duration));
  }
  if (!method->verdict.empty() && method->verdict != parts.certificate.verdict) {
    findings->Disagree("verdict: manifest.json has " + Quote(method->verdict) +
                       ", the certificate " + Quote(parts.certificate.verdict));
  }
}

}  // namespace

void CheckManifestInputs(const std::string& what, const std::vector<InputFile>& now,
                         const std::vector<InputFile>& then, const std::string& hash,
                         Findings* findings) {
  const std::string changed = Changed(now, then);
  if (CombinedSha256(now) == hash && changed.empty()) return;
  findings->Disagree(what + ": not the one that manifest.json is about" +
                     (changed.empty() ? "" : ": " + changed));
}

void CheckRun(const RunParts& parts, const std::string& config_bytes, Findings* findings) {
  const ExperimentConfig& config = parts.config;
  const RunManifest& manifest = parts.manifest;
  const CertificateText& certificate = parts.certificate;
  CheckInputs("robot", parts.robot.files, manifest.robot_files, certificate.robot_hash,
              manifest.robot_sha256, findings);
  CheckInputs("scene", parts.scene.files, manifest.scene_files, certificate.scene_hash,
              manifest.scene_sha256, findings);
  CheckMethods(parts, findings);
  const auto agree = [findings](const char* what, bool same) {
    if (!same) findings->Disagree(std::string(what) + ": manifest.json disagrees with config.yaml");
  };
  agree("config_sha256", manifest.config_sha256 == Sha256(config_bytes));
  agree("name", manifest.name == config.name);
  agree("seed", manifest.seed == config.seed);
  agree("objective", manifest.objective == config.smoothing.options.Get(OptimizerGroup()).program);
  agree("half_steps", manifest.half_steps == 2 * std::ssize(config.footsteps));
  agree("robot", manifest.robot == parts.robot.name);
  agree("scene", manifest.scene == parts.scene.name);
  findings->Say("config.yaml, manifest.json and certificate: robot, scene, name, seed, methods");
}

}  // namespace halfstep::verify
