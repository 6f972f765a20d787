#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace halfstep {

/// Writes `parts`, one after the other, under a temporary name of its own beside `path`, syncs the
/// file and renames it: `path` is whole or as before, also when several programs write it at once.
/// Makes the folder. Throws std::runtime_error with the system's reason.
void WriteWholeFile(const std::string& path, const std::vector<std::string_view>& parts);

}  // namespace halfstep
