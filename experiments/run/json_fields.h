#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>

#include "wpg/files/fields.h"

namespace halfstep {

/// The keys that `declare` declares with their values, as a JSON object in their order. Numbers are
/// as a file has them, those in `_deg` in degrees; no value is null, and so is what is not finite.
nlohmann::ordered_json JsonOf(const std::function<void(Fields&)>& declare);

}  // namespace halfstep
