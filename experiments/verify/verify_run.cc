#include "experiments/verify/verify_run.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "experiments/verify/check_certificate.h"
#include "experiments/verify/check_claims.h"
#include "experiments/verify/check_clearance.h"
#include "experiments/verify/check_rows.h"
#include "experiments/verify/csv_text.h"
#include "experiments/verify/findings.h"
#include "wpg/input/input_error.h"
#include "wpg/input/text.h"

namespace halfstep::verify {
namespace {

namespace fs = std::filesystem;

std::string HashOfFiles(const std::vector<std::string>& files) {
  std::string bytes;
  for (const std::string& file : files) bytes += ReadBytes(file);
  return Sha256(bytes);
}

void CheckHash(const char* what, const std::string& found, const std::string& stated,
               Findings* findings) {
  if (found == stated) return;
  findings->Disagree(std::string(what) +
                     ": not the one that the certificate is about (SHA-256 differs)");
}

fs::path PathOf(const VerifyOptions& options, const std::optional<std::string>& instead,
                const std::string& stated) {
  return instead ? fs::path(*instead) : (fs::path(options.run) / stated).lexically_normal();
}

void Verify(const VerifyOptions& options, const fs::path& folder, Findings* findings,
            std::string* statement) {
  const auto path_of = [&folder](const char* file) { return (folder / file).string(); };
  const std::string json = ReadBytes(path_of("certificate.json"));
  const CertificateText certificate = ReadCertificateJson(path_of("certificate.json"), json);
  *statement = certificate.statement;
  const std::string claims = ReadBytes(path_of("certificate.csv"));
  const std::string trajectory = ReadBytes(path_of("trajectory.csv"));
  const RobotModel robot = LoadRobot(PathOf(options, options.robot, certificate.robot).string());
  Scene scene;
  if (options.scene ? *options.scene != "none" : certificate.scene != "none") {
    scene = LoadScene(PathOf(options, options.scene, certificate.scene).string());
  }

  CheckHash("trajectory.csv", Sha256(trajectory), certificate.trajectory_hash, findings);
  CheckHash("certificate.csv", Sha256(claims), certificate.certificate_hash, findings);
  CheckHash("robot", HashOfFiles(robot.files), certificate.robot_hash, findings);
  CheckHash("scene", HashOfFiles(scene.files), certificate.scene_hash, findings);
  const bool same_files = findings->disagreements() == 0;
  findings->Say(Text("SHA-256: trajectory, certificate, %zu robot files, %zu scene files",
                     robot.files.size(), scene.files.size()));
  const fs::path config = fs::path(options.run) / "config.yaml";
  if (fs::exists(config)) {
    const ConfigDemands demands = ReadConfigDemands(config.string(), ReadBytes(config.string()));
    CheckAgainstConfig(certificate, demands, findings);
  } else {
    findings->Say("config.yaml: there is none; what to demand is the certificate's word");
  }

  const std::vector<ClaimRow> claimed = ReadCertificateCsv(path_of("certificate.csv"), claims);
  const std::vector<PlayedRow> rows = ReadTrajectory(path_of("trajectory.csv"), trajectory, robot);
  CheckArithmetic(certificate, claimed, robot, rows.empty() ? 0 : rows.back().t, findings);
  if (!CheckIsMotion(rows, findings)) return;
  const PlayedMotion motion(robot, rows);
  Distances distances(robot, scene);
  CheckConsistency(motion, scene, options.tolerance, findings);
  CheckRowMargins(motion, certificate, options.tolerance, findings);
  if (!same_files) {
    findings->Say("clearances: not examined, for these are not the certificate's files");
    return;
  }
  CheckClearances(motion, certificate, options.tolerance, &distances, findings);
  const bool finite = std::all_of(claimed.begin(), claimed.end(), [](const ClaimRow& row) {
    return std::isfinite(row.begin) && std::isfinite(row.end) && !std::isnan(row.margin) &&
           std::isfinite(row.bound);
  });
  if (finite) CheckClaims(motion, certificate, claimed, options.tolerance, &distances, findings);
  findings->Say("distances: " + Count(distances.queries()));
}

bool HasCertificate(const fs::path& folder) {
  return fs::exists(folder / "certificate.json") || fs::exists(folder / "certificate.csv");
}

// What the manifest calls the run's methods, as names of folders; none when it cannot be read.
std::vector<fs::path> FoldersOfManifest(const fs::path& run) {
  std::vector<fs::path> folders;
  const fs::path path = run / "manifest.json";
  if (!fs::exists(path)) return folders;
  using nlohmann::json;
  const json manifest = json::parse(ReadBytes(path.string()), nullptr, /*allow_exceptions=*/false);
  if (!manifest.is_object() || !manifest.contains("methods")) return folders;
  for (const json& method : manifest["methods"]) {
    if (!method.is_object() || !method.contains("name") || !method["name"].is_string()) continue;
    std::string name = method["name"].get<std::string>();
    std::replace(name.begin(), name.end(), '/', '_');
    if (!name.empty() && !name.starts_with('.')) folders.push_back(run / name);
  }
  return folders;
}

// The methods of a run, whether they have a certificate or not.
std::vector<fs::path> Folders(const VerifyOptions& options) {
  const fs::path run(options.run);
  if (!fs::is_directory(run)) {
    throw InputError(
        {options.run + ": no such run folder (valid: a folder that `halfstep run` wrote)"});
  }
  std::vector<fs::path> folders = FoldersOfManifest(run);
  for (const auto& entry : fs::directory_iterator(run)) {
    if (!entry.is_directory()) continue;
    if (HasCertificate(entry.path()) || fs::exists(entry.path() / "trajectory.csv")) {
      folders.push_back(entry.path());
    }
  }
  std::sort(folders.begin(), folders.end());
  folders.erase(std::unique(folders.begin(), folders.end()), folders.end());
  if (std::none_of(folders.begin(), folders.end(), HasCertificate)) {
    throw InputError({options.run + ": no certificate in it (`halfstep certify` makes them)"});
  }
  if (!options.method) return folders;
  std::string name = *options.method;
  std::replace(name.begin(), name.end(), '/', '_');
  std::string names;
  for (const fs::path& folder : folders) {
    if (!HasCertificate(folder)) continue;
    if (folder.filename() == name) return {folder};
    names += (names.empty() ? "" : ", ") + folder.filename().string();
  }
  throw InputError({options.run + ": no certificate of the method " + Quote(*options.method) +
                    " (valid: " + names + ")"});
}

}  // namespace

std::vector<MethodVerification> VerifyRun(const VerifyOptions& options) {
  if (!(options.tolerance >= 0 && options.tolerance <= 1)) {
    throw InputError({"--tolerance: out of range (valid: 0 … 1 m)"});
  }
  std::vector<MethodVerification> results;
  for (const fs::path& folder : Folders(options)) {
    MethodVerification& result = results.emplace_back();
    result.method = folder.filename().string();
    Findings findings;
    try {
      if (HasCertificate(folder)) {
        Verify(options, folder, &findings, &result.statement);
      } else {
        findings.Disagree("there is no certificate (`halfstep certify` makes it)");
      }
      result.verified = findings.disagreements() == 0;
    } catch (const InputError& error) {
      result.readable = false;
      result.complaints = error.complaints();
    }
    result.lines = findings.lines();
    result.reasons = findings.reasons();
    result.disagreements = findings.disagreements();
  }
  return results;
}

std::string Describe(const MethodVerification& result) {
  std::string text = result.method + "\n";
  for (const std::string& line : result.lines) text += "  " + line + "\n";
  if (!result.readable) {
    text += "  cannot be read:\n";
    for (const std::string& line : result.complaints) text += "    " + line + "\n";
  } else if (result.verified) {
    text += "  verified\n";
  }
  if (result.disagreements > 0) {
    text += "  NOT verified:\n";
    for (const std::string& reason : result.reasons) text += "    " + reason + "\n";
    const long more = result.disagreements - std::ssize(result.reasons);
    if (more > 0) text += "    … and " + Count(more) + " more\n";
  }
  if (result.statement.empty()) return text;
  // A statement that could write anything on a terminal is not repeated.
  const bool clean = FindInvalidUtf8(result.statement) == std::string::npos &&
                     !HasControlCharacter(result.statement);
  text += "  The certificate's statement: " + (clean ? result.statement : Quote(result.statement)) +
          "\n";
  return text;
}

}  // namespace halfstep::verify
