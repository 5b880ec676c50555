#include "scene/readers/readers.h"

#include "scene/model_format.h"
#include "scene/readers/citygml.h"
#include "scene/readers/cityjson.h"
#include "scene/readers/dxf.h"
#include "scene/readers/gltf.h"
#include "scene/readers/obj.h"
#include "scene/readers/tiles_3d.h"
#include "scene/text.h"

namespace veduta {
namespace {

// Counts what a reader reads besides its file.
FindFile counted(FindFile find, ImportReport& report) {
  return [find = std::move(find), &report](const std::string& relative) {
    std::optional<InputFile> found = find(relative);
    if (found) report.bytes_read += found->content().size();
    return found;
  };
}

// JSON of another kind lies in many folders: only one that was named as a model is an error.
bool is_foreign_json(const ModelFiles& files, const InputFile& file) {
  return files.form() != ModelFiles::Form::file && file.extension == ".json" &&
         file.content().find("\"CityJSON") == std::string_view::npos;
}

ReadModel read_obj_at_its_place(const ModelFiles& files, const std::string& name, const InputFile& file,
                                ImportReport& report) {
  ReadModel read{read_obj(file, report), origin_in_comment(file)};
  if (!read.origin) read.origin = origin_in_index(files, name);
  if (read.origin) name_after(*read.origin, file.stem, read.model);
  return read;
}

}  // namespace

std::optional<ReadModel> read_model(const ModelFiles& files, const std::string& name,
                                    const ImportOptions& options, ImportReport& report) {
  const InputFile file = files.read(name);
  report.bytes_read += file.content().size();
  const FindFile find = counted(files.find_from(name), report);
  const auto plain = [](RawModel model) { return ReadModel{std::move(model), std::nullopt}; };
  switch (format_of(file.content(), file.extension)) {
    case ModelFormat::cityjson:
      if (!is_foreign_json(files, file)) return plain(read_cityjson(file, report));
      count_dropped(report, "file that is no model", file.name);
      return std::nullopt;
    case ModelFormat::obj:
      return read_obj_at_its_place(files, name, file, report);
    case ModelFormat::dxf:
      return plain(read_dxf(file, options, report));
    case ModelFormat::gltf:
      return plain(read_gltf(file, find, report));
    case ModelFormat::tiles_3d:
      return plain(read_3d_tiles(file, find, report));
    case ModelFormat::model_index:
      if (files.form() != ModelFiles::Form::file) return std::nullopt;
      throw bad_input(file.name, "features", "are an index of model files; give the folder that holds them");
    case ModelFormat::citygml:
      return plain(read_citygml(file, report));
    default:
      throw bad_input(file.name, "line 1",
                      "neither CityJSON (.json, .jsonl) nor Wavefront OBJ (.obj); convert it");
  }
}

}  // namespace veduta
