#include "experiments/verify/check_files.h"

#include <algorithm>
#include <filesystem>

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

void CheckListedFiles(const std::string& folder, const FolderFiles& files,
                      const std::map<std::string, InputFile>& listed, Findings* findings) {
  std::string others;
  long as_listed = 0;
  for (const std::string& name : files.there) {
    const auto found = listed.find(name);
    if (found == listed.end()) {
      if (!files.needed.contains(name)) others += (others.empty() ? "" : ", ") + Quote(name);
      continue;
    }
    ++as_listed;
    const std::string bytes = ReadBytes((fs::path(folder) / name).string());
    if (bytes.size() != found->second.bytes || Sha256(bytes) != found->second.sha256) {
      findings->Disagree(name + ": not the one that manifest.json lists (SHA-256 differs)");
    }
  }
  for (const std::string& name : files.needed) {
    if (!listed.contains(name)) findings->Disagree("manifest.json does not list " + name);
  }
  for (const auto& [name, file] : listed) {
    if (files.there.contains(name)) continue;
    findings->Disagree("manifest.json lists " + Quote(name) + ", which is not there");
  }
  findings->Say("files: " + Count(as_listed) + " as manifest.json lists them" +
                (others.empty() ? "" : "; not listed: " + others));
}

void CheckFiles(const std::string& run, const std::string& method, const RunManifest& manifest,
                Findings* findings) {
  std::map<std::string, InputFile> listed = manifest.files;
  std::erase_if(listed, [&](const auto& item) {
    const std::string folder = item.first.substr(0, item.first.find('/'));
    return folder != item.first && folder != method && manifest.HasFolder(folder);
  });
  CheckListedFiles(run, {FilesThere(run, method, manifest), NeededFiles(run, method)}, listed,
                   findings);
}

}  // namespace halfstep::verify
