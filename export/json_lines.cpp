// The PVS as text: a line for each cell, which can be read without the lines beside it.
#include <fmt/format.h>

#include "export/export.h"
#include "export/place.h"
#include "scene/writers/cityjson_names.h"
#include "scene/writers/ordered_output.h"

namespace veduta {
namespace {

using city::OrderedOutput;
using city::TextBuffer;

constexpr size_t flush_bytes = size_t{1} << 20;

class Lines {
 public:
  Lines(const PvsStream& stream, const std::filesystem::path& out)
      : stream_(stream), index_(stream.index()), output_(out) {
    place_ = ",\"crs\":" + city::quoted(index_.crs) + ",\"origin\":[";
    for (size_t axis = 0; axis < 3; ++axis)
      place_ += fmt::format("{}{}", axis == 0 ? "" : ",", index_.origin[axis]);
    place_ += "]";
    for (const Object& object : index_.objects)
      names_.push_back(fmt::format(",\"name\":{},\"kind\":\"{}\",\"x\":", city::quoted(object.name),
                                   kind_name(object.kind)));
  }

  void add(uint32_t cell) {
    const uint32_t row = index_.cell_row[cell];
    text_.add("{\"cell\":");
    text_.add_whole(cell);
    add_point(",\"lower\":[", index_.cells[cell].lower);
    add_point(",\"upper\":[", index_.cells[cell].upper);
    text_.add(place_);
    text_.add(",\"status\":\"");
    text_.add(status_name(index_.cell_status[cell]));
    text_.add("\",\"row\":");
    text_.add_whole(row);
    text_.add(",\"objects\":[");
    const PvsRow entries = stream_.read_row(row);
    for (size_t i = 0; i < entries.size(); ++i) add_entry(entries[i], i == 0);
    text_.add("]}\n");
    ++exported_.cells;
    exported_.objects += entries.size();
    if (text_.view().size() >= flush_bytes) flush();
  }

  Exported close() {
    flush();
    output_.close();
    exported_.bytes = output_.bytes();
    return exported_;
  }

 private:
  void add_point(const char* name, const glm::vec3& point) {
    text_.add(name);
    for (int axis = 0; axis < 3; ++axis) {
      if (axis > 0) text_.add(',');
      text_.add_exact(point[axis]);
    }
    text_.add(']');
  }

  void add_entry(const PvsEntry& entry, bool first) {
    text_.add(first ? "{\"object\":" : ",{\"object\":");
    text_.add_whole(entry.object);
    text_.add(names_[entry.object]);
    text_.add_whole(entry.index.x);
    text_.add(",\"y\":");
    text_.add_whole(entry.index.y);
    text_.add(",\"z\":");
    text_.add_whole(entry.index.z);
    text_.add('}');
    if (text_.view().size() >= flush_bytes) flush();  // a row may name every object of a large city
  }

  void flush() {
    output_.write(text_.view());
    text_.clear();
  }

  const PvsStream& stream_;
  const PvsIndex& index_;
  OrderedOutput output_;
  TextBuffer text_;
  std::string place_;
  std::vector<std::string> names_;  ///< [N] what an entry says of its object
  Exported exported_;
};

}  // namespace

Exported write_json_lines(const PvsStream& stream, std::optional<uint32_t> cell,
                          const std::filesystem::path& out) {
  Lines lines(stream, out);
  const auto cells = static_cast<uint32_t>(stream.index().cells.size());
  for (uint32_t c = cell.value_or(0); c < (cell ? *cell + 1 : cells); ++c) lines.add(c);
  return lines.close();
}

}  // namespace veduta
