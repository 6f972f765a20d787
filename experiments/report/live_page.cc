#include "experiments/report/live_page.h"

namespace halfstep {

std::string LivePage(std::string_view socket) {
  return "<!doctype html><title>halfstep</title>\n<p>Messages are at " + std::string(socket) +
         "</p>\n";
}

}  // namespace halfstep
