#include "wpg/files/point_file.h"

#include <filesystem>

#include "wpg/files/input_error.h"
#include "wpg/files/point_data.h"
#include "wpg/files/regular_file.h"

namespace halfstep {

LoadedPoints LoadPoints(const std::string& path) {
  FileBytes file = TryReadRegularFile(path, kMaxMeshBytes);
  if (!file.refused.empty()) throw InputError({path + ": " + file.refused});
  return ParsePoints(path, file.bytes);
}

LoadedPoints ParsePoints(const std::string& path, const std::string& bytes) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension != ".ply" && extension != ".pcd") {
    throw InputError({path + ": another kind of file (valid: .ply, .pcd)"});
  }
  LoadedPoints loaded = extension == ".ply" ? ReadPly(path, bytes) : ReadPcd(path, bytes);
  loaded.file = RecordOf(path, bytes);
  return loaded;
}

}  // namespace halfstep
