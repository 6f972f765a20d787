#include "experiments/server/client_inbox.h"

#include <utility>

namespace halfstep {
namespace {

constexpr size_t kMostWaiting = 256;

// Whether `next` makes `last` pointless.
bool Replaces(const Edit& next, const Edit& last) {
  if (next.index() != last.index()) return false;
  if (const auto* carry = std::get_if<Carry>(&next)) {
    // Turns add up.
    const Carry& before = std::get<Carry>(last);
    return carry->obstacle == before.obstacle && before.turn == 0.0;
  }
  return std::holds_alternative<MoveGoal>(next) || std::holds_alternative<Command>(next);
}

}  // namespace

bool ClientInbox::Add(Measurement measurement) {
  const std::lock_guard lock(mutex_);
  if (measurements_.size() >= kMostWaiting) return false;
  measurements_.push_back(std::move(measurement));
  return true;
}

bool ClientInbox::Add(const Edit& edit) {
  const std::lock_guard lock(mutex_);
  if (!edits_.empty() && Replaces(edit, edits_.back())) {
    edits_.back() = edit;
    return true;
  }
  if (edits_.size() >= kMostWaiting) return false;
  edits_.push_back(edit);
  return true;
}

std::vector<ClientInbox::Measurement> ClientInbox::TakeMeasurements() {
  const std::lock_guard lock(mutex_);
  return std::exchange(measurements_, {});
}

std::vector<Edit> ClientInbox::TakeEdits() {
  const std::lock_guard lock(mutex_);
  return std::exchange(edits_, {});
}

}  // namespace halfstep
