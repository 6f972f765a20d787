#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "wpg/files/mesh_file.h"

namespace halfstep {

/// More triangles are refused.
inline constexpr int kMaxMeshTriangles = 5'000'000;
/// Larger coordinates are refused, in the unit of the file.
inline constexpr double kMaxMeshCoordinate = 1e9;
/// Larger files are refused.
inline constexpr std::uint64_t kMaxMeshBytes = std::uint64_t{1} << 30;

/// Complains about binary data: "path: byte N: what" (InputError).
[[noreturn]] void RefuseByte(const std::string& path, size_t byte, const std::string& what);

/// A word of a text file; empty at the end of the text (or of the line, where asked for).
struct MeshWord {
  std::string_view text;  ///< borrowed from the text
  int line = 0;           ///< line and column (in bytes) count from 1.
  int column = 0;         ///< in bytes
};

/// Walks over the words of an ASCII mesh file and complains with their place (InputError).
class MeshText {
 public:
  /// `text` is borrowed; `path` is for complaints.
  MeshText(std::string path, std::string_view text);

  MeshWord Next();                                    ///< next word, across lines.
  MeshWord NextInLine();                              ///< next word of this line.
  void SkipLine();                                    ///< to the start of the next line.
  bool AtEnd() const { return at_ == text_.size(); }  ///< whether all bytes were read
  size_t offset() const { return at_; }               ///< bytes before what comes next

  /// A coordinate: finite, at most kMaxMeshCoordinate in size.
  double Number(const MeshWord& word) const;
  /// A whole number; `text` is the part of the word that holds it.
  long Integer(const MeshWord& word, std::string_view text) const;
  /// Throws InputError about the place of a word.
  [[noreturn]] void Fail(const MeshWord& word, const std::string& what) const;

 private:
  std::string path_;
  std::string_view text_;
  size_t at_ = 0, line_start_ = 0;
  int line_ = 1;
};

/// A mesh of x, y, z after each other, and of three indices for each triangle.
LoadedMesh MeshOf(const std::vector<double>& coordinates, const std::vector<int>& corners);

/// STL as text; throws InputError, as the readers below.
LoadedMesh ReadAsciiStl(const std::string& path, std::string_view text);
/// STL with binary numbers.
LoadedMesh ReadBinaryStl(const std::string& path, std::string_view bytes);
/// OBJ: vertices and faces; the rest is passed over.
LoadedMesh ReadObj(const std::string& path, std::string_view text);
/// DAE (Collada): triangles of all geometries, placed by the scene's nodes.
LoadedMesh ReadDae(const std::string& path, const std::string& text);

}  // namespace halfstep
