#include "scene/readers/polygon_soup.h"

#include "scene/readers/soup_builder.h"

namespace veduta {

RawModel read_polygon_soup(const InputFile& file, ImportReport& report) {
  const std::string_view content = file.content();
  const size_t begin = content.find_first_not_of(" \t\r\n");
  const std::string_view text = begin == content.npos ? std::string_view() : content.substr(begin);
  if (text.starts_with("ply")) return read_ply(file, report);
  if (file.extension == ".off" || text.substr(0, text.find_first_of(" \t\r\n")).ends_with("OFF"))
    return read_off(file, report);
  if (file.extension == ".stl" || text.starts_with("solid")) return read_stl(file, report);
  throw bad_input(file.name, "byte 0", "neither PLY nor OFF nor STL; convert it");
}

}  // namespace veduta
