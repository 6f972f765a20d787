#include "tests/places.h"

namespace halfstep {
namespace {

std::string Below(std::string folder, std::string_view path) {
  return path.empty() ? folder : folder + "/" + std::string(path);
}

}  // namespace

std::string InSources(std::string_view path) { return Below(HALFSTEP_SOURCE_DIR, path); }
std::string InBuild(std::string_view path) { return Below(HALFSTEP_BINARY_DIR, path); }
std::string CommandFile() { return HALFSTEP_COMMAND; }

}  // namespace halfstep
