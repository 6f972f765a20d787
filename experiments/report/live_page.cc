#include "experiments/report/live_page.h"

#include "experiments/report/page_text.h"
#include "wpg/check.h"

// page_templates.S
extern "C" {
extern const char halfstep_live_template[];
extern const char halfstep_live_template_end[];
}

namespace halfstep {
namespace {

std::string PageOf(std::string_view socket, const nlohmann::json& data) {
  const std::string_view page(
      halfstep_live_template,
      static_cast<size_t>(halfstep_live_template_end - halfstep_live_template));
  return WithData(WithText(page, "@HALFSTEP_SOCKET@", socket), data);
}

}  // namespace

std::string LivePage(std::string_view socket) {
  // The policy ends at the first ";", and its attribute at the first quote.
  HALFSTEP_CHECK(socket.find_first_of("\"'<>&; ,") == std::string_view::npos,
                 "no address: " << socket);
  return PageOf(socket, nlohmann::json::object());
}

std::string RecordingPage(const nlohmann::json& recording) { return PageOf("'none'", recording); }

}  // namespace halfstep
