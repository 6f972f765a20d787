#include "wpg/files/input_file.h"

#include <filesystem>

#include "wpg/files/sha256.h"

namespace halfstep {

InputFile RecordOf(const std::string& path, const std::string& bytes) {
  return {.name = std::filesystem::path(path).filename().string(),
          .path = path,
          .bytes = bytes.size(),
          .sha256 = Sha256(bytes)};
}

std::string CombinedSha256(const std::vector<InputFile>& files) {
  std::string text = std::to_string(files.size()) + "\n";
  for (const InputFile& file : files) {
    text += std::to_string(file.name.size()) + ":" + file.name + "\n";
    text += std::to_string(file.bytes) + " " + file.sha256 + "\n";
  }
  return Sha256(text);
}

}  // namespace halfstep
