#include "scene/readers/tiles_3d.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <mutex>
#include <optional>
#include <set>

#include "scene/names.h"
#include "scene/readers/b3dm.h"
#include "scene/readers/earth_centred.h"
#include "scene/readers/gltf_document.h"
#include "scene/readers/gltf_nodes.h"
#include "scene/readers/gltf_objects.h"
#include "scene/readers/tile_content.h"
#include "scene/readers/tileset.h"

namespace veduta {
namespace {

constexpr int deepest = 64;                        // tilesets in tilesets, composites in composites
constexpr int deepest_tile = 1000;                 // below the root of the first tileset
constexpr uint64_t bytes_at_a_time = 16'000'000;   // of tiles that are parsed together
constexpr uint64_t most_repeated = 1'000'000'000;  // bytes of content that several tiles show

// "roads", "road" and "relief_2018" state a kind.
Kind kind_of_path(const std::string& path, Kind otherwise) {
  const std::filesystem::path file(path);
  for (std::string name : {file.stem().string(), file.parent_path().filename().string()}) {
    if (name.ends_with('s')) name.pop_back();
    if (const Kind kind = stated_kind(name, otherwise); kind != otherwise) return kind;
  }
  return otherwise;
}

class TilesReader {
 public:
  TilesReader(const InputFile& file, const FindFile& find, ImportReport& report)
      : file_(file), find_(find), report_(report) {
    model_.file = file.name;
  }

  RawModel read() {
    // The file is the caller's: it outlives this.
    const std::shared_ptr<const InputFile> file(std::shared_ptr<const InputFile>(), &file_);
    const std::string path = std::filesystem::path(file_.name).filename().string();
    const std::string_view bytes = file_.content();
    if (bytes.starts_with("b3dm") || bytes.starts_with("cmpt")) {
      model_.format = "3D Tiles";
      if (bytes.starts_with("b3dm")) on_globe_ = earth_centred(read_b3dm(bytes, file_.name).rtc_center);
      add_content({file, bytes, path, glm::dmat4(1), z_up_from_y_up(),
                   kind_of_path(file_.name, Kind::building), !on_globe_},
                  0);
    } else {
      const Tileset tileset = read_tileset(file_);
      model_.format = "3D Tiles " + tileset.version;
      on_globe_ = tileset.on_globe;
      visited_.insert(path);
      visit(tileset.root,
            {glm::dmat4(1), tileset.z_up_from_gltf, "", kind_of_path(file_.name, Kind::building), 0, 0});
    }
    parse_pending();
    if (on_globe_) to_geographic(model_);
    return std::move(model_);
  }

 private:
  // What a tile inherits.
  struct Place {
    glm::dmat4 world_from_parent{1};
    glm::dmat4 z_up_from_gltf{1};
    std::string folder;  // of its tileset, relative to the first one's
    Kind kind = Kind::building;
    int depth = 0;  // of the tileset
    int level = 0;  // of the tile, in all tilesets
  };

  std::string where(const std::string& path) const { return file_.name + ": " + printable(path); }

  // Whether any content was found for the tile or below.
  bool visit(const Tile& tile, Place place) {
    if (++place.level > deepest_tile)
      throw bad_input(file_.name, "tiles",
                      "nest deeper than " + std::to_string(deepest_tile) + " levels; cut the tileset");
    place.world_from_parent = place.world_from_parent * tile.parent_from_tile;
    bool below = false;
    for (const Tile& child : tile.children) below |= visit(child, place);
    if (below && !tile.adds) {
      if (!tile.contents.empty())
        count_dropped(report_, "tile that finer ones replace", where(place.folder + tile.contents.front()),
                      tile.contents.size());
      return true;
    }
    bool here = false;
    for (const std::string& uri : tile.contents) here |= open(uri, place);
    return below || here;
  }

  bool open(const std::string& uri, const Place& place) {
    const std::string relative = decode_uri(uri.substr(0, uri.find_first_of("?#")));
    if (uri.find("://") != std::string::npos || uri.starts_with("data:")) {
      count_dropped(report_, "tile on the network", where(uri));
      return false;
    }
    const std::string path =
        std::filesystem::path(place.folder + relative).lexically_normal().generic_string();
    std::optional<InputFile> found = find_(path);
    if (!found) {
      count_dropped(report_, "tile that is missing", where(path));
      return false;
    }
    const auto file = std::make_shared<const InputFile>(*std::move(found));
    const bool again = !visited_.insert(path).second;
    if (again && (repeated_ += file->content().size()) > most_repeated)
      throw bad_input(file_.name, "tiles", "show " + printable(path) + " too often; cut the tileset");
    if (file->content().starts_with('{') && file->extension != ".gltf")
      return open_tileset(*file, path, place, again);
    return add_content(
        {file, file->content(), path, place.world_from_parent, place.z_up_from_gltf, place.kind, !on_globe_},
        place.depth);
  }

  bool open_tileset(const InputFile& file, const std::string& path, const Place& place, bool again) {
    if (again)
      throw bad_input(file.name, "file", "tileset that another one refers to twice; make them a tree");
    if (place.depth >= deepest)
      throw bad_input(file.name, "file", "tilesets nested deeper than " + std::to_string(deepest));
    const Tileset tileset = read_tileset(file);
    return visit(tileset.root, {place.world_from_parent, tileset.z_up_from_gltf, folder_of(path),
                                kind_of_path(path, place.kind), place.depth + 1, place.level});
  }

  bool add_content(TileContent content, int depth) {
    const std::string format = printable(content.bytes.substr(0, 4));
    if (format == "cmpt") {
      if (depth >= deepest)
        throw bad_input(content.file->name, "cmpt", "tiles nested deeper than " + std::to_string(deepest));
      bool any = false;
      for (const std::string_view bytes : read_cmpt(content.bytes, content.file->name)) {
        TileContent inner = content;
        inner.bytes = bytes;
        any |= add_content(std::move(inner), depth + 1);
      }
      return any;
    }
    if (format == "i3dm" || format == "pnts" || format == "vctr" || format == "geom") {
      count_dropped(report_, "tile of format " + format, where(content.path));
      return false;
    }
    if (!is_tile_format(content.bytes))
      throw bad_input(content.file->name, "file",
                      "is neither b3dm, glTF, cmpt nor tileset.json; fetch it again");
    pending_bytes_ += content.bytes.size();
    pending_.push_back(std::move(content));
    if (pending_bytes_ >= bytes_at_a_time) parse_pending();
    return true;
  }

  // In parallel; put together, and complained of, in order.
  void parse_pending() {
    struct Parsed {
      RawModel model;
      ImportReport report;
      std::exception_ptr error;
    };
    std::vector<Parsed> parsed(pending_.size());
    const FindFile find = [&](const std::string& relative) {
      const std::lock_guard lock(find_mutex_);
      return find_(relative);
    };
    tbb::parallel_for(size_t{0}, pending_.size(), [&](size_t i) {
      try {
        parsed[i].model = parse_tile(pending_[i], find, parsed[i].report);
      } catch (...) {
        parsed[i].error = std::current_exception();
      }
      pending_[i].file.reset();
    });
    pending_.clear();
    pending_bytes_ = 0;
    for (Parsed& part : parsed) {
      if (part.error) std::rethrow_exception(part.error);
      append(model_, std::move(part.model));
      for (const auto& [reason, dropped] : part.report.dropped)
        count_dropped(report_, reason, dropped.first_place, dropped.count);
    }
  }

  const InputFile& file_;
  const FindFile& find_;
  ImportReport& report_;
  RawModel model_;
  bool on_globe_ = false;
  std::set<std::string> visited_;  // paths of content
  uint64_t repeated_ = 0;          // bytes
  std::vector<TileContent> pending_;
  uint64_t pending_bytes_ = 0;
  std::mutex find_mutex_;
};

}  // namespace

RawModel read_3d_tiles(const InputFile& file, const FindFile& find, ImportReport& report) {
  return TilesReader(file, find, report).read();
}

}  // namespace veduta
