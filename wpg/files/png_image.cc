#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>

#include "wpg/files/grey_image.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

constexpr png_uint_32 kMostPixels = 16'777'216;

// What libpng calls back with.
struct PngSource {
  const std::string& bytes;
  size_t at = 0;
  char error[200] = "";
};

void ReadBytes(png_structp png, png_bytep to, size_t count) {
  auto* const source = static_cast<PngSource*>(png_get_io_ptr(png));
  if (source->bytes.size() - source->at < count) png_error(png, "the file ends too early");
  std::memcpy(to, source->bytes.data() + source->at, count);
  source->at += count;
}

[[noreturn]] void KeepError(png_structp png, png_const_charp what) {
  auto* const source = static_cast<PngSource*>(png_get_error_ptr(png));
  std::strncpy(source->error, what, sizeof source->error - 1);
  png_longjmp(png, 1);
}

void IgnoreWarning(png_structp, png_const_charp) {}

// What is wrong with the header; "" if nothing.
const char* HeaderMistake(png_uint_32 width, png_uint_32 height, int depth, int colour) {
  if (colour != PNG_COLOR_TYPE_GRAY) return "is not grey, or has alpha (valid: a grey PNG)";
  if (depth != 8 && depth != 16) return "has pixels of less than 8 bits (valid: 8 or 16 bits)";
  if (width > kMostPixels / height) return "too many pixels (valid: at most 16,777,216)";
  return "";
}

// libpng leaves by longjmp, over no object with a destructor: all are the caller's.
bool ReadPng(png_structp png, png_infop info, GreyImage* image, std::string* pixels,
             std::vector<png_bytep>* rows, PngSource* source) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_read_fn(png, source, ReadBytes);
  png_set_user_limits(png, 65'535, 65'535);
  png_read_info(png, info);
  const png_uint_32 width = png_get_image_width(png, info);
  const png_uint_32 height = png_get_image_height(png, info);
  const int depth = png_get_bit_depth(png, info);
  const char* const mistake = HeaderMistake(width, height, depth, png_get_color_type(png, info));
  if (mistake[0] != '\0') png_error(png, mistake);
  image->width = static_cast<long>(width);
  image->height = static_cast<long>(height);
  image->white = depth == 16 ? 65'535 : 255;
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  const size_t stride = png_get_rowbytes(png, info);
  pixels->resize(stride * height);
  rows->resize(height);
  for (size_t y = 0; y < height; ++y) {
    (*rows)[y] = reinterpret_cast<png_bytep>(pixels->data() + y * stride);
  }
  png_read_image(png, rows->data());
  png_read_end(png, nullptr);
  return true;
}

}  // namespace

GreyImage ParsePng(const std::string& path, const std::string& bytes) {
  PngSource source{.bytes = bytes};
  GreyImage image;
  std::string pixels;
  std::vector<png_bytep> rows;
  png_structp png =
      png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, KeepError, IgnoreWarning);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  const bool read = info != nullptr && ReadPng(png, info, &image, &pixels, &rows, &source);
  png_destroy_read_struct(&png, &info, nullptr);
  if (!read) {
    throw InputError({path + ": PNG: " + (source.error[0] == '\0' ? "no memory" : source.error)});
  }
  const size_t each = image.white > 255 ? 2 : 1;
  const size_t count = static_cast<size_t>(image.width * image.height);
  image.pixels.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    const auto byte = [&](size_t k) {
      return static_cast<int>(static_cast<unsigned char>(pixels[each * i + k]));
    };
    image.pixels.push_back(each == 1 ? byte(0) : 256 * byte(0) + byte(1));
  }
  return image;
}

}  // namespace halfstep
