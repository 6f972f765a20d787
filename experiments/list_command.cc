#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "experiments/commands.h"
#include "experiments/experiment.h"
#include "experiments/methods.h"

namespace halfstep {
namespace {

struct Entry {
  std::string name;
  std::string meaning;
};

std::vector<Entry> FilesOf(const std::filesystem::path& folder) {
  std::vector<Entry> entries;
  for (const std::filesystem::path& path : YamlFiles(folder)) {
    entries.push_back({path.stem().string(), path.string()});
  }
  return entries;
}

std::vector<Entry> Entries(const std::string& what) {
  if (what == "robots") return FilesOf(RobotsFolder());
  if (what == "scenes") return FilesOf(ScenesFolder());
  if (what == "solvers") return {{"none", "no optimization solver is part of this version"}};
  std::vector<Entry> entries = {{"raw", "the planned motion itself; written by every run"}};
  for (const Method& method : Methods()) entries.push_back({method.name, method.meaning});
  return entries;
}

}  // namespace

ExitStatus List(const std::string& what, bool json) {
  const std::vector<Entry> entries = Entries(what);
  if (json) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Entry& entry : entries)
      list.push_back({{"name", entry.name}, {"meaning", entry.meaning}});
    std::cout << list.dump(2) << '\n';
    return kSuccess;
  }
  size_t width = 0;
  for (const Entry& entry : entries) width = std::max(width, entry.name.size());
  for (const Entry& entry : entries) {
    std::cout << entry.name << std::string(width + 2 - entry.name.size(), ' ') << entry.meaning
              << '\n';
  }
  return kSuccess;
}

}  // namespace halfstep
