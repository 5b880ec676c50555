#include "farm/preparation_state.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

#include "farm/run_directory.h"
#include "scene/error.h"

namespace veduta {
namespace {

using nlohmann::json;

std::filesystem::path state_file(const RunPaths& run) {
  return unfinished_preparation(run) / "state.json";
}

/// Files of parts are not synced one by one: all at once is cheaper.
void sync_all_of(const std::filesystem::path& directory) {
  const int descriptor = open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool synced = descriptor >= 0 && syncfs(descriptor) == 0;
  const int failure = errno;
  if (descriptor >= 0) close(descriptor);
  if (!synced)
    throw Error(ExitStatus::input_output,
                directory.string() + ": cannot be written: " + std::strerror(failure));
}

}  // namespace

void write_preparation_state(const RunPaths& run, const PreparationState& state) {
  sync_all_of(unfinished_preparation(run));
  write_file_atomically(state_file(run), json{{"stage", name_of(state.stage)},
                                              {"tiles", state.tiles},
                                              {"blocks", state.blocks},
                                              {"done", state.done}}
                                                 .dump() +
                                             "\n");
}

std::optional<PreparationState> read_preparation_state(const RunPaths& run) {
  const json stored = json::parse(read_text_file(state_file(run)).value_or(""), nullptr, false);
  if (!stored.is_object()) return std::nullopt;
  const std::string stage = stored.value("stage", "");
  const auto* const name = std::find(stage_names.begin(), stage_names.end(), stage);
  if (name == stage_names.end()) return std::nullopt;
  return PreparationState{static_cast<Stage>(name - stage_names.begin()), stored.value("tiles", uint32_t{0}),
                          stored.value("blocks", uint32_t{0}), stored.value("done", std::vector<uint32_t>())};
}

}  // namespace veduta
