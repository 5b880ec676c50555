#include <poll.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "farm/fingerprint.h"
#include "farm/lone_worker.h"
#include "farm/machine.h"
#include "farm/preparation_book.h"
#include "farm/run_directory.h"
#include "farm/sweep_point.h"
#include "scene/error.h"

namespace veduta {
namespace {

using nlohmann::json;

/// Parts of the preparation in the hands of worker children. One that dies ends it: a sweep looks at
/// settings, not at what a farm survives.
class Preparers {
 public:
  Preparers(const RunPaths& run, uint32_t count) : run_(run) {
    for (uint32_t n = 0; n < count; ++n)
      workers_.push_back(std::make_unique<LoneWorker>(run.directory / "worker.log", 1, "software"));
  }

  void work(Progress& progress) {
    while (!book_.complete()) {
      for (uint32_t n = 0; n < workers_.size(); ++n) grant(n);
      progress.stage(name_of(book_.stage()), book_.finished(), book_.finished() + book_.outstanding());
      wait();
    }
  }

 private:
  static WorkerId id(uint32_t number) { return {0, static_cast<int>(number)}; }

  void grant(uint32_t number) {
    const auto part = book_.grant(id(number));
    if (!part) return;
    const bool alone = part->stage == Stage::import || part->stage == Stage::finish;
    workers_[number]->send(Verb::prepare,
                           json{{"directory", std::filesystem::absolute(run_.directory).string()},
                                {"stage", name_of(part->stage)},
                                {"part", part->part},
                                {"threads", alone ? workers_.size() : size_t{1}}}
                               .dump());
  }

  void wait() {
    std::vector<pollfd> polled;
    for (const auto& worker : workers_) polled.push_back({worker->output(), POLLIN, 0});
    if (poll(polled.data(), polled.size(), 500) <= 0) return;
    for (uint32_t n = 0; n < workers_.size(); ++n)
      if (polled[n].revents != 0) take(n);
  }

  void take(uint32_t number) {
    const auto frame = workers_[number]->next_of_ready();
    if (!frame) return;
    const json answer = json::parse(frame->text(), nullptr, false);
    if (frame->verb != Verb::prepared || !answer.is_object())
      throw Error(ExitStatus::defect, "worker: not the answer to a part of the preparation");
    if (book_.stage() == Stage::import)
      book_.set_size(answer.value("tiles", uint32_t{0}), answer.value("blocks", uint32_t{0}));
    book_.done(id(number), answer.value("again", std::vector<uint32_t>()));
  }

  RunPaths run_;
  PreparationBook book_;
  std::vector<std::unique_ptr<LoneWorker>> workers_;
};

}  // namespace

std::string preparation_key(const Settings& settings) {
  Settings common = settings;
  common.occlusion.method = Settings().occlusion.method;
  common.occlusion.max_overestimate = Settings().occlusion.max_overestimate;
  return make_fingerprint(common).hash;
}

double prepare_for_sweep(const RunPaths& run, const Settings& settings, Progress& progress) {
  std::filesystem::create_directories(run.directory);
  write_file_atomically(run.settings(), to_toml(settings));
  if (std::filesystem::exists(run.occluders())) return 0;  // comes to be as a whole, by renaming
  const auto began = std::chrono::steady_clock::now();
  Preparers(run, std::max(1u, std::thread::hardware_concurrency())).work(progress);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

}  // namespace veduta
