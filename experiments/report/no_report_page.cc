#include "experiments/report/live_page.h"
#include "experiments/report/report_page.h"
#include "wpg/check.h"

namespace halfstep {
namespace {

std::string NoPage() {
  HALFSTEP_CHECK(HasReport(), "this build has no page");
  return "";
}

}  // namespace

bool HasReport() { return false; }
std::string ReportPage(const nlohmann::json&) { return NoPage(); }
std::string SweepPage(const nlohmann::json&) { return NoPage(); }
std::string LivePage(std::string_view) { return NoPage(); }
std::string RecordingPage(const nlohmann::json&) { return NoPage(); }

}  // namespace halfstep
