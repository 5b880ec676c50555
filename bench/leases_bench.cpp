// The book of leases, by itself and in simulated farms. JSON in, JSON out:
//
//   echo '{"book": [{"cells": 1000000, "done": 0.99, "workers": 1000}],
//          "farms": [{"cell_times": "bench/data/cell_times_denhaag.txt", "workers": [1000, 20000],
//                     "cells_per_worker": 250, "message_us": 6, "latency_ms": 1}]}' | veduta-bench-leases
//
// "book": what a cell costs, with its share of the lease, with so many cells of which that share is done
// already (in runs of 1000, as a stopped bake leaves them) and so many workers that answer in turn. "farms":
// see farm_simulation.h. "cell_times": a file of microseconds, one a line, as /cells/bake_us of a file has
// them. Everything that a bake asks of its coordinator happens, in simulated time.
#include <chrono>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/cell_times.h"
#include "bench/farm_simulation.h"
#include "bench/processor_time.h"
#include "farm/leases.h"

namespace veduta::bench {
namespace {

using Json = nlohmann::ordered_json;

/// Workers take a lease each and answer a cell each in turn, for at most so many leases.
Json measure_book(const Json& in) {
  const auto cells = in.at("cells").get<uint32_t>();
  const auto workers = in.value("workers", 1000u);
  const auto done_share = in.value("done", 0.0);
  std::vector<bool> done(cells);
  for (uint32_t cell = 0; cell < cells; ++cell) done[cell] = cell % 1000 < std::lround(1000 * done_share);
  LeaseBook book(std::move(done), workers);
  std::vector<Lease> leases(workers);
  uint64_t granted = 0, answers = 0;
  double now_s = 0;
  const auto began = std::chrono::steady_clock::now();
  const double processor_began_s = processor_s();
  const uint64_t most = in.value("leases", uint64_t{20000});
  for (uint32_t turn = 0; !book.complete() && granted < most; turn = (turn + 1) % workers, now_s += 0.001) {
    Lease& lease = leases[turn];
    if (lease.count == 0) {
      const WorkerId worker{static_cast<int>(turn / 16), static_cast<int>(turn % 16)};
      const auto next = book.grant(worker, now_s);
      if (!next) continue;
      lease = *next;
      ++granted;
    }
    book.cell_done(lease.id, lease.begin++, now_s);
    ++answers;
    if (--lease.count == 0) book.lease_done(lease.id);
  }
  const double used_s = processor_s() - processor_began_s;
  return {{"cells", cells},
          {"done", done_share},
          {"workers", workers},
          {"leases", granted},
          {"answers", answers},
          {"elapsed_s", std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count()},
          {"cells_per_lease", static_cast<double>(answers) / static_cast<double>(granted)},
          {"processor_ns_per_cell", 1e9 * used_s / static_cast<double>(answers)}};
}

/// The end of a bake: every worker has its last cell in hands, and one that is idle asks again and again.
Json measure_idle(const Json& in) {
  const auto workers = in.at("workers").get<uint32_t>();
  LeaseBook book(std::vector<bool>(workers, false), workers);
  const auto id = [](uint32_t number) {
    return WorkerId{static_cast<int>(number / 16), static_cast<int>(number % 16)};
  };
  for (uint32_t worker = 0; worker < workers; ++worker)
    if (!book.grant(id(worker), 0)) throw std::runtime_error("a worker got no cell");
  const int asks = 100000;
  const double processor_began_s = processor_s();
  for (int ask = 0; ask < asks; ++ask)
    if (book.grant(id(workers), 0.1)) throw std::runtime_error("a cell is in two hands too early");
  return {{"workers", workers}, {"processor_ns_per_ask", 1e9 * (processor_s() - processor_began_s) / asks}};
}

Json measure_farm(const Json& in, uint32_t workers) {
  FarmModel model;
  const auto file = in.at("cell_times").get<std::string>();
  model.cell_s = read_cell_times(file);
  for (double& s : model.cell_s) s *= in.value("times", 1.0);
  model.workers = workers;
  model.cells =
      in.contains("cells") ? in["cells"].get<uint32_t>() : workers * in.value("cells_per_worker", 250u);
  model.message_s = 1e-6 * in.value("message_us", 0.0);
  model.latency_s = 1e-3 * in.value("latency_ms", 0.0);
  model.slow_share = in.value("slow_share", 0.0), model.slow_factor = in.value("slow_factor", 1.0);
  model.deaths_per_hour = in.value("deaths_per_hour", 0.0);
  model.hangs_per_hour = in.value("hangs_per_hour", 0.0);
  model.seed = in.value("seed", 1u);
  const FarmOutcome outcome = simulate_farm(model);
  Json out = in;
  out["workers"] = workers, out["cells"] = model.cells;
  out["efficiency"] = outcome.efficiency;
  out["makespan_s"] = outcome.makespan_s;
  out["coordinator_busy"] = outcome.coordinator_busy;
  out["mean_wait_ms"] = 1e3 * outcome.mean_wait_s;
  out["leases"] = outcome.leases, out["messages"] = outcome.messages;
  out["duplicates"] = outcome.duplicates, out["deaths"] = outcome.deaths;
  return out;
}

Json measure(const Json& in) {
  Json out = Json::object();
  if (in.contains("book"))
    for (const Json& book : in["book"]) out["book"].push_back(measure_book(book));
  if (in.contains("idle"))
    for (const Json& idle : in["idle"]) out["idle"].push_back(measure_idle(idle));
  if (in.contains("farms"))
    for (const Json& farm : in["farms"])
      for (const auto workers : farm.at("workers").get<std::vector<uint32_t>>())
        out["farms"].push_back(measure_farm(farm, workers));
  if (out.empty()) throw std::runtime_error("nothing to do");
  return out;
}

}  // namespace
}  // namespace veduta::bench

int main() {
  try {
    std::cout << veduta::bench::measure(nlohmann::ordered_json::parse(std::cin)).dump(2) << std::endl;
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "veduta-bench-leases: " << error.what()
              << "; give {\"book\": [{\"cells\": 1000000}]} or {\"farms\": [{\"cell_times\": \"FILE\", "
                 "\"workers\": "
                 "[1000]}]}\n";
    return 2;
  }
}
