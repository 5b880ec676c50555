#include "farm/sample_bake.h"

#include <chrono>
#include <nlohmann/json.hpp>

namespace veduta {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr double open_timeout_s = 600, cell_timeout_s = 1800;  // the thesis's method takes minutes a cell

void ask(LoneWorker& worker, const std::vector<uint32_t>& cells,
         const std::function<void(CellRecord&&)>& take) {
  worker.send(Verb::bake, json{{"cells", cells}}.dump());
  for (;;) {
    const Frame frame = worker.next(cell_timeout_s);
    if (frame.verb == Verb::lease_done) return;
    take(decode_cell_record(frame.payload.data(), frame.payload.size()));
  }
}

double seconds_since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

}  // namespace

SampleBake bake_sample(LoneWorker& worker, const RunPaths& run, const std::vector<uint32_t>& cells,
                       const std::function<void(size_t done)>& progress) {
  SampleBake sample;
  auto began = Clock::now();
  worker.send(Verb::open, json{{"directory", std::filesystem::absolute(run.directory).string()}}.dump());
  sample.renderer = json::parse(worker.next(open_timeout_s).text()).value("renderer", std::string());
  ask(worker, {cells.front()}, [](CellRecord&&) {});
  sample.open_s = seconds_since(began);
  const double cores_s = worker.core_seconds();
  began = Clock::now();
  ask(worker, cells, [&](CellRecord&& record) {
    sample.records.push_back(std::move(record));
    progress(sample.records.size());
  });
  sample.ms = 1000 * seconds_since(began);
  sample.core_ms = 1000 * (worker.core_seconds() - cores_s);
  return sample;
}

}  // namespace veduta
