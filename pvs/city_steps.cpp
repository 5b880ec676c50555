// A prepared city written in two steps.
#include <fmt/format.h>

#include <string_view>

#include "pvs/city_columns.h"
#include "pvs/pvs_check.h"
#include "scene/atomic_file.h"
#include "scene/error.h"

namespace veduta {

namespace {

using hdf5::Input;
using hdf5::Output;

void refuse(const std::optional<std::string>& defect, const std::filesystem::path& file) {
  if (defect)
    throw Error(ExitStatus::defect,
                fmt::format("{}: {}; a defect of the preparation, please report it", file.string(), *defect));
}

/// The digests that the first step stored; check_written compares them with the values.
ColumnDigests scene_digests(const std::filesystem::path& scene_file) {
  const Input input(scene_file);
  ColumnDigests digests;
  for (const Column* column : column::all) {
    if (std::string_view(column->path).starts_with("/scene/"))
      digests[column->path] = input.text(column->path, "digest");
  }
  return digests;
}

}  // namespace

void write_city_scene(const std::filesystem::path& scene_file, const City& city) {
  refuse(find_scene_defect(city), scene_file);
  write_atomically(scene_file, [&](const std::filesystem::path& temporary) {
    Output output(temporary);
    ColumnDigests digests;
    write_scene_columns(output, city, digests);
    output.close();
  });
}

void complete_city(const std::filesystem::path& scene_file, const std::filesystem::path& file,
                   const City& places) {
  refuse(find_place_defect(places), file);
  ColumnDigests digests = scene_digests(scene_file);
  RootAttributes root;
  root.format = city_format;
  root.version = city_version;
  root.crs = places.scene.crs, root.origin = places.scene.origin;
  write_atomically(
      file,
      [&](const std::filesystem::path& temporary) {
        hdf5::copy_output(scene_file, temporary);
        Output output(temporary, Output::Start::go_on);
        write_place_columns(output, places, digests);
        root.content_digest = content_digest(places, root.header.conservative, digests);
        write_root(output, root);
        output.close();
      },
      [&](const std::filesystem::path& temporary) { check_written(temporary, digests, root); });
}

}  // namespace veduta
