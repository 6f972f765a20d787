#include "experiments/report/page_text.h"

#include "wpg/check.h"

namespace halfstep {
namespace {

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

std::string WithText(std::string_view page, std::string_view mark, std::string_view text) {
  const size_t at = page.find(mark);
  HALFSTEP_CHECK(at != std::string_view::npos, "the page has no place " << mark);
  return std::string(page.substr(0, at)).append(text).append(page.substr(at + mark.size()));
}

std::string WithData(std::string_view page, const nlohmann::json& data) {
  return WithText(page, "@HALFSTEP_DATA@", ScriptText(data));
}

}  // namespace halfstep
