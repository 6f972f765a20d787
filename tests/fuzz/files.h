#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>

namespace halfstep::fuzz {

/// An input of several files: each after a line "--- file NAME".
inline std::map<std::string, std::string> Files(std::string_view text) {
  static constexpr std::string_view kMark = "--- file ";
  std::map<std::string, std::string> files;
  std::string name;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end);
    if (line.starts_with(kMark)) {
      name = line.substr(kMark.size(), line.find('\n') - kMark.size());
      files.try_emplace(name);
    } else if (!name.empty()) {
      files[name] += line;
    }
  }
  return files;
}

/// A folder in memory, or else in the system's temporary one, that goes when the process ends.
class Folder {
 public:
  Folder() {
    const bool memory = std::filesystem::is_directory("/dev/shm");
    std::string name = (memory ? "/dev/shm" : std::filesystem::temp_directory_path().string()) +
                       "/halfstep-fuzz-XXXXXX";
    if (mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }

  /// Writes the file `name` as `files` has it, or removes it; nothing when it is so already.
  void Put(const std::string& name, const std::map<std::string, std::string>& files) {
    const auto file = files.find(name);
    const auto before = there_.find(name);
    if (file == files.end()) {
      if (before == there_.end()) return;
      std::filesystem::remove(path_ / name);
      there_.erase(before);
    } else if (before == there_.end() || before->second != file->second) {
      std::filesystem::create_directories((path_ / name).parent_path());
      std::ofstream(path_ / name, std::ios::binary) << file->second;
      there_[name] = file->second;
    }
  }

 private:
  std::filesystem::path path_;
  std::map<std::string, std::string> there_;
};

}  // namespace halfstep::fuzz
