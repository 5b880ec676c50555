#include "scene/readers/readers.h"

#include <fmt/format.h>

#include "scene/footprints.h"
#include "scene/model_format.h"
#include "scene/readers/citygml.h"
#include "scene/readers/cityjson.h"
#include "scene/readers/dxf.h"
#include "scene/readers/extruded_footprints.h"
#include "scene/readers/gltf.h"
#include "scene/readers/obj.h"
#include "scene/readers/polygon_soup.h"
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

RawModel read_plan(const InputFile& file, const FindFile& find, const ImportOptions& options,
                   ImportReport& report) {
  const Footprints plan = read_footprints(file, find, options, report);
  RawModel model = extrude_footprints(plan, options, report);
  if (model.polygons.empty())
    throw bad_input(file.name, "whole file",
                    fmt::format("none of its {} footprints states a height or floors; name the attribute in "
                                "scene.height_field or scene.floors_field",
                                plan.footprints.size()));
  return model;
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
      return plain(is_dxf_plan(file) ? read_plan(file, find, options, report)
                                     : read_dxf(file, options, report));
    case ModelFormat::geojson:
    case ModelFormat::shapefile:
      return plain(read_plan(file, find, options, report));
    case ModelFormat::polygon_soup:
      return plain(read_polygon_soup(file, report));
    case ModelFormat::gltf:
      return plain(read_gltf(file, find, report));
    case ModelFormat::tiles_3d:
      return plain(read_3d_tiles(file, find, report));
    case ModelFormat::model_index:
      if (files.form() != ModelFiles::Form::file) return std::nullopt;
      throw bad_input(file.name, "features", "are an index of model files; give the folder that holds them");
    case ModelFormat::citygml:
      return plain(read_citygml(file, report));
    case ModelFormat::unknown:
      break;
  }
  throw bad_input(file.name, "line 1",
                  "neither its content nor its extension is of a format that is read (docs/importing.md); "
                  "convert it to CityJSON, glTF or OBJ");
}

}  // namespace veduta
