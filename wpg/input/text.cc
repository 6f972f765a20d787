#include "wpg/input/text.h"

namespace halfstep {
namespace {

unsigned Byte(std::string_view text, size_t i) { return static_cast<unsigned char>(text[i]); }

// Length of the UTF-8 sequence at i, 0 when it is invalid. Source: [Unicode15] table 3-7.
size_t SequenceLength(std::string_view text, size_t i) {
  const unsigned lead = Byte(text, i);
  if (lead < 0x80) return 1;
  if (lead < 0xC2 || lead > 0xF4) return 0;
  const size_t length = lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  if (i + length > text.size()) return 0;
  for (size_t k = 1; k < length; ++k) {
    if ((Byte(text, i + k) & 0xC0) != 0x80) return 0;
  }
  const unsigned second = Byte(text, i + 1);
  const bool overlong = (lead == 0xE0 && second < 0xA0) || (lead == 0xF0 && second < 0x90);
  const bool surrogate = lead == 0xED && second > 0x9F;
  const bool too_large = lead == 0xF4 && second > 0x8F;
  return overlong || surrogate || too_large ? 0 : length;
}

bool IsControl(std::string_view text, size_t i) {
  const unsigned byte = Byte(text, i);
  if (byte < 0x20 || byte == 0x7F) return true;
  return byte == 0xC2 && i + 1 < text.size() && Byte(text, i + 1) < 0xA0;
}

}  // namespace

size_t FindInvalidUtf8(std::string_view text) {
  for (size_t i = 0; i < text.size();) {
    const size_t length = SequenceLength(text, i);
    if (length == 0) return i;
    i += length;
  }
  return std::string_view::npos;
}

bool HasControlCharacter(std::string_view text) {
  for (size_t i = 0; i < text.size(); ++i) {
    if (IsControl(text, i)) return true;
  }
  return false;
}

std::string Quote(std::string_view text) {
  constexpr size_t kLongest = 60;
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string quoted = "'";
  for (size_t i = 0; i < text.size();) {
    if (i >= kLongest) return quoted + "…'";
    const size_t length = SequenceLength(text, i);
    if (length == 0 || IsControl(text, i)) {
      const unsigned byte = Byte(text, i);
      quoted += {'\\', 'x', kHex[byte / 16], kHex[byte % 16]};
      i += 1;
      if (length == 2) {  // a two-byte control character: show both
        const unsigned next = Byte(text, i);
        quoted += {'\\', 'x', kHex[next / 16], kHex[next % 16]};
        i += 1;
      }
    } else {
      quoted += text.substr(i, length);
      i += length;
    }
  }
  return quoted + "'";
}

}  // namespace halfstep
