#include "experiments/verify/check_files.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "experiments/verify/csv_text.h"
#include "wpg/files/sha256.h"
#include "wpg/files/text.h"

namespace halfstep::verify {
namespace {

namespace fs = std::filesystem;

constexpr char kManifest[] = "manifest.json";

// What a run must list: all that a certificate is about, and that the other files say of it. A
// method that made no step has neither overlaps nor iterates.
std::set<std::string> NeededFiles(const fs::path& run, const std::string& method) {
  std::set<std::string> files = {"config.yaml", "footsteps.csv", "summary.csv"};
  for (const char* name :
       {"certificate.csv", "certificate.json", "half_steps.csv", "trajectory.csv"}) {
    files.insert(method + "/" + name);
  }
  for (const char* name : {"iterates.csv", "overlaps.csv"}) {
    if (fs::exists(run / method / name)) files.insert(method + "/" + name);
  }
  return files;
}

// Files below a run's folder, but not those of other methods; relative paths.
std::set<std::string> FilesThere(const fs::path& run, const std::string& method,
                                 const RunManifest& manifest) {
  std::set<std::string> files;
  for (auto it = fs::recursive_directory_iterator(run); it != fs::end(it); ++it) {
    const std::string name = it->path().lexically_relative(run).string();
    if (it->is_directory()) {
      if (name != method && manifest.HasFolder(name)) it.disable_recursion_pending();
    } else if (name != kManifest) {
      files.insert(name);
    }
  }
  return files;
}

}  // namespace

void CheckFiles(const std::string& run, const std::string& method, const RunManifest& manifest,
                Findings* findings) {
  const std::set<std::string> there = FilesThere(run, method, manifest);
  const std::set<std::string> needed = NeededFiles(run, method);
  std::string others;
  long listed = 0;
  for (const std::string& name : there) {
    const auto found = manifest.files.find(name);
    if (found == manifest.files.end()) {
      if (!needed.contains(name)) others += (others.empty() ? "" : ", ") + Quote(name);
      continue;
    }
    ++listed;
    const std::string bytes = ReadBytes((fs::path(run) / name).string());
    if (bytes.size() != found->second.bytes || Sha256(bytes) != found->second.sha256) {
      findings->Disagree(name + ": not the one that manifest.json lists (SHA-256 differs)");
    }
  }
  for (const std::string& name : needed) {
    if (!manifest.files.contains(name)) findings->Disagree("manifest.json does not list " + name);
  }
  for (const auto& [name, file] : manifest.files) {
    const std::string folder = name.substr(0, name.find('/'));
    const bool of_another = folder != name && folder != method && manifest.HasFolder(folder);
    if (!of_another && !there.contains(name)) {
      findings->Disagree("manifest.json lists " + Quote(name) + ", which is not there");
    }
  }
  findings->Say("files: " + Count(listed) + " as manifest.json lists them" +
                (others.empty() ? "" : "; not listed: " + others));
}

}  // namespace halfstep::verify
