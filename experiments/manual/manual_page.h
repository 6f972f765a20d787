#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace halfstep {

/// The manual page of a program, for `man`: its commands and their options in the words of their
/// `-h`, exit statuses, files and environment. In the language of groff, UTF-8; the same text each
/// time.
std::string ManualPage(const CLI::App& app, const std::string& version);

}  // namespace halfstep
