#include "experiments/report/report_page.h"
#include "wpg/check.h"

namespace halfstep {

bool HasReport() { return false; }

std::string ReportPage(const nlohmann::json&) {
  HALFSTEP_CHECK(HasReport(), "this build has no page");
  return "";
}

}  // namespace halfstep
