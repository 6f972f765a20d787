#include "wpg/files/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <utility>

#include "wpg/files/input_error.h"
#include "wpg/files/mesh_text.h"
#include "wpg/files/regular_file.h"

namespace halfstep {
namespace {

constexpr size_t kStlHeader = 80, kStlStart = 84, kStlTriangle = 50;

[[noreturn]] void Refuse(const std::string& path, const std::string& what) {
  Complaints complaints;
  complaints.Add(path, 0, 0, "", what);
  throw InputError(complaints.lines());
}

// ".stl", ".obj" or ".dae".
std::string ExtensionOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension != ".stl" && extension != ".obj" && extension != ".dae") {
    Refuse(path, "unknown kind of mesh (valid: .stl, .obj, .dae)");
  }
  return extension;
}

std::string ReadWhole(const std::string& path) {
  FileBytes file = TryReadRegularFile(path, kMaxMeshBytes);
  if (!file.refused.empty()) Refuse(path, file.refused);
  return std::move(file.bytes);
}

// Binary files may start with "solid" too; what they cannot help is the size or bytes that no text
// has.
bool IsBinaryStl(const std::string& bytes) {
  if (bytes.size() >= kStlStart) {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + kStlHeader, sizeof(count));
    if (bytes.size() == kStlStart + std::uintmax_t{count} * kStlTriangle) return true;
  }
  const size_t start = bytes.find_first_not_of(" \t\r\n");
  std::string word = start == std::string::npos ? "" : bytes.substr(start, 5);
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::string_view beginning = std::string_view(bytes).substr(0, 1024);
  const bool begins_as_text = word == "solid" || beginning.starts_with("\xEF\xBB\xBF");
  return !begins_as_text || beginning.find('\0') != std::string_view::npos;
}

}  // namespace

LoadedMesh LoadMesh(const std::string& path) {
  (void)ExtensionOf(path);  // complains before anything is read
  return ParseMesh(path, ReadWhole(path));
}

LoadedMesh ParseMesh(const std::string& path, const std::string& bytes) {
  const std::string extension = ExtensionOf(path);
  if (bytes.empty()) Refuse(path, "is empty");
  LoadedMesh mesh = extension == ".obj"   ? ReadObj(path, bytes)
                    : extension == ".dae" ? ReadDae(path, bytes)
                    : IsBinaryStl(bytes)  ? ReadBinaryStl(path, bytes)
                                          : ReadAsciiStl(path, bytes);
  if (mesh.triangles.cols() == 0) Refuse(path, "has no triangle");
  mesh.file = RecordOf(path, bytes);
  return mesh;
}

}  // namespace halfstep
