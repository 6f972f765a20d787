#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "wpg/robot/not_covered.h"

namespace halfstep {

/// The list as JSON: objects of kind, subject and sentence, as in certificate.json.
nlohmann::ordered_json NotCoveredJson(const std::vector<NotCovered>& list);

/// Reads it back, from the member `not_covered` of an object. Throws InputError, with `path` at its
/// front, for what is no such list.
std::vector<NotCovered> ReadNotCovered(const nlohmann::json& object, const std::string& path);

}  // namespace halfstep
