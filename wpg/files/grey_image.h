#pragma once

#include <string>
#include <vector>

#include "wpg/files/input_file.h"

namespace halfstep {

/// A grey image, as its file has it.
struct GreyImage {
  long width = 0, height = 0;  ///< in pixels, at least 1 each, at most 16,777,216 in all
  long white = 255;            ///< the value of white, 1 … 65535
  std::vector<int> pixels;     ///< 0 … white, row by row, from the upper left
  InputFile file;              ///< what was read
};

/// Reads a PGM (P2 or P5; its white may be anything to 65535) or a grey PNG of 8 or 16 bits without
/// alpha, by what the bytes begin with. PNG values are as they are stored: no gamma is applied.
/// `path` is for complaints. Throws InputError.
GreyImage ParseGreyImage(const std::string& path, const std::string& bytes);
/// The same of a file of at most 64 MiB.
GreyImage LoadGreyImage(const std::string& path);

/// A PNG, with libpng; throws InputError.
GreyImage ParsePng(const std::string& path, const std::string& bytes);

}  // namespace halfstep
