#include "farm/bake.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "farm/coordinator.h"
#include "farm/dry_run.h"
#include "farm/fingerprint.h"
#include "farm/finish.h"
#include "farm/lock.h"
#include "farm/machine.h"
#include "farm/shepherd.h"
#include "farm/signals.h"
#include "scene/error.h"
#include "worker/settings.h"

namespace veduta {
namespace {

RunPaths run_paths(const BakeOptions& options) {
  return {options.out.empty() ? std::filesystem::path("out") / options.config.stem() : options.out};
}

/// What to type, with the launcher in front of it.
std::string command_to_continue(const BakeOptions& options) {
  if (const char* ranks = std::getenv("OMPI_COMM_WORLD_SIZE"))
    return fmt::format("mpirun -n {} {}", ranks, options.command_line);
  if (const char* ranks = std::getenv("SLURM_STEP_NUM_TASKS"); ranks && launched_rank())
    return fmt::format("srun -n {} {}", ranks, options.command_line);
  return options.command_line;
}

bool for_shepherd(const Message& message) {
  return std::visit(
      [](const auto& each) { return std::remove_cvref_t<decltype(each)>::verb < ReadyMessage::verb; },
      message);
}

/// An error of this rank as the coordinator is told it: the user must know which host to look at, also when
/// the rank could not begin.
FailedMessage failure(const Transport& transport, ExitStatus status, const std::string& what) {
  FailedMessage failed;
  failed.status = static_cast<int32_t>(status);
  failed.message = FixedText<1600>(
      transport.size() == 1 ? what : fmt::format("rank {} on {}: {}", transport.rank(), host_name(), what));
  return failed;
}

/// The shepherd of this rank, from Start to Left; its errors become messages to the coordinator.
class GuardedShepherd {
 public:
  GuardedShepherd(Transport& transport, const ShepherdOptions& options)
      : transport_(transport), shepherd_(transport, options) {}
  void handle(const Message& message) {
    guard([&] { shepherd_.handle(message); });
  }
  void step(int wait_ms) {
    guard([&] { shepherd_.step(wait_ms); });
  }
  void stop() {
    guard([&] { shepherd_.stop(true); });
  }

 private:
  template <typename Action>
  void guard(const Action& action) {
    try {
      return action();
    } catch (const Error& error) {
      transport_.send(0, failure(transport_, error.status(), error.what()));
    } catch (const std::exception& error) {
      transport_.send(0, failure(transport_, ExitStatus::defect, error.what()));
    }
    shepherd_.abandon();
  }
  Transport& transport_;
  Shepherd shepherd_;
};

/// How long to wait for the children. With MPI, messages must be polled for, and while they come there is no
/// wait at all; alone, only children have something to say.
int wait_ms(const Transport& transport, bool messages_came) {
  if (messages_came) return 0;
  return transport.size() > 1 ? 1 : 20;
}

/// Hands what has come to `handle`, no more of it than lets the caller look after the rest.
/// \return whether there was any.
template <typename Handle>
bool deliver(Transport& transport, const Handle& handle) {
  constexpr int most = 4096;
  for (int count = 0; count < most; ++count) {
    const auto received = transport.receive();
    if (!received) return count > 0;
    handle(*received);
  }
  return true;
}

/// A rank other than 0: does as it is told until Goodbye.
void serve(Transport& transport, GuardedShepherd& shepherd) {
  for (bool goodbye = false; !goodbye;) {
    const bool came = deliver(transport, [&](const Received& received) {
      goodbye = goodbye || std::holds_alternative<GoodbyeMessage>(received.message);
      if (!goodbye) shepherd.handle(received.message);
    });
    if (stop_requested()) shepherd.stop();
    if (!goodbye) shepherd.step(wait_ms(transport, came));
  }
}

/// The same, when this host cannot even begin: the coordinator hears why.
void serve_guarded(const BakeOptions& options, Transport& transport) {
  try {
    const RankShare share = rank_share(transport, options.workers, options.gpu);
    GuardedShepherd shepherd(transport, {run_paths(options), share.workers, share.threads_per_worker,
                                         share.cores, share.gpus, options.cell_timeout_s});
    return serve(transport, shepherd);
  } catch (const Error& error) {
    transport.send(0, failure(transport, error.status(), error.what()));
  }
  transport.send(0, LeftMessage{});
  for (;;) {
    if (const auto received = transport.receive();
        received && std::holds_alternative<GoodbyeMessage>(received->message))
      return;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

/// Rank 0's loop, until every shepherd has left. \return the error that ended the bake, if one did.
std::optional<Error> coordinate(Transport& transport, Coordinator& coordinator, GuardedShepherd& shepherd) {
  std::optional<Error> failure;
  const auto guard = [&](const auto& action) {
    try {
      action();
    } catch (const Error& error) {
      if (!failure) failure = error;
      coordinator.finish(false);
    }
  };
  const auto take = [&](const Received& received) {
    if (for_shepherd(received.message))
      shepherd.handle(received.message);
    else
      guard([&] { coordinator.handle(received.from, received.message); });
  };
  guard([&] { coordinator.start(); });
  while (!coordinator.finished()) {
    bool came = deliver(transport, take);
    guard([&] { coordinator.tick(stop_requested()); });
    came = deliver(transport, take) || came;  // leases of our own children do not wait for the next sign
    shepherd.step(wait_ms(transport, came));
  }
  return failure;
}

/// Checks that the directory is this job's, or makes it so.
void claim(const RunPaths& run, const Settings& settings, const Fingerprint& fingerprint) {
  if (const auto stored = read_text_file(run.fingerprint()))
    require_same_job(run.directory, *stored, fingerprint);
  write_file_atomically(run.fingerprint(), fingerprint.text());
  write_file_atomically(run.settings(), to_toml(settings));
}

/// Everything that rank 0 does. \return the exit status. \throw Error.
int bake_as_first(const BakeOptions& options, Transport& transport) {
  const Settings settings = load_settings(options.config);
  const RunPaths run = run_paths(options);
  if (options.dry_run) {
    print_plan(options, settings, run, transport.size(), rank_share(transport, options.workers, options.gpu));
    return 0;
  }
  const auto began = std::chrono::steady_clock::now();
  const Fingerprint fingerprint = make_fingerprint(settings);
  worker_program();  // a missing worker is told before anything is written
  const bool was_run = is_run_directory(run);
  make_run_directory(run);
  const RunLock lock(run.lock());
  if (options.fresh && was_run) remove_run(run), make_run_directory(run);
  remove_unfinished_files(run);
  claim(run, settings, fingerprint);

  RunLog log(run.log(), options.verbosity);
  Progress progress(options.verbosity == Verbosity::quiet);
  const RankShare share = rank_share(transport, options.workers, options.gpu);
  if (launched_rank() && share.cores * static_cast<uint32_t>(transport.local_size()) < share.machine_cores)
    log.info("bound", nlohmann::json{{"cores", share.cores}, {"machine_cores", share.machine_cores}},
             fmt::format("this rank may use {} of {} cores; mpirun --bind-to none lets it use all",
                         share.cores, share.machine_cores));
  Coordinator coordinator(transport, {run, fingerprint.hash, share.workers, options.rank_timeout_s}, log,
                          progress);
  GuardedShepherd shepherd(transport, {run, share.workers, share.threads_per_worker, share.cores, share.gpus,
                                       options.cell_timeout_s});
  const auto failure = coordinate(transport, coordinator, shepherd);
  progress.clear();
  BakeEnd end{run,
              fingerprint.hash,
              coordinator.tally(),
              transport.size(),
              share.workers,
              began,
              command_to_continue(options),
              options.verbosity == Verbosity::quiet};
  if (failure) {
    log.info("failed",
             nlohmann::json{{"status", static_cast<int>(failure->status())}, {"message", failure->what()}});
    throw *failure;
  }
  return finish_bake(end, options.merge, log);
}

int bake_guarded(const BakeOptions& options, Transport& transport) {
  try {
    return bake_as_first(options, transport);
  } catch (const Error& error) {
    say(std::string("veduta: ") + error.what());
    return static_cast<int>(error.status());
  } catch (const std::exception& error) {
    say(std::string("veduta: ") + error.what() + "; this is a defect of veduta");
    return static_cast<int>(ExitStatus::defect);
  }
}

}  // namespace

int run_bake(const BakeOptions& options) {
  install_stop_signals(launched_rank().value_or(0) == 0
                           ? "veduta: stopped at once; continue with: " + command_to_continue(options)
                           : "");
  const auto transport = make_transport();
  int status = 0;
  if (transport->rank() == 0) {
    status = bake_guarded(options, *transport);
    for (int rank = 1; rank < transport->size(); ++rank) transport->send(rank, GoodbyeMessage{});
  } else {
    serve_guarded(options, *transport);
  }
  transport->leave(status);
  return status;
}

}  // namespace veduta
