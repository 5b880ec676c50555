#include "scene/import.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <memory>
#include <set>

#include "scene/assemble.h"
#include "scene/components.h"
#include "scene/ground_feet.h"
#include "scene/model_format.h"
#include "scene/readers/readers.h"
#include "scene/scene_frame.h"
#include "scene/text.h"

namespace veduta {
namespace {

// A file to be read, and what came of it: each has a report of its own, so that any number of threads gives
// the same.
struct Task {
  const ModelFiles* files;
  const std::string* name;
  ImportReport report = {};
  std::optional<ReadModel> read = std::nullopt;
  std::exception_ptr error = nullptr;
};

void merge(const ImportReport& from, ImportReport& to) {
  to.bytes_read += from.bytes_read;
  for (const auto& [reason, dropped] : from.dropped)
    count_dropped(to, reason, dropped.first_place, dropped.count);
  for (const std::string& note : from.added) to.added.push_back(note);
}

// Of several files that cannot be used the first is named, whoever met his first.
void read_all(std::vector<Task>& tasks, const ImportOptions& options) {
  std::atomic<size_t> first_bad = tasks.size();
  tbb::parallel_for(size_t{0}, tasks.size(), [&](size_t i) {
    if (i > first_bad) return;
    Task& task = tasks[i];
    try {
      task.read = read_model(*task.files, *task.name, options, task.report);
    } catch (...) {
      task.error = std::current_exception();
      for (size_t known = first_bad; i < known && !first_bad.compare_exchange_weak(known, i);) {
      }
    }
  });
  if (first_bad < tasks.size()) std::rethrow_exception(tasks[first_bad].error);
}

// Local models of one city go to one grid, that of the first. What lies beside them and nothing places would
// stand far outside of the city.
void move_to_grid(std::vector<Task>& tasks, const ImportOptions& options) {
  std::vector<RawModel*> models;
  std::vector<ObjOrigin> origins;
  std::set<const ModelFiles*> local;
  for (Task& task : tasks) {
    if (!task.read || !task.read->origin) continue;
    models.push_back(&task.read->model);
    origins.push_back(*task.read->origin);
    local.insert(task.files);
  }
  if (models.empty()) return;
  for (Task& task : tasks) {
    if (!task.read || task.read->origin || local.count(task.files) == 0) continue;
    const RawModel& model = task.read->model;
    if (model.format != "OBJ" || !is_local(model)) continue;
    count_dropped(task.report, "file of local coordinates whose place is not stated", model.file);
    task.read.reset();
  }
  move_to_grid(models, origins, grid_of(origins.front()), options.up);
}

Error no_model(const std::filesystem::path& path, const ModelFiles& files) {
  return bad_input(printable(path.string(), 1000),
                   files.form() == ModelFiles::Form::archive ? "archive" : "folder",
                   fmt::format("none of its {} files is a model; see docs/importing.md for the formats",
                               files.names().size()));
}

std::vector<RawModel> read_models(const std::vector<std::filesystem::path>& paths,
                                  const ImportOptions& options, ImportReport& report) {
  std::vector<std::unique_ptr<ModelFiles>> given;
  std::vector<std::vector<std::string>> chosen;
  for (const std::filesystem::path& path : paths) {
    given.push_back(std::make_unique<ModelFiles>(path));
    chosen.push_back(choose_models(*given.back(), report));
    if (chosen.back().empty()) throw no_model(path, *given.back());
  }
  std::vector<Task> tasks;
  for (size_t i = 0; i < given.size(); ++i)
    for (const std::string& name : chosen[i]) tasks.push_back({given[i].get(), &name});
  read_all(tasks, options);

  move_to_grid(tasks, options);
  std::vector<RawModel> models;
  std::vector<std::string> formats;
  for (Task& task : tasks) {
    merge(task.report, report);
    if (!task.read) continue;
    const RawModel& model = task.read->model;
    if (model.ring_vertex.empty() && task.files->form() != ModelFiles::Form::file) {
      count_dropped(report, "file without surfaces", model.file);
      continue;
    }
    models.push_back(std::move(task.read->model));
    if (std::find(formats.begin(), formats.end(), models.back().format) == formats.end())
      formats.push_back(models.back().format);
  }
  report.format = fmt::format("{}", fmt::join(formats, ", "));
  report.files = models.size();
  return models;
}

void require_surfaces(const std::vector<RawModel>& models) {
  for (const RawModel& model : models)
    if (model.ring_vertex.empty())
      throw bad_input(model.file, "whole file", "holds no surface; check what was exported");
}

}  // namespace

ImportResult import_scene(const std::vector<std::filesystem::path>& files, const ImportOptions& options) {
  if (files.empty()) throw Error(ExitStatus::usage, "import: no model file is given; name one or more");
  if (!(options.terrain_tile_m == 0 ||
        (options.terrain_tile_m >= 1 && std::isfinite(options.terrain_tile_m))))
    throw Error(ExitStatus::usage, "import: terrain_tile_m is neither 0 nor at least 1 m");
  ImportReport report;
  std::vector<RawModel> models = read_models(files, options, report);
  if (models.empty())
    throw bad_input(printable(files.front().string(), 1000), "whole model", "holds no surface");
  require_surfaces(models);
  bring_to_frame(models, options);
  if (models.size() == 1 && !models.front().has_objects) take_apart(models.front());
  if (options.unit_m == 0) require_size_of_city(models);
  if (auto ground = missing_ground(models)) {
    report.added.push_back(
        fmt::format("ground of {} triangles through the feet of the buildings; the model "
                    "brings none",
                    ground->polygons.size()));
    models.push_back(std::move(*ground));
  }
  return assemble(models, options, std::move(report));
}

}  // namespace veduta
