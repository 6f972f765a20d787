#pragma once

#include <Eigen/Core>
#include <string>

#include "wpg/files/input_file.h"

namespace halfstep {

/// A mesh as its file has it, in the file's unit (DAE: in metres); not assumed convex or closed.
struct LoadedMesh {
  Eigen::Matrix3Xd vertices;   ///< (3×n), finite, at most 1e9 in size.
  Eigen::Matrix3Xi triangles;  ///< (3×m), m ≥ 1, indices of vertices.
  InputFile file;              ///< what was read.
  /// Turns what a DAE file's `up_axis` calls up to z; the identity for other files. The vertices
  /// are not turned by it.
  Eigen::Matrix3d R_ZUp = Eigen::Matrix3d::Identity();
};

/// Reads an STL (ASCII or binary, told apart by their content), OBJ or DAE file in double
/// precision. STL: equal vertices become one; facet normals and attribute bytes are ignored. OBJ: v
/// and f; polygons are cut into triangles from their first corner (right for convex ones); vt, vn,
/// o, g, s, usemtl and mtllib are ignored, other statements refused. DAE (COLLADA): triangles,
/// polylist and polygons of what its scene shows (of all geometries where there is no scene),
/// placed by the nodes and scaled by its unit. As in RViz, `up_axis` turns nothing. Throws
/// InputError "file:line:column: …" (binary: "file: byte N: …") at the first mistake: another
/// extension, unreadable, truncated, a number that is not finite or beyond 1e9, an index out of
/// range, no triangle, more than 5 million triangles or 1 GiB.
LoadedMesh LoadMesh(const std::string& path);
/// The same for a file's bytes; the kind of mesh is that of the path's extension.
LoadedMesh ParseMesh(const std::string& path, const std::string& bytes);

}  // namespace halfstep
