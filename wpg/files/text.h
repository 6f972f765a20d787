#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace halfstep {

/// Byte offset of the first byte that is no part of valid UTF-8 (overlong forms and surrogates are
/// invalid), or npos.
size_t FindInvalidUtf8(std::string_view text);

/// Whether valid UTF-8 text holds a control character (U+0000 … U+001F, U+007F … U+009F).
bool HasControlCharacter(std::string_view text);

/// The text between single quotes, fit for a complaint: control characters and invalid bytes shown
/// as `\xNN`, and cut after 60 bytes.
std::string Quote(std::string_view text);

/// The text with control characters other than line breaks and invalid bytes shown as `\xNN`: fit
/// for a terminal.
std::string Printable(std::string_view text);

/// What printf would print; %s takes a C string.
[[gnu::format(printf, 1, 2)]] std::string Formatted(const char* format, ...);

/// Whether a spreadsheet takes a cell with this text for a formula, by its first character.
bool LooksLikeFormula(std::string_view text);

/// What makes a text unfit as the name of a thing in tables, folders and messages, with what is
/// valid; "" if nothing: control characters, invalid UTF-8, more than 100 bytes, or a first
/// character that a shell or a spreadsheet takes for an option or a formula.
std::string NameMistake(std::string_view name);

}  // namespace halfstep
