#include "bench/farm_simulation.h"

#include <algorithm>
#include <queue>
#include <random>
#include <set>
#include <stdexcept>

#include "farm/leases.h"

namespace veduta::bench {
namespace {

constexpr int slots_per_rank = 64;
constexpr double tick_s = 0.01;  // how often idle workers are looked after when nothing else happens

WorkerId worker_id(uint32_t worker) {
  return {static_cast<int>(worker / slots_per_rank), static_cast<int>(worker % slots_per_rank)};
}

class Farm {
 public:
  explicit Farm(const FarmModel& model)
      : model_(model),
        random_(model.seed),
        book_(std::vector<bool>(model.cells, false), model.workers),
        workers_(model.workers) {}

  FarmOutcome run() {
    for (uint32_t worker = 0; worker < model_.workers; ++worker) {
      workers_[worker].slowness = worker < model_.slow_share * model_.workers ? model_.slow_factor : 1;
      events_.push({0, worker, Event::waits});
    }
    events_.push({tick_s, 0, Event::tick});
    while (!book_.complete()) {
      const Event event = events_.top();
      events_.pop();
      take(event);
    }
    return outcome();
  }

 private:
  /// What the coordinator gets, when.
  struct Event {
    enum Kind : uint8_t { waits, answers, lost, tick };
    double at_s;
    uint32_t worker;
    Kind kind;
    bool operator<(const Event& other) const { return at_s > other.at_s; }  // the earliest on top
  };
  struct Worker {
    Lease lease;
    uint32_t answered = 0;
    double slowness = 1;
  };

  double seconds_of(uint32_t cell) const { return model_.cell_s[cell % model_.cell_s.size()]; }
  /// Until something that happens so often happens.
  double until_next(double per_hour) {
    return per_hour > 0 ? std::exponential_distribution<>(per_hour / 3600)(random_) : 1e30;
  }

  /// The coordinator is busy with so many messages, after those before. \return when it is through.
  double serve(double at_s, int messages) {
    const double begin_s = std::max(at_s, free_s_);
    waited_s_ += begin_s - at_s;
    free_s_ = begin_s + messages * model_.message_s;
    busy_s_ += messages * model_.message_s;
    messages_ += static_cast<uint64_t>(messages);
    return free_s_;
  }

  /// The worker goes on with the next cell of its lease: what is heard of that, and when.
  void bake_next(uint32_t number, double now_s) {
    const Worker& worker = workers_[number];
    const double cell_s = worker.slowness * seconds_of(worker.lease.begin + worker.answered);
    const double death_s = until_next(model_.deaths_per_hour), hang_s = until_next(model_.hangs_per_hour);
    Event event{now_s + cell_s + model_.latency_s, number, Event::answers};
    if (std::min(death_s, hang_s) < cell_s) {
      event.kind = Event::lost;
      event.at_s = now_s + model_.latency_s + (death_s < hang_s ? death_s : hang_s + model_.cell_timeout_s);
    }
    events_.push(event);
  }

  void take(const Event& event) {
    if (event.kind == Event::tick) {
      events_.push({event.at_s + tick_s, 0, Event::tick});
    } else if (event.kind == Event::waits) {
      serve(event.at_s, 1);
      idle_.insert(event.worker);
    } else if (event.kind == Event::answers) {
      take_answer(event);
    } else {
      ++deaths_;
      serve(event.at_s, 1);
      const auto condemned = book_.lease_lost(workers_[event.worker].lease.id, true);
      if (condemned) book_.cell_done(0, *condemned, event.at_s);
      events_.push({event.at_s + model_.restart_s, event.worker, Event::waits});
    }
    hand_out(event.at_s);
  }

  void take_answer(const Event& event) {
    Worker& worker = workers_[event.worker];
    const uint32_t cell = worker.lease.begin + worker.answered;
    const bool last = ++worker.answered == worker.lease.count;
    const double done_s = serve(event.at_s, last ? 2 : 1);
    if (book_.cell_done(worker.lease.id, cell, done_s))
      work_s_ += seconds_of(cell);
    else
      ++duplicates_;
    end_s_ = done_s;
    if (!last) return bake_next(event.worker, event.at_s - model_.latency_s);
    book_.lease_done(worker.lease.id);
    idle_.insert(event.worker);
  }

  void hand_out(double at_s) {
    while (!idle_.empty()) {
      const uint32_t number = *idle_.begin();
      const auto lease = book_.grant(worker_id(number), std::max(at_s, free_s_));
      if (!lease) return;
      idle_.erase(idle_.begin());
      ++leases_;
      workers_[number].lease = *lease, workers_[number].answered = 0;
      bake_next(number, serve(at_s, 1) + model_.latency_s);
    }
  }

  FarmOutcome outcome() const {
    double speed = 0;
    for (const Worker& worker : workers_) speed += 1 / worker.slowness;
    FarmOutcome outcome;
    outcome.makespan_s = end_s_;
    outcome.efficiency = work_s_ / (speed * end_s_);
    outcome.coordinator_busy = busy_s_ / end_s_;
    outcome.mean_wait_s = waited_s_ / static_cast<double>(messages_);
    outcome.leases = leases_, outcome.messages = messages_;
    outcome.duplicates = duplicates_, outcome.deaths = deaths_;
    return outcome;
  }

  FarmModel model_;
  std::mt19937_64 random_;
  LeaseBook book_;
  std::vector<Worker> workers_;
  std::priority_queue<Event> events_;
  std::set<uint32_t> idle_;
  double free_s_ = 0, busy_s_ = 0, waited_s_ = 0, work_s_ = 0, end_s_ = 0;
  uint64_t leases_ = 0, messages_ = 0, duplicates_ = 0, deaths_ = 0;
};

}  // namespace

FarmOutcome simulate_farm(const FarmModel& model) {
  if (model.cell_s.empty() || model.workers == 0 || model.cells == 0)
    throw std::runtime_error("a farm needs workers, cells and what these take");
  return Farm(model).run();
}

}  // namespace veduta::bench
