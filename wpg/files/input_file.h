#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace halfstep {

/// A file as it was when it was read. Certificates take what they say about a file from here; they
/// do not read it again.
struct InputFile {
  std::string name;       ///< as written in the file that names it; else the last part of the path
  std::string path;       ///< where it was read from
  std::size_t bytes = 0;  ///< its length
  std::string sha256;     ///< of what was parsed, lower-case hexadecimal
};

/// The record of bytes that were read from a path; its name is the path's last part.
InputFile RecordOf(const std::string& path, const std::string& bytes);

/// SHA-256 over the names, lengths and hashes of files in their order, each behind its length, so
/// that no two lists give the same text.
std::string CombinedSha256(const std::vector<InputFile>& files);

}  // namespace halfstep
