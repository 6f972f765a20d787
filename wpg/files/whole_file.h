#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "wpg/files/descriptor.h"

namespace halfstep {

/// A new file whose content comes in parts, which are not kept.
class SyncedFile {
 public:
  /// Nothing may have the name yet. Throws as WriteSynced, as do all of its functions.
  SyncedFile(const std::filesystem::path& path, std::filesystem::path shown);
  void Add(std::string_view part);  ///< more of it
  void Sync();                      ///< to the disk; to be called last

 private:
  std::filesystem::path shown_;
  Descriptor file_;
};

/// Writes a new file's content, its parts one after the other, and syncs it to the disk; nothing
/// may have the name yet. Throws std::runtime_error that names `shown` and the system's reason,
/// e.g. "No space left on device".
void WriteSynced(const std::filesystem::path& path, const std::vector<std::string_view>& parts,
                 const std::filesystem::path& shown);

/// Writes a file that appears under its name whole or not at all, in place of an older one, also
/// when several threads or programs write it at once: by way of a PartialSibling. Makes the folder.
/// Removes siblings that killed processes left behind. Throws as WriteSynced, also when the name is
/// a link or anything else but a regular file: these are neither followed nor replaced.
void WriteWhole(const std::filesystem::path& path, const std::vector<std::string_view>& parts);

/// Copies a file of at most 1 GiB to a name that nothing has yet, and syncs it. Throws as
/// WriteSynced.
void CopySynced(const std::filesystem::path& from, const std::filesystem::path& to,
                const std::filesystem::path& shown);

/// Syncs a folder's entries, so that files made in it keep their names after a crash. Throws as
/// WriteSynced, except on file systems that cannot sync folders.
void SyncFolder(const std::filesystem::path& folder, const std::filesystem::path& shown);

}  // namespace halfstep
