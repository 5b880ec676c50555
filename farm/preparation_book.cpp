#include "farm/preparation_book.h"

#include "scene/error.h"

namespace veduta {

void PreparationBook::begin(Stage stage, uint32_t parts) {
  stage_ = stage;
  states_.assign(parts, State::settled);
  kills_.assign(parts, 0);
  finished_ = outstanding_ = 0;
  for (uint32_t part = 0; part < parts; ++part) want(part);
}

/// Stages without parts are passed over.
void PreparationBook::begin_next_stage() {
  while (!complete_ && outstanding_ == 0) {
    if (stage_ == Stage::import)
      begin(Stage::flood, tiles_);
    else if (stage_ == Stage::flood)
      begin(Stage::cells, tiles_);
    else if (stage_ == Stage::cells)
      begin(Stage::shrink, blocks_);
    else if (stage_ == Stage::shrink)
      begin(Stage::finish, 1);
    else
      complete_ = true;
  }
}

void PreparationBook::want(uint32_t part) {
  State& state = states_[part];
  if (state == State::settled)
    state = State::queued, queue_.push_back(part), ++outstanding_;
  else if (state == State::held)
    state = State::held_and_wanted, ++outstanding_;
}

/// The part that the worker held: settled, or queued again when it was wanted meanwhile.
uint32_t PreparationBook::let_go(WorkerId worker) {
  const auto held = held_.find(worker);
  const uint32_t part = held->second;
  held_.erase(held);
  --outstanding_;
  const bool wanted = states_[part] == State::held_and_wanted;
  states_[part] = State::settled;
  if (wanted) --outstanding_, want(part);
  return part;
}

std::optional<PreparationPart> PreparationBook::grant(WorkerId worker) {
  if (queue_.empty() || held_.contains(worker)) return std::nullopt;
  const uint32_t part = queue_.front();
  queue_.pop_front();
  states_[part] = State::held;
  held_[worker] = part;
  return PreparationPart{stage_, part, kills_[part] > 0};
}

void PreparationBook::done(WorkerId worker, const std::vector<uint32_t>& again) {
  if (!held_.contains(worker))
    throw Error(ExitStatus::defect, "preparation: an answer from a worker that was not asked");
  kills_[let_go(worker)] = 0;
  ++finished_;
  for (const uint32_t tile : again) {
    if (stage_ != Stage::flood || tile >= states_.size())
      throw Error(ExitStatus::defect, "preparation: there is no tile " + std::to_string(tile) + " to flood");
    want(tile);
  }
  begin_next_stage();
}

std::optional<PreparationPart> PreparationBook::lost(WorkerId worker, bool counts) {
  if (!held_.contains(worker)) return std::nullopt;
  const uint32_t part = let_go(worker);
  want(part);
  if (!counts) return std::nullopt;
  if (++kills_[part] < kills_allowed) return std::nullopt;
  return PreparationPart{stage_, part, true};
}

}  // namespace veduta
