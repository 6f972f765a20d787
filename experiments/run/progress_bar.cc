#include "experiments/run/progress_bar.h"

#include <unistd.h>

#include <cstdio>
#include <utility>

#include "wpg/files/text.h"

namespace halfstep {

ProgressBar::ProgressBar(std::string label, bool quiet, std::string of)
    : label_(std::move(label)),
      of_(std::move(of)),
      enabled_(!quiet && isatty(STDERR_FILENO) == 1),
      begin_(std::chrono::steady_clock::now()),
      last_(begin_) {}

ProgressBar::~ProgressBar() {
  if (drawn_) std::fputs("\r\033[K", stderr);
}

void ProgressBar::Update(double done) {
  const std::chrono::steady_clock::time_point now = std::chrono::steady_clock::now();
  const std::chrono::duration<double> elapsed = now - begin_;
  if (!enabled_ || elapsed.count() < 1.0 || now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  drawn_ = true;
  constexpr int kWidth = 30;
  const int filled = static_cast<int>(done * kWidth);
  std::fputs(Formatted("\r\033[K%s [%.*s%*s] %3.0f %%%s%s", label_.c_str(), filled,
                       "##############################", kWidth - filled, "", 100.0 * done,
                       of_.c_str(), best_.c_str())
                 .c_str(),
             stderr);
}

void ProgressBar::Best(double duration) { best_ = Formatted(", best so far %.3f s", duration); }

}  // namespace halfstep
