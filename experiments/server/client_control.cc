#include "experiments/server/client_control.h"

#include <chrono>
#include <utility>

#include "experiments/control/controller_lost.h"
#include "experiments/live/messages.h"
#include "experiments/server/control_messages.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

using control::ControllerLost;
using control::JointCommand;
using std::chrono::duration;

std::shared_ptr<const std::string> Shared(const nlohmann::json& message) {
  return std::make_shared<const std::string>(MessageText(message));
}

class ClientController final : public control::TrackingController {
 public:
  explicit ClientController(ClientControl* client) : client_(*client) {}

  JointCommand Command(const control::MeasuredState& measured, const control::PlannedState& then,
                       const control::PlannedState& next) override {
    return client_.Ask(measured, then, next);
  }
  std::unique_ptr<TrackingController> Clone() const override {
    return std::make_unique<ClientController>(*this);
  }

 private:
  ClientControl& client_;
};

}  // namespace

void ClientControl::Describe(const control::ControlledRobot& robot) {
  const auto message = Shared(ControlledMessage(robot));
  const std::lock_guard lock(mutex_);
  messages_.push_back(message);
}

void ClientControl::WaitForAnswer(std::unique_lock<std::mutex>* lock, double t) {
  const auto done = [this] { return !answers_.empty() || !lost_.empty(); };
  const auto lose = [&](const std::string& of_client, const std::string& of_none) {
    if (done()) return;
    lost_ = controlled_ ? "the client that controls the robot " + of_client +
                              Formatted(", asked for %.3f s", t)
                        : "no client controlled the robot" + of_none;
  };
  if (options_.patience) {
    changed_.wait_for(*lock, options_.stop, duration<double>(*options_.patience), done);
  } else {
    changed_.wait(*lock, options_.stop, done);
  }
  if (!options_.stop.stop_requested()) {
    const std::string within = " within " + ShortestText(options_.patience.value_or(0.0)) + " s";
    return lose("did not answer" + within, within);
  }
  if (controlled_) changed_.wait_for(*lock, std::chrono::seconds(1), done);
  lose("did not answer", "");
}

JointCommand ClientControl::Ask(const control::MeasuredState& measured,
                                const control::PlannedState& then,
                                const control::PlannedState& next) {
  std::unique_lock lock(mutex_);
  ++asked_;
  messages_.push_back(Shared(ControlMessage(asked_, measured, then, next)));
  const bool controlled = controlled_;
  lock.unlock();
  if (!controlled) calls_.wait("no client controls the robot yet");
  calls_.wake();
  lock.lock();
  WaitForAnswer(&lock, next.t);
  if (answers_.empty()) throw ControllerLost(lost_);
  const JointCommand command = answers_.front();
  answers_.pop_front();
  return command;
}

void ClientControl::Begin() {
  const std::lock_guard lock(mutex_);
  controlled_ = true;
}

void ClientControl::Answer(const Commanded& command) {
  const std::lock_guard lock(mutex_);
  if (command.number != answered_ + 1) {
    throw InputError({Formatted("command.n: %ld ", command.number) +
                      (command.number <= answered_ ? "was answered already" : "is too early") +
                      Formatted(" (valid: %ld)", answered_ + 1)});
  }
  ++answered_;
  answers_.push_back({command.q, command.speeds});
  changed_.notify_all();
}

void ClientControl::Lose(const std::string& sentence) {
  const std::lock_guard lock(mutex_);
  if (lost_.empty()) lost_ = sentence;
  changed_.notify_all();
}

bool ClientControl::asks() const {
  const std::lock_guard lock(mutex_);
  return answered_ < asked_;
}

std::vector<std::shared_ptr<const std::string>> ClientControl::TakeMessages() {
  const std::lock_guard lock(mutex_);
  return std::exchange(messages_, {});
}

control::MakeController MakeClientControllers(ClientControl* client) {
  return [client](const control::ControlledRobot& robot) {
    client->Describe(robot);
    return std::make_unique<ClientController>(client);
  };
}

}  // namespace halfstep
