#include "experiments/server/news_board.h"

#include <utility>

namespace halfstep {
namespace {

template <typename T>
void AppendFrom(const std::vector<T>& all, size_t* told, std::vector<T>* news) {
  news->insert(news->end(), all.begin() + static_cast<std::ptrdiff_t>(*told), all.end());
  *told = all.size();
}

template <typename T>
void Move(std::vector<T>* from, std::vector<T>* to) {
  to->insert(to->end(), std::make_move_iterator(from->begin()),
             std::make_move_iterator(from->end()));
}

}  // namespace

void NewsBoard::Add(const std::function<void(EpisodeNews*)>& change) {
  bool told;
  {
    const std::lock_guard lock(mutex_);
    change(&news_);
    told = std::exchange(told_, false);
  }
  if (told) wake_();
}

void NewsBoard::Wait(const std::string& reason) {
  Add([&](EpisodeNews* news) { news->waiting = reason; });
}

void NewsBoard::Prepare(std::shared_ptr<const SweptVolumes> volumes) {
  Add([&](EpisodeNews* news) { news->volumes = std::move(volumes); });
}

void NewsBoard::Refuse(const std::string& sentence) {
  Add([&](EpisodeNews* news) {
    constexpr size_t kMost = 100;
    if (news->refusals.size() < kMost) news->refusals.push_back(sentence);
  });
}

void NewsBoard::Tick(const EpisodeTick& tick, bool held) {
  const Episode& record = tick.record;
  // Copied before anybody waits for it.
  EpisodeNews fresh;
  fresh.known.assign(record.known.begin() + static_cast<std::ptrdiff_t>(worlds_),
                     record.known.end());
  AppendFrom(record.worlds, &worlds_, &fresh.worlds);
  const bool another = record.walks.size() > walks_ || tick.executor.stopped() != stopped_;
  if (another) {
    executed_ = std::make_shared<const SuperposedWalk>(tick.executor.executed());
    first_half_step_ = tick.executor.first();
  }
  stopped_ = tick.executor.stopped();
  AppendFrom(record.walks, &walks_, &fresh.walks);
  AppendFrom(record.grants, &grants_, &fresh.grants);
  AppendFrom(record.events, &events_, &fresh.events);
  Add([&](EpisodeNews* news) {
    news->waiting.reset();
    Move(&fresh.worlds, &news->worlds);
    Move(&fresh.known, &news->known);
    Move(&fresh.walks, &news->walks);
    Move(&fresh.grants, &news->grants);
    Move(&fresh.events, &news->events);
    news->first_walk = walks_ - news->walks.size();
    news->first_grant = grants_ - news->grants.size();
    news->executed = executed_;
    news->first_half_step = first_half_step_;
    news->num_walks = walks_;
    news->now = tick.now;
    news->stopped = stopped_;
    news->held = held;
  });
}

EpisodeNews NewsBoard::Take() {
  EpisodeNews news;
  const std::lock_guard lock(mutex_);
  std::swap(news, news_);
  told_ = true;
  return news;
}

}  // namespace halfstep
