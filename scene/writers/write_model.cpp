#include "scene/writers/write_model.h"

#include <algorithm>
#include <cctype>
#include <chrono>

#include "scene/atomic_file.h"
#include "scene/error.h"
#include "scene/writers/cityjson_writer.h"
#include "scene/writers/dxf_writer.h"
#include "scene/writers/obj_writer.h"

namespace veduta::city {
namespace {

using Writer = void (*)(const WrittenCity&, OrderedOutput&);

Writer writer_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".json") return write_cityjson;
  if (extension == ".obj") return write_obj;
  if (extension == ".dxf") return write_dxf;
  throw Error(ExitStatus::usage,
              file.string() + ": cannot tell the format from the name; end it in .city.json, .obj or .dxf");
}

double since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

void check_writable_format(const std::filesystem::path& file) {
  writer_of(file);
}

WrittenFile write_model(const CityModel& model, const std::filesystem::path& file) {
  const auto begin = std::chrono::steady_clock::now();
  const Writer writer = writer_of(file);
  const WrittenCity city(model);
  WrittenFile written;
  write_atomically(file, [&](const std::filesystem::path& temporary) {
    OrderedOutput output(temporary);
    writer(city, output);
    output.close();
    written.bytes = output.bytes();
    written.seconds_in_system = output.seconds_in_system();
  });
  written.seconds = since(begin);
  return written;
}

}  // namespace veduta::city
