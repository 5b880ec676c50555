// What the coordinator does about workers that die and ranks that are silent.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "farm/coordinator.h"
#include "scene/error.h"

namespace veduta {

using nlohmann::json;

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
  given_up_[static_cast<size_t>(worker.rank)] += message.given_up;
  if (message.lease != 0 && trust_.died(worker.rank)) bar(worker.rank, message);
  const auto condemned = preparing_ ? preparing_->on_lost(worker, message) : std::nullopt;
  if (!condemned && !nobody_left()) return;
  throw Error(
      static_cast<ExitStatus>(message.status),
      fmt::format("{}: {} ended its worker three times: {}{}; see {}", options_.run.directory.string(),
                  condemned    ? fmt::format("the preparation ({})", *condemned)
                  : preparing_ ? "the preparation"
                               : "opening the city",
                  message.reason.text(), transport_.size() > 1 ? ", on " + watch_.name(worker.rank) : "",
                  worker_log(options_.run, tally_.attempt, worker.rank, static_cast<uint32_t>(worker.slot))
                      .string()));
}

/// The others go on without it.
void Coordinator::bar(int rank, const LostMessage& last) {
  log_.warning(
      "rank barred", json{{"rank", rank}, {"reason", last.reason.text()}},
      fmt::format("{} ended its workers {} times in a row, while others finished cells; it gets no more "
                  "of them. The last one: {}",
                  watch_.name(rank), RankTrust::deaths_in_a_row, last.reason.text()));
}

/// There is no worker any more that could get something to do.
bool Coordinator::nobody_left() const {
  if (ready_.size() < static_cast<size_t>(transport_.size())) return false;
  for (int rank = 0; rank < transport_.size(); ++rank)
    if (!watch_.silent(rank) && !trust_.barred(rank) &&
        given_up_[static_cast<size_t>(rank)] < watch_.workers(rank))
      return false;
  return true;
}

/// It may have lost its host, or only be stopped: then its answers come later, and the first one counts.
void Coordinator::on_silent(int rank) {
  const std::string what =
      fmt::format("{} has said nothing for {:g} s", watch_.name(rank), options_.rank_timeout_s);
  const auto part = preparing_ ? preparing_->in_hands_of(rank) : std::nullopt;
  log_.warning("rank silent", json{{"rank", rank}}, what + (part ? "" : "; others go on with what it had"));
  if (part)
    // A part has one writer: nobody else may begin it while that one may still live.
    throw Error(
        ExitStatus::stopped_early,
        fmt::format("{}: {} and was at work on {}; look after that host, then start the same command again",
                    options_.run.directory.string(), what, *part));
  for (uint32_t slot = 0; book_ && slot < watch_.workers(rank); ++slot)
    book_->take_back({rank, static_cast<int>(slot)});
  if (nobody_left())
    throw Error(ExitStatus::stopped_early,
                fmt::format("{}: {}, and no other worker is left; look after the hosts, then start the same "
                            "command again",
                            options_.run.directory.string(), what));
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

}  // namespace veduta
