#include "farm/coordinator.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "farm/grants.h"
#include "scene/error.h"

namespace veduta {

using nlohmann::json;

Coordinator::Coordinator(Transport& transport, CoordinatorOptions options, RunLog& log, Progress& progress)
    : transport_(transport),
      options_(std::move(options)),
      log_(log),
      progress_(progress),
      given_up_(static_cast<size_t>(transport.size()), 0),
      watch_(transport.size(), options_.rank_timeout_s, 0),
      trust_(transport.size()) {}

void Coordinator::broadcast(const Message& message) {
  for (int rank = 0; rank < transport_.size(); ++rank) transport_.send(rank, message);
}

void Coordinator::start() {
  tally_.attempt = next_attempt(options_.run);
  const auto city = read_city_counts(options_.run);
  if (city) {
    tally_.city = *city;
    remove_unfinished_preparation(options_.run);
    read_done_cells();
    if (tally_.complete()) {
      phase_ = Phase::finishing;
      for (int rank = 0; rank < transport_.size(); ++rank) left_.insert(rank);
      return;
    }
  }
  StartMessage start;
  start.attempt = tally_.attempt, start.fingerprint = FixedText<64>(options_.fingerprint);
  broadcast(start);
  log_.info("started", json{{"attempt", tally_.attempt}, {"ranks", transport_.size()}});
  if (city) return begin_baking();
  phase_ = Phase::preparing;
  preparing_.emplace(transport_, options_.run, log_, progress_, now_s());
}

/// What the journal holds: these cells are not baked again.
void Coordinator::read_done_cells() {
  if (tally_.city.cells == 0)
    throw Error(ExitStatus::bad_input,
                options_.run.directory.string() +
                    ": no view-cell: nowhere to stand; check cells.region and navigation.eye_height");
  const auto cell_count = static_cast<uint32_t>(tally_.city.cells);
  const Journal journal = read_journal(options_.run, options_.fingerprint, cell_count);
  done_.assign(cell_count, false);
  for (uint32_t cell = 0; cell < cell_count; ++cell) done_[cell] = journal.cells[cell].shard >= 0;
  tally_.resumed = tally_.done = journal.done;
  tally_.all_visible = journal.all_visible;
  tally_.renderers.insert(journal.renderers.begin(), journal.renderers.end());
  // After a kill nothing that was recorded is lost; this is what is.
  const std::vector<bool> held = cells_in_hands(options_.run.log(), cell_count);
  const auto in_hands = std::count(held.begin(), held.end(), true);
  long again = 0;
  for (uint32_t cell = 0; cell < held.size(); ++cell) again += held[cell] && !done_[cell];
  log_.info("journal", json{{"done", journal.done},
                            {"cells", cell_count},
                            {"in_hands", in_hands},
                            {"baked_again", again},
                            {"torn_bytes", journal.torn_bytes},
                            {"duplicates", journal.duplicates},
                            {"conflicts", journal.conflicts}});
  if (journal.conflicts > 0)
    log_.warning(
        "conflicting answers",
        json{{"conflicts", journal.conflicts}, {"examples", journal.conflict_examples}},
        fmt::format("{} second answers differ from the first, which counts; both are conservative. {}",
                    journal.conflicts, journal.conflict_examples.front()));
  if (journal.done == 0 && journal.torn_bytes == 0 && in_hands == 0) return;
  std::string line = fmt::format("continuing: {} of {} cells are done", journal.done, cell_count);
  if (in_hands > 0)
    line += fmt::format("; {} were in hands when it stopped, {} of them are baked again", in_hands, again);
  if (journal.torn_bytes > 0) line += fmt::format("; {} torn bytes were cut", journal.torn_bytes);
  progress_.note(line);
}

void Coordinator::begin_baking() {
  book_ = std::make_unique<LeaseBook>(done_,
                                      static_cast<uint32_t>(transport_.size()) * options_.workers_per_rank);
  phase_ = Phase::baking;
  phase_began_ = Clock::now();
  broadcast(OpenMessage{});
}

void Coordinator::handle(int from, const Message& message) {
  if (watch_.heard(from, watched_.now_s()))
    log_.warning("rank back", json{{"rank", from}}, watch_.name(from) + " is back");
  if (const auto* ready = std::get_if<ReadyMessage>(&message)) {
    watch_.introduce(from, ready->host.text(), ready->workers);
    ready_.insert(from);
  } else if (const auto* waiting = std::get_if<WaitingMessage>(&message)) {
    if (preparing_) preparing_->on_waiting({from, static_cast<int>(waiting->slot)}, *waiting);
  } else if (const auto* prepared = std::get_if<PreparedMessage>(&message)) {
    if (!preparing_) return;
    preparing_->on_prepared({from, static_cast<int>(prepared->slot)}, *prepared, now_s());
    if (preparing_->complete()) on_preparation_complete();
  } else if (const auto* idle = std::get_if<IdleMessage>(&message)) {
    on_idle({from, static_cast<int>(idle->slot)}, *idle);
  } else if (const auto* cell = std::get_if<CellMessage>(&message)) {
    on_cell(from, *cell);
  } else if (const auto* done = std::get_if<LeaseDoneMessage>(&message)) {
    if (book_) book_->lease_done(done->lease);
    wait_for_lease({from, static_cast<int>(done->slot)});
  } else if (const auto* lost = std::get_if<LostMessage>(&message)) {
    on_lost({from, static_cast<int>(lost->slot)}, *lost);
  } else if (const auto* note = std::get_if<NoteMessage>(&message)) {
    log_.info("note", json{{"rank", from}, {"text", note->text.text()}}, note->text.text());
  } else if (const auto* failed = std::get_if<FailedMessage>(&message)) {
    throw Error(static_cast<ExitStatus>(failed->status), failed->message.text());
  } else if (std::holds_alternative<LeftMessage>(message)) {
    left_.insert(from);
    // A rank that was asked to stop takes the others with it.
    if (phase_ != Phase::finishing) finish(true);
  }
}

void Coordinator::on_preparation_complete() {
  tally_.city = preparing_->city();
  tally_.stages = preparing_->stages();
  preparing_.reset();
  tally_.prepare_s = now_s();
  log_.info("prepared", json{{"cells", tally_.city.cells},
                             {"objects", tally_.city.objects},
                             {"triangles", tally_.city.triangles},
                             {"elapsed_s", tally_.prepare_s}});
  progress_.note(fmt::format("prepared {} view-cells, {} objects, {} triangles in {:.1f} s ({})",
                             tally_.city.cells, tally_.city.objects, tally_.city.triangles, tally_.prepare_s,
                             stages_text(tally_.stages)));
  read_done_cells();
  write_city_counts(options_.run, tally_.city);
  if (phase_ == Phase::preparing) begin_baking();
}

void Coordinator::on_idle(WorkerId worker, const IdleMessage& message) {
  open_.insert(worker);
  wait_for_lease(worker);
  const std::string renderer = message.renderer.text();
  if (!tally_.renderers.insert(renderer).second) return;
  log_.info("renderer", json{{"rank", worker.rank}, {"renderer", renderer}}, "renderer: " + renderer);
  if (tally_.renderers.size() > 1)
    log_.warning("mixed renderers", json{{"rank", worker.rank}, {"renderer", renderer}},
                 "cells are baked by different renderers, so that a digest may differ from one machine's: " +
                     renderer);
}

/// Who waits for a lease holds none: one in its name never reached it, because the child that was idle died.
void Coordinator::wait_for_lease(WorkerId worker) {
  if (book_) book_->take_back(worker);
  idle_.insert(worker);
}

void Coordinator::on_cell(int rank, const CellMessage& message) {
  trust_.finished(rank);
  if (!book_ || !book_->cell_done(message.lease, message.cell, now_s())) return;
  ++tally_.done;
  tally_.bake_us += message.bake_us;
}

void Coordinator::hand_out() {
  for (auto worker = idle_.begin(); worker != idle_.end();) {
    if (watch_.silent(worker->rank) || trust_.barred(worker->rank)) {
      ++worker;
      continue;
    }
    const auto lease = book_->grant(*worker, now_s());
    if (!lease) return;  // nor for anybody else
    log_.info("lease", json{{"rank", worker->rank},
                            {"slot", worker->slot},
                            {"lease", lease->id},
                            {"begin", lease->begin},
                            {"count", lease->count}});
    GrantMessage grant;
    grant.lease = lease->id, grant.slot = static_cast<uint32_t>(worker->slot);
    grant.begin = lease->begin, grant.count = lease->count;
    transport_.send(worker->rank, grant);
    worker = idle_.erase(worker);
  }
}

void Coordinator::tick(bool stop) {
  watched_.look();
  if (phase_ == Phase::finishing) return;
  if (stop) return finish(true);
  for (const int rank : watch_.newly_silent(watched_.now_s())) on_silent(rank);
  if (preparing_) preparing_->tick(now_s(), watch_);
  if (phase_ != Phase::baking) return;
  if (book_->complete()) return finish(false);
  hand_out();
  progress_.cells(tally_.done, tally_.city.cells, static_cast<uint32_t>(open_.size()), tally_.retries);
}

void Coordinator::finish(bool drain) {
  if (phase_ == Phase::finishing) return;
  if (phase_ == Phase::baking) {
    tally_.bake_s = std::chrono::duration<double>(Clock::now() - phase_began_).count();
    if (book_->complete())
      progress_.cells(tally_.done, tally_.city.cells, static_cast<uint32_t>(open_.size()), tally_.retries);
  }
  phase_ = Phase::finishing;
  phase_began_ = Clock::now();
  FinishMessage message;
  message.drain = drain ? 1 : 0;
  broadcast(message);
}

bool Coordinator::finished() const {
  if (phase_ != Phase::finishing) return false;
  if (Clock::now() - phase_began_ > std::chrono::seconds(10)) return true;
  for (int rank = 0; rank < transport_.size(); ++rank)
    if (!left_.contains(rank) && !watch_.silent(rank)) return false;
  return true;
}

}  // namespace veduta
