#pragma once

#include <deque>
#include <memory>
#include <string>

#include "experiments/server/client_line.h"

namespace halfstep {

/// Messages that wait for a client; the first one is under way.
class OutgoingQueue {
 public:
  /// Whether it was taken: false when too much waits already.
  bool Add(std::shared_ptr<const std::string> message) {
    if (bytes_ + message->size() > kMostQueuedBytes && !messages_.empty()) return false;
    bytes_ += message->size();
    messages_.push_back(std::move(message));
    return true;
  }
  /// It has left.
  void RemoveFirst() {
    bytes_ -= messages_.front()->size();
    messages_.pop_front();
  }
  /// The oldest; precondition: there is one.
  const std::string& first() const { return *messages_.front(); }
  size_t size() const { return messages_.size(); }  ///< messages that wait

 private:
  std::deque<std::shared_ptr<const std::string>> messages_;
  size_t bytes_ = 0;
};

}  // namespace halfstep
