#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "wpg/files/input_error.h"
#include "wpg/files/yaml_fields.h"

/// What libFuzzer calls with every input; each target defines it.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace halfstep::fuzz {

inline std::string Text(const uint8_t* data, size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Ends the process, for which libFuzzer keeps the input, unless `holds`.
inline void Require(bool holds, const char* what, const std::string& detail = "") {
  if (holds) return;
  std::fprintf(stderr, "Broken: %s\n%s\n", what, detail.c_str());
  std::abort();
}

/// Whether `read` succeeds. The contract of every reader: it does, or it throws InputError, whose
/// complaints are there and begin with `path`. Nothing else is caught.
template <typename Read>
bool Reads(const std::string& path, const Read& read) {
  try {
    read();
    return true;
  } catch (const InputError& error) {
    Require(!error.complaints().empty(), "InputError without complaints");
    for (const std::string& complaint : error.complaints()) {
      Require(complaint.starts_with(path), "a complaint that does not name its file", complaint);
      Require(complaint.size() > path.size() + 3, "a complaint that says nothing", complaint);
    }
    return false;
  }
}

/// A config as YAML.
template <typename Config>
std::string Written(Config config) {
  return WriteYaml([&config](Fields& fields) { DeclareFields(fields, &config); });
}

/// Cuts a text at its first line "--- 8< ---": [0] is before it, [1] behind, or "".
inline std::array<std::string, 2> Halves(const std::string& text) {
  static constexpr std::string_view kCut = "\n--- 8< ---\n";
  const size_t cut = text.find(kCut);
  if (cut == std::string::npos) return {text, ""};
  return {text.substr(0, cut + 1), text.substr(cut + kCut.size())};
}

}  // namespace halfstep::fuzz
