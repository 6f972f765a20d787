#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace halfstep {

/// A page with `text` in the place of the first `mark`. Precondition: it has one.
std::string WithText(std::string_view page, std::string_view mark, std::string_view text);

/// A page with `data` in its place for data. Texts in `data` may hold anything: the page shows them
/// as text, and "<" is escaped. Precondition: it has such a place.
std::string WithData(std::string_view page, const nlohmann::json& data);

}  // namespace halfstep
