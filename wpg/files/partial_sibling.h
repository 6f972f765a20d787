#pragma once

#include <filesystem>
#include <string_view>

namespace halfstep {

/// A hidden sibling ".NAME.partial-<16 hexadecimal digits>" of a path: the file or folder that is
/// to be renamed to the path when it is complete. Its name is random, it is created exclusively
/// (links are not followed), and it is locked (flock) until this object is destroyed or the process
/// ends in whatever way. The destructor removes it unless it was released.
class PartialSibling {
 public:
  /// What is made.
  enum class Kind { kFile, kFolder };

  /// Throws std::runtime_error that names `path` and the system's reason.
  PartialSibling(const std::filesystem::path& path, Kind kind);
  ~PartialSibling();
  PartialSibling(const PartialSibling&) = delete;
  PartialSibling& operator=(const PartialSibling&) = delete;

  /// Of the file or folder under its temporary name.
  const std::filesystem::path& path() const { return path_; }
  int descriptor() const { return descriptor_; }  ///< of a file: open for writing
  /// Says that it has been given its final name, so the destructor must not remove it.
  void Release() { released_ = true; }

 private:
  bool Make(Kind kind);
  bool Lock();

  std::filesystem::path path_;
  int descriptor_ = -1;
  bool released_ = false;
};

/// Removes from `folder` the partial siblings of `name` (of every name when it is empty) that
/// nobody holds: those whose lock could be taken. Where locks prove nothing, on network file
/// systems and FUSE, all stay.
void RemoveAbandonedSiblings(const std::filesystem::path& folder, std::string_view name);

}  // namespace halfstep
