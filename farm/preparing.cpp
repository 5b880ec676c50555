#include "farm/preparing.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace veduta {

using nlohmann::json;

namespace {

constexpr double save_interval_s = 10;  // syncing costs time, so does doing parts again

}  // namespace

Preparing::Preparing(Transport& transport, RunPaths run, RunLog& log, Progress& progress, double now_s)
    : transport_(transport),
      run_(std::move(run)),
      log_(log),
      progress_(progress),
      book_(read_preparation_state(run_).value_or(PreparationState())),
      stage_began_s_(now_s) {
  if (book_.stage() == Stage::import) return;
  const uint64_t done = book_.parts() - book_.outstanding();
  log_.info("preparation continues", json{{"stage", name_of(book_.stage())}, {"done", done}});
  progress_.note(fmt::format("continuing the preparation: {}, {} of {} parts are done",
                             name_of(book_.stage()), done, book_.parts()));
}

void Preparing::on_prepared(WorkerId worker, const PreparedMessage& message, double now_s) {
  const Stage stage = book_.stage();
  const uint32_t parts = book_.parts();
  if (stage == Stage::import) book_.set_size(message.tiles, message.blocks);
  if (stage == Stage::finish) city_ = {message.cells, message.objects, message.triangles};
  held_.erase(worker);
  ++tally_.runs;
  tally_.worker_s += message.seconds;
  tally_.peak_mb = std::max(tally_.peak_mb, message.peak_mb);
  book_.done(worker, {message.again.begin(), message.again.begin() + message.again_count});
  if (book_.complete() || book_.stage() != stage) close_stage(stage, parts, now_s);
}

void Preparing::save(double now_s) {
  if (book_.stage() == Stage::import || book_.finished() == saved_ || now_s - saved_s_ < save_interval_s)
    return;
  if (book_.stage() != Stage::flood) write_preparation_state(run_, book_.state());
  saved_ = book_.finished(), saved_s_ = now_s;
}

void Preparing::close_stage(Stage stage, uint32_t parts, double now_s) {
  if (parts > 1) progress_.stage(name_of(stage), tally_.runs, tally_.runs);
  tally_.stage = stage, tally_.parts = parts, tally_.seconds = now_s - stage_began_s_;
  log_.info("stage",
            json{{"stage", name_of(stage)},
                 {"parts", tally_.parts},
                 {"runs", tally_.runs},
                 {"elapsed_s", tally_.seconds},
                 {"worker_s", tally_.worker_s},
                 {"peak_mb", tally_.peak_mb}},
            fmt::format("{}: {} part{} in {:.1f} s, at most {:.0f} MB in a worker", name_of(stage),
                        tally_.runs, tally_.runs == 1 ? "" : "s", tally_.seconds, tally_.peak_mb));
  stages_.push_back(tally_);
  tally_ = {};
  stage_began_s_ = saved_s_ = now_s;
  saved_ = 0;
  if (!book_.complete()) write_preparation_state(run_, book_.state());
}

std::optional<std::string> Preparing::on_lost(WorkerId worker, const LostMessage& message) {
  waiting_.erase(worker), held_.erase(worker);
  const auto condemned = book_.lost(worker, message.preparing != 0);
  if (!condemned) return std::nullopt;
  return text(*condemned);
}

std::optional<std::string> Preparing::in_hands_of(int rank) const {
  for (const auto& [worker, part] : held_)
    if (worker.rank == rank) return text(part);
  return std::nullopt;
}

std::string Preparing::text(const PreparationPart& part) const {
  return fmt::format("{}, part {} of {}", name_of(part.stage), part.part + 1, book_.parts());
}

void Preparing::tick(double now_s, const RankWatch& watch) {
  if (book_.complete()) return;
  save(now_s);
  for (auto worker = waiting_.begin(); worker != waiting_.end();) {
    if (watch.silent(worker->first.rank)) {
      ++worker;
      continue;
    }
    const auto part = book_.grant(worker->first);
    if (!part) break;
    PrepareMessage message;
    message.slot = static_cast<uint32_t>(worker->first.slot), message.life = worker->second;
    message.stage = static_cast<uint32_t>(part->stage), message.part = part->part;
    transport_.send(worker->first.rank, message);
    held_[worker->first] = *part;
    worker = waiting_.erase(worker);
  }
  progress_.stage(name_of(book_.stage()), book_.finished(), book_.finished() + book_.outstanding());
}

std::string stages_text(const std::vector<StageTally>& stages) {
  std::string text;
  for (const StageTally& stage : stages)
    text += fmt::format("{}{} {:.1f} s {:.0f} MB", text.empty() ? "" : ", ", name_of(stage.stage),
                        stage.seconds, stage.peak_mb);
  return text;
}

}  // namespace veduta
