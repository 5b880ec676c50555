// Empty leases through the real coordinator: how many messages rank 0 can answer. JSON in, JSON out:
//
//   echo '{"workers_per_rank": 300, "runs": [{"cells": 100000, "cells_per_lease": 1}]}' |
//   mpirun --mca btl self,tcp -n 3 veduta-bench-coordinator
//
// Rank 0 runs Coordinator, LeaseBook and Transport in the loop of `veduta bake`. Every other rank stands for
// many workers that answer at once: a message for each cell, one for the lease, as a shepherd sends them.
// "cells_per_lease": 1 asks for leases of one cell, 64 for those that a bake gives out while there is much
// to do. A bare loop over MPI runs before: as many requests, answered by nobody's coordinator. For every
// run: the elapsed time and the processor time of rank 0, the latter good on a machine that others use too.
#include <mpi.h>
#include <poll.h>
#include <sched.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "bench/bare_messages.h"
#include "bench/processor_time.h"
#include "farm/coordinator.h"

namespace veduta::bench {
namespace {

using Json = nlohmann::ordered_json;

/// What rank 0 tells the others before each run.
struct Order {
  uint64_t bare_tasks = 0;  ///< 0: a coordinator runs
  uint32_t window = 0;
  uint32_t last = 0;  ///< there is nothing more to do
};

Order tell(Order order) {
  MPI_Bcast(&order, sizeof order, MPI_BYTE, 0, MPI_COMM_WORLD);
  return order;
}

uint64_t sum_of_all(uint64_t mine) {
  uint64_t sum = 0;
  MPI_Reduce(&mine, &sum, 1, MPI_UINT64_T, MPI_SUM, 0, MPI_COMM_WORLD);
  return sum;
}

/// A rank of workers that have nothing to do, from Start to Left. \return cells that it answered for.
class EmptyRank {
 public:
  EmptyRank(Transport& transport, uint32_t workers) : transport_(transport), workers_(workers) {}

  uint64_t run() {
    while (!left_) {
      if (const auto received = transport_.receive())
        handle(received->message);
      else
        sched_yield();
    }
    return answered_;
  }

  void handle(const Message& message) {
    if (std::holds_alternative<StartMessage>(message)) {
      ReadyMessage ready;
      ready.workers = workers_;
      transport_.send(0, ready);
    } else if (std::holds_alternative<OpenMessage>(message)) {
      for (uint32_t slot = 0; slot < workers_; ++slot) {
        IdleMessage idle;
        idle.slot = slot, idle.renderer = FixedText<200>("none");
        transport_.send(0, idle);
      }
    } else if (const auto* grant = std::get_if<GrantMessage>(&message)) {
      answer(*grant);
    } else if (std::holds_alternative<FinishMessage>(message)) {
      transport_.send(0, LeftMessage{});
      left_ = true;
    }
  }

 private:
  void answer(const GrantMessage& grant) {
    for (uint32_t i = 0; i < grant.count; ++i) {
      CellMessage cell;
      cell.lease = grant.lease, cell.cell = grant.begin + i, cell.bake_us = 1;
      transport_.send(0, cell);
    }
    answered_ += grant.count;
    LeaseDoneMessage done;
    done.lease = grant.lease, done.slot = grant.slot;
    transport_.send(0, done);
  }
  Transport& transport_;
  uint32_t workers_;
  uint64_t answered_ = 0;
  bool left_ = false;
};

/// A run directory whose city has cells and nothing else.
class EmptyRun {
 public:
  explicit EmptyRun(uint64_t cells)
      : paths_{std::filesystem::temp_directory_path() / ("veduta-bench-" + std::to_string(getpid()))} {
    make_run_directory(paths_);
    std::filesystem::create_directories(paths_.prepared());
    write_file_atomically(paths_.city(), "nobody reads it\n");
    write_city_counts(paths_, {cells, 1, 1});
  }
  ~EmptyRun() {
    std::error_code ignored;
    std::filesystem::remove_all(paths_.directory, ignored);
  }
  EmptyRun(const EmptyRun&) = delete;
  EmptyRun& operator=(const EmptyRun&) = delete;
  const RunPaths& paths() const { return paths_; }

 private:
  RunPaths paths_;
};

struct Counts {
  uint64_t received = 0, leases = 0;
};

/// The loop of rank 0 in farm/bake.cpp, with a rank of its own that has no workers.
Counts coordinate(Transport& transport, Coordinator& coordinator) {
  Counts counts;
  EmptyRank own(transport, 0);
  const auto deliver = [&] {
    bool came = false;
    for (int n = 0; n < 4096; ++n) {
      const auto received = transport.receive();
      if (!received) break;
      came = true;
      ++counts.received;
      counts.leases += std::holds_alternative<LeaseDoneMessage>(received->message);
      const uint32_t verb = std::visit([](const auto& each) { return each.verb; }, received->message);
      if (verb < ReadyMessage::verb)
        own.handle(received->message);
      else
        coordinator.handle(received->from, received->message);
    }
    return came;
  };
  coordinator.start();
  while (!coordinator.finished()) {
    bool came = deliver();
    coordinator.tick(false);
    came = deliver() || came;
    poll(nullptr, 0, came ? 0 : 1);
  }
  return counts;
}

Json run_coordinator(Transport& transport, const Json& run, uint32_t workers_per_rank) {
  const auto cells = run.at("cells").get<uint64_t>();
  const uint32_t cells_per_lease = run.value("cells_per_lease", 1u);
  const EmptyRun directory(cells);
  RunLog log(directory.paths().log(), Verbosity::quiet);
  Progress progress(false);
  // So many workers that a lease is one cell; or as many as there are.
  const auto told = cells_per_lease == 1 ? static_cast<uint32_t>(cells) : workers_per_rank;
  Coordinator coordinator(transport, {directory.paths(), std::string(32, '0'), told}, log, progress);
  tell({0, workers_per_rank, 0});
  const auto began = std::chrono::steady_clock::now();
  const double processor_began_s = processor_s();
  const Counts counts = coordinate(transport, coordinator);
  const double elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  const double used_s = processor_s() - processor_began_s;
  progress.clear();
  const uint64_t answers = sum_of_all(0);
  const BakeTally& tally = coordinator.tally();
  if (!tally.complete()) throw std::runtime_error("the coordinator did not finish");
  // A grant goes out for every lease.
  const auto messages = static_cast<double>(counts.received + counts.leases);
  return {{"cells", cells},
          {"done_once", tally.done},
          {"answers", answers},
          {"leases", counts.leases},
          {"messages", counts.received + counts.leases},
          {"elapsed_s", elapsed_s},
          {"processor_s", used_s},
          {"leases_per_s", static_cast<double>(counts.leases) / elapsed_s},
          {"messages_per_s", messages / elapsed_s},
          {"processor_us_per_lease", 1e6 * used_s / static_cast<double>(counts.leases)},
          {"processor_us_per_message", 1e6 * used_s / messages}};
}

Json run_bare(uint64_t tasks, uint32_t window) {
  tell({tasks, window, 0});
  const BareMessages bare = exchange_bare_messages(tasks, window);
  return {{"tasks", bare.tasks},
          {"elapsed_s", bare.elapsed_s},
          {"processor_s", bare.processor_s},
          {"tasks_per_s", static_cast<double>(bare.tasks) / bare.elapsed_s},
          {"processor_us_per_task", 1e6 * bare.processor_s / static_cast<double>(bare.tasks)}};
}

Json measure(Transport& transport, const Json& in) {
  const uint32_t workers_per_rank = in.value("workers_per_rank", 300u);
  const uint64_t bare_tasks = in.value("bare_tasks", uint64_t{100000});
  const char* network = std::getenv("OMPI_MCA_btl");
  Json out = {{"mpi", mpi_version()},
              {"btl", network == nullptr ? "any" : network},
              {"ranks_of_workers", transport.size() - 1},
              {"workers_per_rank", workers_per_rank}};
  out["bare"] = run_bare(bare_tasks, workers_per_rank);
  for (const Json& run : in.at("runs")) {
    Json result = run_coordinator(transport, run, workers_per_rank);
    result["leases_to_bare_tasks"] =
        result["leases_per_s"].get<double>() / out["bare"]["tasks_per_s"].get<double>();
    out["runs"].push_back(result);
  }
  return out;
}

int lead(Transport& transport) {
  int status = 0;
  try {
    if (transport.size() < 2) throw std::runtime_error("start it with mpirun -n 2 or more");
    std::cout << measure(transport, Json::parse(std::cin)).dump(2) << std::endl;
  } catch (const std::exception& error) {
    std::cerr
        << "veduta-bench-coordinator: " << error.what()
        << "; give {\"workers_per_rank\": 300, \"runs\": [{\"cells\": 100000, \"cells_per_lease\": 1}]}\n";
    status = 2;
  }
  if (transport.size() > 1) tell({0, 0, 1});
  return status;
}

void follow(Transport& transport) {
  for (Order order = tell({}); order.last == 0; order = tell({})) {
    if (order.bare_tasks > 0)
      exchange_bare_messages(order.bare_tasks, order.window);
    else
      sum_of_all(EmptyRank(transport, order.window).run());
  }
}

}  // namespace
}  // namespace veduta::bench

int main() {
  if (!veduta::launched_rank()) {
    std::cerr << "veduta-bench-coordinator: start it with mpirun -n 2 or more\n";
    return 2;
  }
  const auto transport = veduta::make_transport();
  int status = 0;
  if (transport->rank() == 0)
    status = veduta::bench::lead(*transport);
  else
    veduta::bench::follow(*transport);
  transport->leave(status);
  return status;
}
