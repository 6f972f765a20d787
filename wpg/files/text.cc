#include "wpg/files/text.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

#include "wpg/files/plain_locale.h"

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

// Appends the character at *i and goes on to the next: control characters and invalid bytes as
// \xNN.
void AppendShown(std::string_view text, size_t* i, std::string* shown) {
  constexpr std::string_view kHex = "0123456789ABCDEF";
  const size_t length = SequenceLength(text, *i);
  if (length > 0 && !IsControl(text, *i)) {
    *shown += text.substr(*i, length);
    *i += length;
    return;
  }
  for (const size_t end = *i + std::max<size_t>(length, 1); *i < end; ++*i) {
    const unsigned byte = Byte(text, *i);
    *shown += {'\\', 'x', kHex[byte / 16], kHex[byte % 16]};
  }
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
  std::string quoted = "'";
  for (size_t i = 0; i < text.size();) {
    if (i >= kLongest) return quoted + "…'";
    AppendShown(text, &i, &quoted);
  }
  return quoted + "'";
}

std::string Printable(std::string_view text) {
  std::string shown;
  for (size_t i = 0; i < text.size();) {
    if (text[i] == '\n') {
      shown += text[i++];
    } else {
      AppendShown(text, &i, &shown);
    }
  }
  return shown;
}

// As in the C locale, whatever locale the program around us has set.
std::string Formatted(const char* format, ...) {
  const PlainLocale plain;
  std::va_list arguments, again;
  va_start(arguments, format);
  va_copy(again, arguments);
  const int length = std::vsnprintf(nullptr, 0, format, arguments);
  va_end(arguments);
  std::string text(static_cast<size_t>(std::max(length, 0)), '\0');
  std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  return text;
}

bool LooksLikeFormula(std::string_view text) {
  return !text.empty() && std::string_view("-=+@\t\r").find(text[0]) != std::string_view::npos;
}

std::string NameMistake(std::string_view name) {
  constexpr size_t kLongest = 100;
  if (FindInvalidUtf8(name) != std::string_view::npos || HasControlCharacter(name)) {
    return Quote(name) + " holds a control character or invalid bytes (valid: text of one line)";
  }
  if (name.size() > kLongest) {
    return Quote(name) + " is too long (valid: at most " + std::to_string(kLongest) + " bytes)";
  }
  if (LooksLikeFormula(name)) {
    return Quote(name) +
           " would be taken for an option or a formula (valid: text that does not begin with '-', "
           "'=', '+' or '@')";
  }
  return "";
}

}  // namespace halfstep
