#pragma once

#include <memory>
#include <string>

namespace halfstep {

/// The way to one client.
class ClientLine {
 public:
  virtual ~ClientLine() = default;
  /// Sends a message after those before it, without waiting. A client that does not read loses its
  /// line when more than kMostQueuedBytes wait for it.
  virtual void Send(std::shared_ptr<const std::string> message) = 0;
  /// Ends the line now, or when everything that was sent has left.
  virtual void Drop() = 0;
  virtual void Finish() = 0;  ///< when everything that was sent has left
};

/// A client that reads so slowly that more than this waits for it is dropped.
inline constexpr size_t kMostQueuedBytes = size_t{16} << 20;

}  // namespace halfstep
