#pragma once

#include <cstdlib>
#include <string>

#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace halfstep {

/// Whether Python has a module.
inline bool PythonHas(const std::string& module) {
  return std::system(("/usr/bin/python3 -c 'import " + module + "' 2>/dev/null").c_str()) == 0;
}

/// What read_motion.py says about files of a folder; "" when it has nothing to say against them.
inline std::string ReadByPython(const TemporaryFolder& place, const std::string& arguments) {
  const std::string command = "cd " + place.path().string() + " && /usr/bin/python3 -B " +
                              InSources("tests/export/read_motion.py ") + arguments + " >said 2>&1";
  return std::system(command.c_str()) == 0 ? "" : ReadText(place / "said") + "\nfailed";
}

}  // namespace halfstep
