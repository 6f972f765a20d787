#include "wpg/files/grey_image.h"

#include "wpg/files/mesh_text.h"
#include "wpg/files/point_data.h"
#include "wpg/files/regular_file.h"

namespace halfstep {
namespace {

constexpr std::uint64_t kMostImageBytes = std::uint64_t{64} << 20;

// The next word of a header that is no comment.
MeshWord HeaderWord(MeshText* text) {
  MeshWord word = text->Next();
  while (word.text.starts_with('#')) {
    text->SkipLine();
    word = text->Next();
  }
  return word;
}

GreyImage ParsePgm(const std::string& path, const std::string& bytes) {
  constexpr long kMostPixels = 16'777'216;
  MeshText text(path, bytes);
  const MeshWord kind = HeaderWord(&text);
  if (kind.text != "P2" && kind.text != "P5") {
    text.Fail(kind, "no grey PGM (valid: P2 or P5; `convert map.png map.pgm` makes one)");
  }
  GreyImage grey;
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

GreyImage ParseGreyImage(const std::string& path, const std::string& bytes) {
  GreyImage image = bytes.starts_with("\x89PNG") ? ParsePng(path, bytes) : ParsePgm(path, bytes);
  image.file = RecordOf(path, bytes);
  return image;
}

GreyImage LoadGreyImage(const std::string& path) {
  return ParseGreyImage(path, ReadRegularFile(path, kMostImageBytes));
}

}  // namespace halfstep
