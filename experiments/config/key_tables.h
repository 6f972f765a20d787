#pragma once

#include <string>
#include <vector>

#include "wpg/files/key_description.h"

namespace halfstep {

/// "number [m/s] or none", "list of maps".
std::string TypeText(const KeyDescription& key);
/// What may stand there: "0 … 0.5", "certified, sampled"; "" where anything of its type may.
std::string RangeText(const KeyDescription& key);

/// Two lines a key, maps before what is in them.
std::string KeyScreen(const std::vector<KeyDescription>& keys);
/// A Markdown table, one row a key: the table of experiments/README.md.
std::string KeyMarkdown(const std::vector<KeyDescription>& keys);
/// A JSON schema (draft 7) of a file with these keys. It accepts every file that can be read; what
/// depends on several keys it does not know.
std::string KeySchema(const std::string& title, const std::vector<KeyDescription>& keys);

}  // namespace halfstep
