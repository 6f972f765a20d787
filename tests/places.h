#pragma once

#include <string>
#include <string_view>

namespace halfstep {

// Where tests find things. Functions, not macros: compiled tests name no folder, so that another
// checkout takes them from a compiler cache.

/// A file of the source tree, by its path in it.
std::string InSources(std::string_view path = "");
/// A file of the build tree, by its path in it.
std::string InBuild(std::string_view path = "");
/// The program halfstep.
std::string CommandFile();

}  // namespace halfstep
