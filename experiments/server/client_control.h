#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "experiments/control/controllers.h"
#include "experiments/server/client_message.h"

namespace halfstep {

/// Lets a client control a simulated robot: between the thread that simulates, which asks for every
/// command and waits for it, and the thread of the clients. No answer hangs on a clock.
class ClientControl {
 public:
  /// How it waits for the client.
  struct Options {
    std::optional<double> patience = {};  ///< for an answer [s]; none: as long as it takes
    std::stop_token stop = {};            ///< then it waits for a second at most
  };
  /// Called in the thread that simulates.
  struct Calls {
    std::function<void()> wake = {};  ///< there is something to tell the client
    std::function<void(const std::string& reason)> wait = {};  ///< no client controls yet
  };
  /// Nobody controls yet.
  ClientControl(Options options, Calls calls)
      : options_(std::move(options)), calls_(std::move(calls)) {}

  // Of the thread that simulates.

  /// What the client is to know of its robot, before the first question.
  void Describe(const control::ControlledRobot& robot);
  /// Asks the client, and waits for its answer. Throws ControllerLost when there will be none.
  control::JointCommand Ask(const control::MeasuredState& measured,
                            const control::PlannedState& then, const control::PlannedState& next);

  // Of the thread of the clients.

  /// A client has come that controls.
  void Begin();
  /// Takes an answer. Throws InputError when its number is not the next one.
  void Answer(const Commanded& command);
  /// There will be no more answers, and why.
  void Lose(const std::string& sentence);
  /// Whether an answer is waited for.
  bool asks() const;
  /// What is to be told to the client that controls since the last call, in order.
  std::vector<std::shared_ptr<const std::string>> TakeMessages();

 private:
  // Waits until there is an answer, or never will be one; `lock` is held.
  void WaitForAnswer(std::unique_lock<std::mutex>* lock, double t);

  Options options_;
  Calls calls_;
  mutable std::mutex mutex_;  // of what follows
  std::condition_variable_any changed_;
  std::vector<std::shared_ptr<const std::string>> messages_;
  std::deque<control::JointCommand> answers_;  // not taken yet
  long asked_ = 0, answered_ = 0;              // so many, until now
  bool controlled_ = false;
  std::string lost_;
};

/// Makes controllers that ask the client, whom all of them share: one of them may command. Borrows
/// `client`.
control::MakeController MakeClientControllers(ClientControl* client);

}  // namespace halfstep
