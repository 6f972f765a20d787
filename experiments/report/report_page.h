#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace halfstep {

/// Whether this build has the pages (CMake option HALFSTEP_REPORT, and npm when it was configured).
bool HasReport();

/// The page of a run or a comparison with `data` inserted: one HTML file that needs no other. Texts
/// in `data` may hold anything (page_text.h). Precondition: HasReport().
std::string ReportPage(const nlohmann::json& data);

/// The page of a sweep (sweep_report.h), in the same way. Precondition: HasReport().
std::string SweepPage(const nlohmann::json& data);

}  // namespace halfstep
