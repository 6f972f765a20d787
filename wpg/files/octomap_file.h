#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "wpg/files/input_file.h"

namespace halfstep {

/// What an OctoMap file knows of space: cubes of cells that are occupied or free. What is in none
/// of them is unknown.
struct LoadedOctomap {
  /// Cells lower … lower + size − 1 along each axis; cell i is [i, i + 1] times the resolution.
  struct Cube {
    Eigen::Vector3i lower{0, 0, 0};  ///< in cells, from the map's origin
    int size = 1;                    ///< cells along each edge
    bool occupied = false;           ///< else free
  };
  double resolution = 0.0;  ///< edge of a cell [m], 1e-4 … 10
  std::vector<Cube> cubes;  ///< disjoint, at least one
  InputFile file;           ///< what was read
};

/// Reads a `.bt` (binary occupancy) or `.ot` (log odds; occupied from OctoMap's threshold, a half,
/// on) file by its extension. liboctomap reads it after its tree was walked once, for the library
/// does not check what it reads. Throws InputError "file:line:column: …" (of the data: "file: byte
/// N: …"): another extension, a header that is not understood, another tree than an OcTree, a tree
/// that ends early or late, is deeper than 16 levels or has another size than the header says, a
/// number that is not finite, nothing known, more than 20 million nodes or 1 GiB.
LoadedOctomap LoadOctomap(const std::string& path);
/// The same for a file's bytes; the kind of file is that of the path's extension.
LoadedOctomap ParseOctomap(const std::string& path, const std::string& bytes);

}  // namespace halfstep
