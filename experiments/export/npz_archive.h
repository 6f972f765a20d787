#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace halfstep {

/// A NumPy archive in memory: an uncompressed zip file with a member NAME.npy for each array
/// (format 1.0, C order, little endian). The bytes depend on what was added only. Every Add throws
/// InputError, which names `path`, where the archive would be 4 GiB or larger, and std::logic_error
/// for a shape that has not as many elements as there are values.
/// Source: [NumpyFormat], [Zip].
class NpzArchive {
 public:
  /// `path` stands for the archive in complaints; `help` is what the user can do about its size.
  NpzArchive(std::string path, std::string help) : path_(std::move(path)), help_(std::move(help)) {}

  using Shape = std::vector<size_t>;  ///< lengths, the slowest index first
  /// An array of float64.
  void Add(const std::string& name, const Shape& shape, const std::vector<double>& values);
  /// An array of int64.
  void Add(const std::string& name, const Shape& shape, const std::vector<std::int64_t>& values);
  /// A list of truth values.
  void Add(const std::string& name, const std::vector<bool>& values);
  /// A list of unicode texts of the longest's length; bytes that are no UTF-8 stand for themselves.
  void Add(const std::string& name, const std::vector<std::string>& values);

  /// The file with all that was added.
  std::string Finished() const;

 private:
  void AddMember(const std::string& name, const std::string& content);

  std::string path_, help_;
  std::string bytes_, directory_;
  std::uint64_t members_ = 0;
};

}  // namespace halfstep
