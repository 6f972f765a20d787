#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/experiments/parsed_csv.h"
#include "tests/temporary_folder.h"

namespace halfstep {

/// Bytes of all files below a folder by their relative paths; hidden ones (partial files) apart.
struct FolderState {
  std::map<std::string, std::string> files;
  std::set<std::string> hidden;
};

inline FolderState StateOf(const std::filesystem::path& folder) {
  FolderState state;
  if (!std::filesystem::exists(folder)) return state;
  for (const std::string& file : FilesBelow(folder)) {
    const bool is_hidden = file.starts_with('.') || file.find("/.") != std::string::npos;
    if (is_hidden) state.hidden.insert(file);
    if (!is_hidden) state.files[file] = ReadText(folder / file);
  }
  return state;
}

/// Whether a text file is as a whole one is: JSON, CSV, or ended by a line break.
inline bool IsWhole(const std::string& file, const std::string& text) {
  if (file.ends_with(".json")) return nlohmann::json::accept(text);
  if (file.ends_with(".csv")) {
    try {
      ParsedCsv{text};
    } catch (const std::exception&) {
      return false;
    }
  }
  return text.ends_with('\n');
}

/// A call by which a program changes files, as tests/faults/fault_injection.cc logs it.
struct FileCall {
  long number = 0;  ///< within its process
  std::string operation;
  std::string path;
  std::string other;  ///< a rename's target
};

inline std::vector<FileCall> ReadCalls(const std::filesystem::path& log) {
  std::vector<FileCall> calls;
  std::ifstream in(log);
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells(line);
    FileCall call;
    std::string number;
    std::getline(cells, number, '\t');
    std::getline(cells, call.operation, '\t');
    std::getline(cells, call.path, '\t');
    std::getline(cells, call.other, '\t');
    call.number = std::stol(number);
    const auto plain = [](const std::string& path) {
      return path.empty() ? path : std::filesystem::path(path).lexically_normal().string();
    };
    call.path = plain(call.path);
    call.other = plain(call.other);
    calls.push_back(call);
  }
  return calls;
}

}  // namespace halfstep
