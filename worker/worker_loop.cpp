#include "worker/worker_loop.h"

#include <malloc.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "pvs/pvs_file.h"
#include "pvs/run_paths.h"
#include "pvs/shard.h"
#include "scene/error.h"
#include "scene/peak_memory.h"
#include "worker/baker.h"
#include "worker/preparation.h"
#include "worker/protocol.h"

namespace veduta {
namespace {

using nlohmann::json;

/// On a network file system this host may go on for half a minute with what it knows of a folder, and miss
/// files that other hosts have put there; to open the folder makes it ask.
void see_what_others_wrote(const std::filesystem::path& directory) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(directory, ignored))
    if (entry.is_directory(ignored)) std::filesystem::directory_iterator(entry.path(), ignored);
}

class Worker {
 public:
  Worker(int output, std::string gpu) : output_(output), gpu_(std::move(gpu)) {}

  void hello() { say(Verb::hello, {{"pid", getpid()}, {"version", protocol_version}}); }

  /// \return false to leave.
  bool answer(const Frame& frame) {
    if (frame.verb == Verb::quit) return false;
    const json request = json::parse(frame.text(), nullptr, false);
    if (request.is_discarded()) throw Error(ExitStatus::defect, "worker: a request is not JSON");
    switch (frame.verb) {
      case Verb::prepare:
        prepare_part(request);
        break;
      case Verb::open:
        open_city(request.at("directory").get<std::string>());
        break;
      case Verb::bake:
        bake(request.at("cells").get<std::vector<uint32_t>>());
        break;
      default:
        throw Error(ExitStatus::defect,
                    "worker: unknown verb " + std::to_string(static_cast<uint32_t>(frame.verb)));
    }
    return true;
  }

  /// `again`: the next worker may get over it.
  void fail(const Error& error, bool again = false) {
    say(Verb::failed,
        {{"status", static_cast<int>(error.status())}, {"message", error.what()}, {"again", again}});
  }

 private:
  void say(Verb verb, const json& payload) { write_frame(output_, encode_frame(verb, payload.dump())); }

  void prepare_part(const json& request) {
    const RunPaths run{request.at("directory").get<std::string>()};
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                      std::max(size_t{1}, request.at("threads").get<size_t>()));
    const auto began = std::chrono::steady_clock::now();
    reset_peak_memory();
    see_what_others_wrote(run.directory / "prepared.tmp");
    json answer = done_part(run, request.at("stage").get<std::string>(), request.at("part").get<uint32_t>());
    answer["stage"] = request.at("stage"), answer["part"] = request.at("part");
    answer["seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    answer["peak_mb"] = peak_memory_mb();
    say(Verb::prepared, answer);
  }

  static json done_part(const RunPaths& run, const std::string& stage, uint32_t part) {
    const Settings settings = load_settings(run.settings());
    if (stage == name_of(Stage::import)) {
      const PreparationSize size = import_city(run, settings);
      malloc_trim(0);  // the whole city was in memory; the parts to come are small
      return {{"tiles", size.tiles}, {"blocks", size.blocks}, {"notes", size.notes}};
    }
    if (stage == name_of(Stage::flood)) return {{"again", flood_tile(run, part)}};
    if (stage == name_of(Stage::cells)) return {{"cells", make_tile_cells(run, settings, part)}};
    if (stage == name_of(Stage::shrink)) {
      shrink_block(run, settings, part);
      return json::object();
    }
    if (stage != name_of(Stage::finish))
      throw Error(ExitStatus::defect, "worker: there is no stage '" + stage + "'");
    const PreparedSize size = finish_preparation(run, settings);
    return {{"cells", size.cells},
            {"objects", size.objects},
            {"triangles", size.triangles},
            {"notes", size.notes}};
  }

  void open_city(const std::string& directory) {
    const RunPaths run{directory};
    baker_.emplace(read_city_to_bake(run.city()), ClusteredOccluders::map(run.occluders()),
                   load_settings(run.settings()), gpu_);
    say(Verb::opened, {{"renderer", baker_->renderer()}, {"cells", baker_->cell_count()}});
  }

  void bake(const std::vector<uint32_t>& cells) {
    if (!baker_) throw Error(ExitStatus::defect, "worker: asked to bake before a city was opened");
    for (const uint32_t cell : cells) {
      if (cell >= baker_->cell_count())
        throw Error(ExitStatus::defect, "worker: there is no cell " + std::to_string(cell));
    }
    baker_->bake(cells, [&](const CellRecord& record) {
      const std::vector<std::byte> bytes = encode(record);
      write_frame(output_, encode_frame(Verb::cell_baked, bytes.data(), bytes.size()));
    });
    say(Verb::lease_done, json::object());
  }

  int output_;
  std::string gpu_;
  std::optional<Baker> baker_;
};

}  // namespace

int run_worker(int input, int output, const std::string& gpu) {
  Worker worker(output, gpu);
  try {
    try {
      worker.hello();
      while (const std::optional<Frame> frame = read_frame(input)) {
        if (!worker.answer(*frame)) break;
      }
      return static_cast<int>(ExitStatus::done);
    } catch (const Error&) {
      throw;
    } catch (const std::bad_alloc&) {
      worker.fail(Error(ExitStatus::input_output,
                        "worker: out of memory; use fewer --workers or a larger navigation.seed_size"),
                  true);
      return static_cast<int>(ExitStatus::input_output);
    } catch (const std::exception& error) {
      throw Error(ExitStatus::defect, std::string("worker: ") + error.what());
    }
  } catch (const Error& error) {
    worker.fail(error);
    return static_cast<int>(error.status());
  }
}

}  // namespace veduta
