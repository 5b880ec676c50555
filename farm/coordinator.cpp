#include "farm/coordinator.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "scene/error.h"

namespace veduta {

using nlohmann::json;

Coordinator::Coordinator(Transport& transport, CoordinatorOptions options, RunLog& log, Progress& progress)
    : transport_(transport), options_(std::move(options)), log_(log), progress_(progress) {}

void Coordinator::broadcast(const Message& message) {
  for (int rank = 0; rank < transport_.size(); ++rank) transport_.send(rank, message);
}

void Coordinator::start() {
  tally_.attempt = next_attempt(options_.run);
  const auto city = read_city_counts(options_.run);
  if (city) {
    tally_.city = *city;
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
  log_.info("journal", json{{"done", journal.done},
                            {"cells", cell_count},
                            {"torn_bytes", journal.torn_bytes},
                            {"duplicates", journal.duplicates},
                            {"conflicts", journal.conflicts}});
  if (journal.conflicts > 0)
    log_.warning(
        "conflicting answers",
        json{{"conflicts", journal.conflicts}, {"examples", journal.conflict_examples}},
        fmt::format("{} second answers differ from the first, which counts; both are conservative. {}",
                    journal.conflicts, journal.conflict_examples.front()));
  if (journal.done == 0 && journal.torn_bytes == 0) return;
  progress_.note(fmt::format(
      "continuing: {} of {} cells are done{}", journal.done, cell_count,
      journal.torn_bytes == 0 ? "" : fmt::format(", {} torn bytes were cut", journal.torn_bytes)));
}

void Coordinator::begin_baking() {
  book_ = std::make_unique<LeaseBook>(done_,
                                      static_cast<uint32_t>(transport_.size()) * options_.workers_per_rank);
  phase_ = Phase::baking;
  phase_began_ = Clock::now();
  broadcast(OpenMessage{});
}

void Coordinator::handle(int from, const Message& message) {
  if (const auto* ready = std::get_if<ReadyMessage>(&message)) {
    workers_ += ready->workers;
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
    on_cell(*cell);
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

void Coordinator::on_cell(const CellMessage& message) {
  if (!book_ || !book_->cell_done(message.lease, message.cell, now_s())) return;
  ++tally_.done;
  tally_.bake_us += message.bake_us;
}

void Coordinator::on_lost(WorkerId worker, const LostMessage& message) {
  idle_.erase(worker), open_.erase(worker);
  ++tally_.retries;
  log_.info("worker lost",
            json{{"rank", worker.rank},
                 {"slot", worker.slot},
                 {"lease", message.lease},
                 {"reason", message.reason.text()}},
            fmt::format("worker {} of rank {} ended: {}", worker.slot, worker.rank, message.reason.text()));
  const auto poison = book_ && message.lease != 0 ? book_->lease_lost(message.lease, true) : std::nullopt;
  if (book_) book_->take_back(worker);
  if (poison) record_all_visible(*poison, message.reason.text());
  given_up_ += message.given_up;
  const auto condemned = preparing_ ? preparing_->on_lost(worker, message) : std::nullopt;
  const bool none_left = ready_.size() == static_cast<size_t>(transport_.size()) && given_up_ == workers_;
  if (!condemned && !none_left) return;
  throw Error(
      ExitStatus::defect,
      fmt::format("{}: {} ended its worker three times: {}; see {}", options_.run.directory.string(),
                  condemned    ? fmt::format("the preparation ({})", *condemned)
                  : preparing_ ? "the preparation"
                               : "opening the city",
                  message.reason.text(),
                  worker_log(options_.run, tally_.attempt, worker.rank, static_cast<uint32_t>(worker.slot))
                      .string()));
}

/// Safe, never lost: a cell that cannot be baked sees everything.
void Coordinator::record_all_visible(uint32_t cell, const std::string& why) {
  if (!all_visible_)
    all_visible_ = std::make_unique<ShardWriter>(all_visible_shard_file(options_.run, tally_.attempt),
                                                 options_.fingerprint,
                                                 tally_.renderers.empty() ? "" : *tally_.renderers.begin());
  CellRecord record;
  record.cell = cell, record.status = CellStatus::all_visible;
  for (uint32_t object = 0; object < tally_.city.objects; ++object)
    record.row.push_back({object, completely_visible});
  all_visible_->append(record);
  all_visible_->sync();
  if (!book_->cell_done(0, cell, now_s())) return;
  ++tally_.done, ++tally_.all_visible;
  log_.warning(
      "cell all visible", json{{"cell", cell}, {"reason", why}},
      fmt::format("cell {} ended its worker three times ({}); it is recorded all visible", cell, why));
}

void Coordinator::hand_out() {
  for (auto worker = idle_.begin(); worker != idle_.end();) {
    const auto lease = book_->grant(*worker, now_s());
    if (!lease) return;  // nor for anybody else
    GrantMessage grant;
    grant.lease = lease->id, grant.slot = static_cast<uint32_t>(worker->slot);
    grant.begin = lease->begin, grant.count = lease->count;
    transport_.send(worker->rank, grant);
    worker = idle_.erase(worker);
  }
}

void Coordinator::tick(bool stop) {
  if (phase_ == Phase::finishing) return;
  if (stop) return finish(true);
  if (preparing_) preparing_->tick(now_s());
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
  return phase_ == Phase::finishing && (left_.size() == static_cast<size_t>(transport_.size()) ||
                                        Clock::now() - phase_began_ > std::chrono::seconds(10));
}

}  // namespace veduta
