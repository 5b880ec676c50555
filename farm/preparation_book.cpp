#include "farm/preparation_book.h"

#include "scene/error.h"

namespace veduta {

PreparationBook::PreparationBook(const PreparationState& state) : tiles_(state.tiles), blocks_(state.blocks) {
  begin(state.stage);
  for (const uint32_t part : state.done)
    if (part < states_.size()) states_[part] = State::settled;
  std::erase_if(queue_, [&](uint32_t part) { return states_[part] == State::settled; });
  outstanding_ = queue_.size();
  begin_next_stage();
}

void PreparationBook::begin(Stage stage) {
  const uint32_t parts = stage == Stage::flood || stage == Stage::cells ? tiles_
                         : stage == Stage::shrink                       ? blocks_
                                                                        : 1;
  stage_ = stage;
  states_.assign(parts, State::settled);
  kills_.assign(parts, 0);
  finished_ = outstanding_ = 0;
  for (uint32_t part = 0; part < parts; ++part) want(part);
}

/// When this one is done. Stages without parts are passed over.
void PreparationBook::begin_next_stage() {
  while (!complete_ && outstanding_ == 0)
    if (stage_ == Stage::finish)
      complete_ = true;
    else
      begin(static_cast<Stage>(static_cast<uint32_t>(stage_) + 1));
}

PreparationState PreparationBook::state() const {
  PreparationState state{stage_, tiles_, blocks_, {}};
  // Air that a tile let in may still have to go on into others.
  if (stage_ == Stage::flood) return state;
  for (uint32_t part = 0; part < states_.size(); ++part)
    if (states_[part] == State::settled) state.done.push_back(part);
  return state;
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
  return PreparationPart{stage_, part};
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
  return PreparationPart{stage_, part};
}

}  // namespace veduta
