#pragma once

#include <cstring>
#include <string>

namespace halfstep {

/// OctoMap files of cells of 5 cm, as the format is described, byte by byte: cell (0, 0, 0) is
/// occupied, (1, 1, 1) is free, all else unknown. `size` is what the header says, `data` what
/// stands in place of the tree.
inline std::string SmallBt(const std::string& size = "18", const std::string* data = nullptr) {
  std::string tree("\x00\xC0", 2);  // child 7 is an inner node: the upper half of each axis
  for (int level = 1; level <= 14; ++level) tree += std::string("\x03\x00", 2);
  tree += std::string("\x02\x40", 2);  // child 0 occupied, child 7 free
  return "# Octomap OcTree binary file\n# (comment)\nid OcTree\nsize " + size +
         "\nres 0.05\ndata\n" + (data == nullptr ? tree : *data);
}

inline std::string SmallOt(float occupied = 0.85f) {
  const auto node = [](float log_odds, char children) {
    std::string bytes(5, children);
    std::memcpy(bytes.data(), &log_odds, sizeof log_odds);
    return bytes;
  };
  std::string tree = node(0.85f, '\x80');
  for (int level = 1; level <= 14; ++level) tree += node(0.85f, '\x01');
  tree += node(0.85f, '\x81') + node(occupied, '\x00') + node(-0.4f, '\x00');
  return "# Octomap OcTree file\nid OcTree\nsize 18\nres 0.05\ndata\n" + tree;
}

}  // namespace halfstep
