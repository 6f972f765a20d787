#include "experiments/report/report_page.h"

#include <string_view>

#include "wpg/check.h"

// report_template.S
extern "C" {
extern const char halfstep_report_template[];
extern const char halfstep_report_template_end[];
}

namespace halfstep {
namespace {

constexpr std::string_view kDataGoesHere = "@HALFSTEP_DATA@";

// JSON in an HTML script element: ASCII without "<", so that no text in it can end the element.
std::string ScriptText(const nlohmann::json& data) {
  const std::string json = data.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

bool HasReport() { return true; }

std::string ReportPage(const nlohmann::json& data) {
  const std::string_view page(
      halfstep_report_template,
      static_cast<size_t>(halfstep_report_template_end - halfstep_report_template));
  const size_t at = page.find(kDataGoesHere);
  HALFSTEP_CHECK(at != std::string_view::npos, "the page has no place for data");
  std::string text(page.substr(0, at));
  text += ScriptText(data);
  text += page.substr(at + kDataGoesHere.size());
  return text;
}

}  // namespace halfstep
