#include "wpg/input/input_file.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "wpg/input/input_error.h"
#include "wpg/input/sha256.h"

namespace halfstep {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 20;

[[noreturn]] void Refuse(const std::string& path, const std::string& what) {
  Complaints complaints;
  complaints.Add(path, 0, 0, "", what);
  throw InputError(complaints.lines());
}

std::string Reason() { return std::generic_category().message(errno); }

// "4 MiB", "300 bytes".
std::string SizeText(std::size_t bytes) {
  for (const auto& [shift, unit] : {std::pair{30, " GiB"}, std::pair{20, " MiB"}}) {
    if (bytes > 0 && bytes % (std::size_t{1} << shift) == 0) {
      return std::to_string(bytes >> shift) + unit;
    }
  }
  return std::to_string(bytes) + " bytes";
}

}  // namespace

std::string ReadInput(const std::string& path, std::size_t most_bytes) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) Refuse(path, "is a folder, not a file");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) Refuse(path, "cannot be opened: " + Reason());
  std::string bytes;
  while (in && bytes.size() <= most_bytes) {
    const std::size_t before = bytes.size();
    const std::size_t wanted = std::min(std::max(kChunk, before), most_bytes + 1 - before);
    bytes.resize(before + wanted);
    in.read(bytes.data() + before, static_cast<std::streamsize>(wanted));
    bytes.resize(before + static_cast<std::size_t>(in.gcount()));
  }
  if (in.bad()) Refuse(path, "cannot be read: " + Reason());
  if (bytes.size() > most_bytes) {
    Refuse(path, "too large (valid: at most " + SizeText(most_bytes) + ")");
  }
  return bytes;
}

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
