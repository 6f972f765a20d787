#pragma once

#include <filesystem>
#include <string_view>

namespace halfstep {

/// A hidden sibling ".NAME.partial-<16 hexadecimal digits>" in which a file or a folder is made
/// that shall have the name later: made exclusively under a random name (links are not followed),
/// and locked (flock) until the object, or the process in whatever way, ends. Removed at its end
/// unless released.
class PartialSibling {
 public:
  enum class Kind { kFile, kFolder };

  /// Throws std::runtime_error that names `path` and the system's reason.
  PartialSibling(const std::filesystem::path& path, Kind kind);
  ~PartialSibling();
  PartialSibling(const PartialSibling&) = delete;
  PartialSibling& operator=(const PartialSibling&) = delete;

  const std::filesystem::path& path() const { return path_; }
  int descriptor() const { return descriptor_; }  ///< a file's is open for writing
  /// It has its final name; nothing is left to be removed.
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
