// What the journal costs a bake (R14). JSON in, JSON out:
//
//   echo '{"directory": ".", "records": 20000, "rounds": 30, "workers": 2,
//          "cell_times": ["bench/data/cell_times_denhaag.txt"]}' | veduta-bench-journal
//
// In a directory of the disk that a bake would write to. "burst": so many records one after the other, synced
// every second or 16 MB as a shepherd does, against the same records made and not written. "bakes": in each
// round, what a shepherd of so many workers writes in a second of a bake whose cells take these times, then
// the sync of that second. The share of the second is an upper bound of what the bake loses: while a shepherd
// waits for the disk, its workers bake.
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/cell_times.h"
#include "bench/processor_time.h"
#include "pvs/shard.h"

namespace veduta::bench {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

double since_s(Clock::time_point began) {
  return std::chrono::duration<double>(Clock::now() - began).count();
}

/// A record whose payload has about so many bytes.
CellRecord record_of(uint32_t cell, size_t bytes) {
  const size_t empty = encode(CellRecord()).size();
  CellRecord record;
  record.cell = cell, record.bake_us = 1;
  record.row.push_back({0, completely_visible});
  const size_t entry = encode(record).size() - empty;
  const size_t entries = bytes > empty ? (bytes - empty) / entry : 0;
  record.row.clear();
  for (uint32_t object = 0; object < entries; ++object) record.row.push_back({object, completely_visible});
  return record;
}

class Journal {
 public:
  Journal(const std::filesystem::path& directory, uint32_t shards)
      : directory_(directory / ("veduta-bench-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(directory_);
    for (uint32_t shard = 0; shard < shards; ++shard)
      shards_.push_back(std::make_unique<ShardWriter>(directory_ / (std::to_string(shard) + ".shard"),
                                                      std::string(32, '0'), "none"));
  }
  ~Journal() {
    std::error_code ignored;
    std::filesystem::remove_all(directory_, ignored);
  }
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  void append(const CellRecord& record) { shards_[next_++ % shards_.size()]->append(record); }
  void sync() {
    for (const auto& shard : shards_) shard->sync();
  }

 private:
  std::filesystem::path directory_;
  std::vector<std::unique_ptr<ShardWriter>> shards_;
  size_t next_ = 0;
};

struct Job {
  std::filesystem::path directory;
  uint32_t records, rounds, workers;
  size_t record_bytes;
};

Json measure_burst(const Job& job) {
  size_t made = 0;
  const auto bare_began = Clock::now();
  for (uint32_t cell = 0; cell < job.records; ++cell)
    made += encode(record_of(cell, job.record_bytes)).size();
  const double bare_s = since_s(bare_began);

  Journal journal(job.directory, job.workers);
  const double processor_began_s = processor_s();
  const auto began = Clock::now();
  auto last_sync = began;
  size_t unsynced = 0;
  int syncs = 0;
  for (uint32_t cell = 0; cell < job.records; ++cell) {
    journal.append(record_of(cell, job.record_bytes));
    unsynced += made / job.records;
    if (unsynced < 16u << 20 && since_s(last_sync) < 1 && cell + 1 < job.records) continue;
    journal.sync();
    ++syncs;
    unsynced = 0, last_sync = Clock::now();
  }
  const double written_s = since_s(began);
  const auto per_record_us = [&](double s) { return 1e6 * s / job.records; };
  return {{"records", job.records},
          {"bytes", made},
          {"syncs", syncs},
          {"us_per_record", per_record_us(written_s)},
          {"us_per_record_not_written", per_record_us(bare_s)},
          {"us_per_record_of_journal", per_record_us(written_s - bare_s)},
          {"processor_us_per_record", per_record_us(processor_s() - processor_began_s)}};
}

Json measure_bake(const Job& job, const std::string& file) {
  const auto cell_s = read_cell_times(file);
  const double mean_s = std::reduce(cell_s.begin(), cell_s.end()) / static_cast<double>(cell_s.size());
  const double per_round = job.workers / mean_s;
  Journal journal(job.directory, job.workers);
  uint32_t written = 0;
  double journal_s = 0, longest_s = 0;
  const double processor_began_s = processor_s();
  for (uint32_t round = 1; round <= job.rounds; ++round) {
    const auto began = Clock::now();
    for (; written < std::lround(round * per_round); ++written)
      journal.append(record_of(written, job.record_bytes));
    journal.sync();
    const double s = since_s(began);
    journal_s += s, longest_s = std::max(longest_s, s);
  }
  return {{"cell_times", file},
          {"mean_cell_s", mean_s},
          {"workers", job.workers},
          {"records", written},
          {"longest_ms", 1e3 * longest_s},
          {"share_of_bake", journal_s / job.rounds},
          {"processor_share_of_bake", (processor_s() - processor_began_s) / (job.rounds * job.workers)}};
}

Json measure(const Json& in) {
  const Job job{in.value("directory", "."), in.value("records", 20000u), in.value("rounds", 30u),
                in.value("workers", 2u), in.value("record_bytes", size_t{3000})};
  if (job.records == 0 || job.rounds == 0 || job.workers == 0) throw std::runtime_error("nothing to write");
  Json out = {{"burst", measure_burst(job)}};
  for (const Json& file : in.value("cell_times", Json::array()))
    out["bakes"].push_back(measure_bake(job, file.get<std::string>()));
  return out;
}

}  // namespace
}  // namespace veduta::bench

int main() {
  try {
    std::cout << veduta::bench::measure(nlohmann::ordered_json::parse(std::cin)).dump(2) << std::endl;
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "veduta-bench-journal: " << error.what()
              << "; give {\"directory\": \".\", \"records\": 20000}\n";
    return 2;
  }
}
