#include <cmath>
#include <vector>

#include "experiments/scenery/scenery_readers.h"
#include "wpg/files/input_error.h"
#include "wpg/files/mesh_text.h"
#include "wpg/files/point_data.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

struct Grey {
  long width = 0, height = 0, white = 255;
  std::vector<int> pixels;  // row by row, from the upper left
};

// The next word of a header that is no comment.
MeshWord HeaderWord(MeshText* text) {
  MeshWord word = text->Next();
  while (word.text.starts_with('#')) {
    text->SkipLine();
    word = text->Next();
  }
  return word;
}

Grey ReadPgm(const std::string& path, const std::string& bytes) {
  constexpr long kMostPixels = 16'777'216;
  MeshText text(path, bytes);
  const MeshWord kind = HeaderWord(&text);
  if (kind.text != "P2" && kind.text != "P5") {
    text.Fail(kind, "no grey PGM (valid: P2 or P5; `convert map.png map.pgm` makes one)");
  }
  Grey grey;
  grey.width = PointCount(text, HeaderWord(&text), 65'535);
  const MeshWord place = HeaderWord(&text);
  grey.height = PointCount(text, place, 65'535);
  if (grey.width * grey.height < 1 || grey.width * grey.height > kMostPixels) {
    text.Fail(place, "too many pixels, or none (valid: at most 16,777,216)");
  }
  const MeshWord white = HeaderWord(&text);
  grey.white = PointCount(text, white, 65'535);
  if (grey.white == 0) text.Fail(white, "a white of 0 (valid: 1 … 65535)");
  const size_t count = static_cast<size_t>(grey.width * grey.height);
  if (kind.text == "P2") {
    while (grey.pixels.size() < count) {
      const MeshWord word = HeaderWord(&text);
      if (word.text.empty()) text.Fail(word, "the file ends within its pixels");
      grey.pixels.push_back(static_cast<int>(PointCount(text, word, grey.white)));
    }
    return grey;
  }
  const size_t begin = text.offset() + 1;  // one blank after the header
  const size_t each = grey.white > 255 ? 2 : 1;
  if (begin > bytes.size() || bytes.size() - begin < count * each) {
    RefuseByte(path, bytes.size(), "the file ends within its pixels");
  }
  for (size_t i = 0; i < count; ++i) {
    const auto byte = [&](size_t k) {
      return static_cast<int>(static_cast<unsigned char>(bytes[begin + each * i + k]));
    };
    grey.pixels.push_back(each == 1 ? byte(0) : 256 * byte(0) + byte(1));
    if (grey.pixels.back() > grey.white) {
      RefuseByte(path, begin + each * i, "a pixel that is brighter than white");
    }
  }
  return grey;
}

}  // namespace

Scenery ReadHeightmap(const std::string& path, const std::string& bytes,
                      const SceneryRequest& request) {
  if (!request.cell || !request.height) {
    throw InputError({path + ": a heightmap needs --cell and --height [m]: the edge of a pixel, "
                             "and how high white is"});
  }
  const Grey grey = ReadPgm(path, bytes);
  const double cell = *request.cell, unit = *request.height / static_cast<double>(grey.white);
  const double floor = request.floor_below.value_or(0.0);
  Scenery scenery;
  std::vector<bool> done(grey.pixels.size(), false);
  long floor_pixels = 0;
  const auto at = [&](long x, long y) { return static_cast<size_t>(y * grey.width + x); };
  const auto is_same = [&](long x, long y, int value) {
    return !done[at(x, y)] && grey.pixels[at(x, y)] == value;
  };
  // Rectangles of one height, as wide as they go, then as deep.
  for (long y = 0; y < grey.height; ++y) {
    for (long x = 0; x < grey.width; ++x) {
      if (done[at(x, y)]) continue;
      const int value = grey.pixels[at(x, y)];
      const double height = unit * value;
      if (!(height > floor)) {
        ++floor_pixels;
        continue;
      }
      long right = x, below = y + 1;
      while (right < grey.width && is_same(right, y, value)) ++right;
      const auto row_is_same = [&](long row) {
        for (long i = x; i < right; ++i) {
          if (!is_same(i, row, value)) return false;
        }
        return true;
      };
      while (below < grey.height && row_is_same(below)) ++below;
      for (long j = y; j < below; ++j) {
        for (long i = x; i < right; ++i) done[at(i, j)] = true;
      }
      if (scenery.things.size() == kMostThings) {
        throw InputError({path + ": more than 100,000 boxes of one height each (valid: a smaller "
                                 "or smoother map, or a larger --floor-below)"});
      }
      const auto wide = static_cast<double>(right - x), deep = static_cast<double>(below - y);
      SceneryThing thing{.name = "height", .shape = Box{{cell * wide, cell * deep, height}}};
      thing.X_WO.translation() << cell * (static_cast<double>(x) + 0.5 * wide -
                                          0.5 * static_cast<double>(grey.width)),
          cell * (0.5 * static_cast<double>(grey.height) - static_cast<double>(y) - 0.5 * deep),
          0.5 * height;
      scenery.things.push_back(std::move(thing));
    }
  }
  scenery.Tell(
      Formatted("heights are boxes in the way; the floor stays flat at z = 0, and nobody "
                "steps onto what is higher: %ld of %ld pixels, up to %.3g m, are floor",
                floor_pixels, grey.width * grey.height, floor));
  return scenery;
}

}  // namespace halfstep
