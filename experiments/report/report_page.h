#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace halfstep {

/// Whether this build has the page (CMake option HALFSTEP_REPORT, and npm when it was configured).
bool HasReport();

/// The page with `data` inserted: one HTML file that needs no other. Texts in `data` may hold
/// anything: the page shows them as text, and "<" is escaped. Precondition: HasReport().
std::string ReportPage(const nlohmann::json& data);

}  // namespace halfstep
