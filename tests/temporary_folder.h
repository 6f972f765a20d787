#pragma once

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace halfstep {

/// A new empty folder, which goes with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// All of a file; throws std::runtime_error when it cannot be opened.
std::string ReadText(const std::filesystem::path& path);
/// Writes a text and returns its path.
std::string WriteText(const std::filesystem::path& path, const std::string& text);
/// Names of what a folder holds, hidden ones too.
std::set<std::string> NamesIn(const std::filesystem::path& folder);
/// Paths of all regular files below a folder, relative to it.
std::set<std::string> FilesBelow(const std::filesystem::path& folder);

}  // namespace halfstep
