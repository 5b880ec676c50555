#include "farm/run_status.h"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "farm/grants.h"
#include "farm/lock.h"
#include "farm/progress.h"
#include "scene/error.h"

namespace veduta {
namespace {

/// The report is written last: after the file, unless --no-merge was given.
bool has_ended(const RunPaths& run) {
  const auto report = nlohmann::json::parse(read_text_file(run.report()).value_or(""), nullptr, false);
  std::error_code ignored;
  return report.is_object() && (report.value("merge", nlohmann::json()).is_null() ||
                                std::filesystem::exists(run.result(), ignored));
}

double rate_since_begin(const RunPaths& run, uint64_t done) {
  const auto begin = last_bake_begin(run.log());
  if (!begin || done <= begin->done) return 0;
  const double now =
      std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  return now > begin->t ? static_cast<double>(done - begin->done) / (now - begin->t) : 0;
}

std::string cells_text(const RunStatus& status) {
  const Journal& journal = status.journal;
  const uint64_t total = status.cells();
  std::string text =
      fmt::format("cells {}/{} ({} %)", journal.done, total, total ? 100 * journal.done / total : 100);
  if (status.cells_per_s > 0)
    text += fmt::format(", {:.1f} cells/s, {} left", status.cells_per_s, duration_text(status.left_s()));
  text += fmt::format(", {} all visible", journal.all_visible);
  if (journal.conflicts > 0)
    text += fmt::format(", {} second answers differ from the first", journal.conflicts);
  return text;
}

std::string preparation_text(const RunStatus& status) {
  if (!status.preparation) return "not prepared yet";
  const auto done = status.preparation->done.size();
  return fmt::format("not prepared yet: {}{}", name_of(status.preparation->stage),
                     done > 0 ? fmt::format(", {} parts are done", done) : "");
}

}  // namespace

double RunStatus::left_s() const {
  return cells_per_s > 0 ? static_cast<double>(cells() - journal.done) / cells_per_s : 0;
}

RunStatus read_run_status(const RunPaths& run) {
  const auto stored = read_text_file(run.fingerprint());
  if (!stored)
    throw Error(ExitStatus::bad_input,
                run.directory.string() + ": is no run directory of veduta bake; it has no fingerprint");
  RunStatus status;
  status.fingerprint = stored->substr(0, stored->find('\n'));
  status.holder = lock_holder(run.lock());
  status.attempts = next_attempt(run) - 1;
  status.city = read_city_counts(run);
  if (status.city)
    status.journal = read_journal(run, status.fingerprint, static_cast<uint32_t>(status.city->cells));
  else
    status.preparation = read_preparation_state(run);
  const bool complete = status.city && status.journal.done == status.city->cells && has_ended(run);
  status.state = complete ? "complete" : status.holder.empty() ? "stopped" : "running";
  if (status.state == "running" && status.city)
    status.cells_per_s = rate_since_begin(run, status.journal.done);
  return status;
}

std::string status_line(const RunPaths& run, const RunStatus& status) {
  return fmt::format("{}: {}{}; {}; attempt {}", run.directory.string(), status.state,
                     status.holder.empty() ? "" : " (" + status.holder + ")",
                     status.city ? cells_text(status) : preparation_text(status), status.attempts);
}

std::string status_json(const RunStatus& status) {
  const Journal& journal = status.journal;
  return nlohmann::json{{"state", status.state},
                        {"attempts", status.attempts},
                        {"prepared", status.city.has_value()},
                        {"preparing", status.preparation ? name_of(status.preparation->stage) : ""},
                        {"parts_done", status.preparation ? status.preparation->done.size() : 0},
                        {"cells", status.cells()},
                        {"done", journal.done},
                        {"cells_per_s", status.cells_per_s},
                        {"left_s", status.left_s()},
                        {"all_visible", journal.all_visible},
                        {"torn_bytes", journal.torn_bytes},
                        {"duplicates", journal.duplicates},
                        {"conflicts", journal.conflicts},
                        {"conflict_examples", journal.conflict_examples},
                        {"renderers", journal.renderers},
                        {"fingerprint", status.fingerprint},
                        {"holder", status.holder}}
      .dump(2);
}

}  // namespace veduta
