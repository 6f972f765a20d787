#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wpg/files/mesh_text.h"
#include "wpg/files/point_file.h"

namespace halfstep {

// What the readers of point clouds share.

/// More points are refused.
inline constexpr long kMaxPoints = 20'000'000;
inline constexpr size_t kMaxPointFields = 1000;  ///< of a point

/// A number of binary data.
struct PointScalar {
  char kind = 'F';   ///< as PCD's TYPE: F float, I signed, U unsigned
  size_t bytes = 4;  ///< 1, 2, 4 or 8
};

/// A number of each point, or so many after each other.
struct PointField {
  std::string name;                   ///< as the file has it
  PointScalar scalar;                 ///< type of its numbers
  size_t count = 1;                   ///< numbers after each other
  std::optional<PointScalar> list{};  ///< PLY: the type of the count that goes before
};

/// A whole number of a header, 0 … most (InputError).
long PointCount(const MeshText& text, const MeshWord& word, long most);

/// Which fields x, y and z are; complains at `place` unless each is there once, as one number.
std::array<size_t, 3> PointAxes(const MeshText& text, const MeshWord& place,
                                const std::vector<PointField>& fields);

/// What a PLY file says of one kind of its things.
struct PlyElement {
  std::string name;                ///< "vertex", "face" …
  long count = 0;                  ///< how many follow
  std::vector<PointField> fields;  ///< of each
};
/// The header of a PLY file.
struct PlyHeader {
  std::string format;                ///< ascii, binary_little_endian or binary_big_endian
  std::vector<PlyElement> elements;  ///< in the order of the data
  MeshWord end;                      ///< the word with which it ends
  /// The element of a name, or nullptr.
  const PlyElement* Find(std::string_view name) const;
};
/// Reads the header, up to the data. Throws InputError, also where it names no format or no vertex.
PlyHeader ReadPlyHeader(MeshText* text);

/// Gathers points, and counts those that are none.
class PointList {
 public:
  /// Coordinates, finite; one with a nan marks the point as none, which is counted.
  void Add(const Eigen::Vector3d& p);
  /// Throws InputError when there is none.
  LoadedPoints Take(const std::string& path) const;

 private:
  std::vector<Eigen::Vector3d> all_;
  int invalid_ = 0;
};

/// Binary data; what would be beyond its end is a complaint (InputError).
class PointData {
 public:
  /// Borrows path and bytes.
  PointData(const std::string& path, std::string_view bytes, size_t at, bool big_endian)
      : path_(path), bytes_(bytes), at_(at), big_endian_(big_endian) {}

  size_t at() const { return at_; }  ///< bytes that were read
  /// Reads past an element, and returns the fields `axes` of it; nullptr: nothing of it.
  Eigen::Vector3d Element(const std::vector<PointField>& fields, const std::array<size_t, 3>* axes);
  /// The next number.
  double Next(PointScalar scalar);
  /// The length of a list, which comes next.
  size_t NextLength(PointScalar scalar);
  /// Passes over `count` numbers of `each` bytes.
  void Skip(size_t count, size_t each);

 private:
  void Need(size_t bytes) const;

  const std::string& path_;
  std::string_view bytes_;
  size_t at_;
  bool big_endian_;
};

/// A coordinate as text: as MeshText::Number has it, or nan.
double PointNumber(const MeshText& text, const MeshWord& word);

/// Complains about a point at a byte that is infinite or too far; nan is for PointList.
void CheckPoint(const std::string& path, size_t byte, const Eigen::Vector3d& p);

/// PLY, as text or binary; throws InputError.
LoadedPoints ReadPly(const std::string& path, std::string_view bytes);
/// PCD, as text or binary, not compressed; throws InputError.
LoadedPoints ReadPcd(const std::string& path, std::string_view bytes);

}  // namespace halfstep
