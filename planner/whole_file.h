#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace halfstep {

/// Writes a file's content, its parts one after the other, and syncs it to the disk. Throws
/// std::runtime_error that names `shown` and the system's reason, e.g. "No space left on device".
void WriteSynced(const std::filesystem::path& path, const std::vector<std::string_view>& parts,
                 const std::filesystem::path& shown);

/// Writes a file that appears under its name whole or not at all, in place of an older one, also
/// when several threads or programs write it at once: by way of a hidden sibling. Makes the folder.
/// Removes siblings that killed processes left behind. Throws as WriteSynced.
void WriteWhole(const std::filesystem::path& path, const std::vector<std::string_view>& parts);

/// Name of this process' hidden sibling of `path`: ".NAME.partial-PID".
std::filesystem::path PartialSibling(const std::filesystem::path& path);
/// Removes the siblings of `path` whose processes are gone.
void RemoveAbandonedSiblings(const std::filesystem::path& path);

}  // namespace halfstep
