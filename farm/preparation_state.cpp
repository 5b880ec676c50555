#include "farm/preparation_state.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "farm/run_directory.h"

namespace veduta {
namespace {

using nlohmann::json;

std::filesystem::path state_file(const RunPaths& run) {
  return unfinished_preparation(run) / "state.json";
}

}  // namespace

void write_preparation_state(const RunPaths& run, const PreparationState& state) {
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
