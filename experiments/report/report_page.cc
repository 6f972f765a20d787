#include "experiments/report/report_page.h"

#include "experiments/report/page_text.h"

// page_templates.S
extern "C" {
extern const char halfstep_report_template[];
extern const char halfstep_report_template_end[];
extern const char halfstep_sweep_template[];
extern const char halfstep_sweep_template_end[];
}

namespace halfstep {

bool HasReport() { return true; }

std::string ReportPage(const nlohmann::json& data) {
  return WithData({halfstep_report_template,
                   static_cast<size_t>(halfstep_report_template_end - halfstep_report_template)},
                  data);
}

std::string SweepPage(const nlohmann::json& data) {
  return WithData({halfstep_sweep_template,
                   static_cast<size_t>(halfstep_sweep_template_end - halfstep_sweep_template)},
                  data);
}

}  // namespace halfstep
