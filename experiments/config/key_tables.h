#pragma once

#include <string>
#include <vector>

#include "wpg/files/key_description.h"

namespace halfstep {

/// The type of a key in words: "number [m/s] or none", "list of maps".
std::string TypeText(const KeyDescription& key);
/// The valid values in words: "0 … 0.5", "certified, sampled"; "" where every value of the type is
/// valid.
std::string RangeText(const KeyDescription& key);

/// Text for a terminal: two lines a key, maps before the keys in them.
std::string KeyScreen(const std::vector<KeyDescription>& keys);
/// A row of a Markdown table: path, type, default, valid values, meaning.
std::string KeyRow(const KeyDescription& key);
/// That table of keys, maps before the keys in them: the tables of experiments/config.md.
std::string KeyMarkdown(const std::vector<KeyDescription>& keys);
/// A JSON schema (draft 7) of a file with these keys. It accepts every file that can be read, but
/// cannot express conditions on several keys.
std::string KeySchema(const std::string& title, const std::vector<KeyDescription>& keys);

}  // namespace halfstep
