#pragma once

#include <Eigen/Core>
#include <string>

#include "wpg/files/input_file.h"

namespace halfstep {

/// The points of a cloud as its file has them, in the file's unit.
struct LoadedPoints {
  Eigen::Matrix3Xd points;  ///< (3×n), n ≥ 1, finite, at most 1e9 in size
  int invalid = 0;          ///< points that are marked as none by nan: left out
  InputFile file;           ///< what was read
};

/// Reads a PLY or PCD file by its extension: x, y and z of the vertices or points, whatever else
/// they have. PLY 1.0: ascii, binary of either byte order; elements before the vertices are skipped
/// and what follows them is not read. PCD: ascii and binary; VIEWPOINT moves nothing, as in PCL.
/// Throws InputError "file:line:column: …" (binary data: "file: byte N: …") at the first mistake:
/// another extension, a header that is not understood, no x, y or z, truncated, a number that is
/// infinite or beyond 1e9 (nan marks a point as none), no point, more than 20 million or
/// 1 GiB, compressed data.
LoadedPoints LoadPoints(const std::string& path);
/// The same for a file's bytes; the kind of file is that of the path's extension.
LoadedPoints ParsePoints(const std::string& path, const std::string& bytes);

}  // namespace halfstep
