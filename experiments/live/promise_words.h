#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "experiments/live/promise.h"

namespace halfstep {

/// As manifest.json has it: status, judged_by, broken, touched (experiments/episodes.md, "Whether
/// the promise held").
nlohmann::ordered_json PromiseJson(const Promise& promise);

/// The reverse of PromiseJson(). Throws nlohmann::json::exception for what it did not write.
Promise PromiseOf(const nlohmann::json& json);

/// How it went, in one line: "'crate' did not keep its r and v from 2.105 s on".
std::string PromiseSentence(const Promise& promise);

/// The same in full for the screen: lines, each with its end.
std::string PromiseText(const Promise& promise);

}  // namespace halfstep
