// The file that a tile leaves of its cells: private to the preparation, read by the program that wrote it.
#include <cstring>
#include <fstream>
#include <span>
#include <string>

#include "pvs/digest.h"
#include "scene/atomic_file.h"
#include "scene/error.h"
#include "worker/tile_cells.h"

namespace veduta {
namespace {

constexpr char magic[8] = {'V', 'D', 'T', 'C', 'E', 'L', '0', '1'};

/// A cell without the padding that a compiler adds.
struct StoredCell {
  int32_t i, j, k;
  uint16_t size_class, open;
  Box box;
};
static_assert(sizeof(StoredCell) == 40 && sizeof(Hash128) == 16 && sizeof(glm::ivec3) == 12);

class Writer {
 public:
  template <typename T>
  void value(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <typename T>
  void list(const std::vector<T>& values) {
    value(uint64_t{values.size()});
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  std::string& bytes() { return bytes_; }

 private:
  std::string bytes_;
};

class Reader {
 public:
  Reader(std::string_view bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}
  template <typename T>
  void value(T& value) {
    std::memcpy(&value, take(1, sizeof value), sizeof value);
  }
  template <typename T>
  void list(std::vector<T>& values) {
    uint64_t count = 0;
    value(count);
    const char* from = take(count, sizeof(T));
    values.resize(count);
    if (count > 0) std::memcpy(values.data(), from, count * sizeof(T));
  }
  bool at_end() const { return bytes_.empty(); }
  [[noreturn]] void fail() const {
    throw Error(ExitStatus::bad_input, name_ + ": missing or damaged; bake again with --fresh");
  }

 private:
  const char* take(uint64_t count, size_t size) {
    if (count > bytes_.size() / size) fail();
    const char* from = bytes_.data();
    bytes_.remove_prefix(count * size);
    return from;
  }

  std::string_view bytes_;
  std::string name_;
};

/// Calls visit for every field of a forest, for writing and for reading.
template <typename Stream, typename Forest>
void each_field(Stream& stream, Forest& forest) {
  stream.value(forest.lower);
  stream.value(forest.leaf_size_m);
  stream.value(forest.depth);
  stream.list(forest.roots);
  stream.list(forest.states);
  stream.list(forest.first_child);
}

template <typename Stream, typename Patch>
void each_ground_field(Stream& stream, Patch& ground) {
  for (auto* number : {&ground.i0, &ground.j0, &ground.nx, &ground.ny}) stream.value(*number);
  stream.list(ground.height);
}

}  // namespace

void write_tile_cells(const std::filesystem::path& file, const TileCells& tile) {
  Writer writer;
  writer.value(magic);
  std::vector<StoredCell> cells;
  for (const LatticeCell& c : tile.cells) cells.push_back({c.i, c.j, c.k, c.size_class, c.open, c.box});
  writer.list(cells);
  each_field(writer, tile.free);
  each_field(writer, tile.surfaces);
  each_ground_field(writer, tile.ground);
  writer.value(hash128(writer.bytes().data(), writer.bytes().size()));
  write_atomically(file, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out.write(writer.bytes().data(), static_cast<std::streamsize>(writer.bytes().size()));
    out.close();
    if (!out) throw Error(ExitStatus::input_output, file.string() + ": cannot be written; is the disk full?");
  });
}

TileCells read_tile_cells(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  Reader whole(bytes, file.string());
  if (bytes.size() < sizeof magic + sizeof(Hash128) || std::memcmp(bytes.data(), magic, sizeof magic) != 0)
    whole.fail();
  const size_t end = bytes.size() - sizeof(Hash128);
  Hash128 digest;
  std::memcpy(&digest, bytes.data() + end, sizeof digest);
  if (digest != hash128(bytes.data(), end)) whole.fail();

  Reader reader(std::string_view(bytes).substr(sizeof magic, end - sizeof magic), file.string());
  TileCells tile;
  std::vector<StoredCell> cells;
  reader.list(cells);
  for (const StoredCell& c : cells)
    tile.cells.push_back({c.i, c.j, c.k, static_cast<uint8_t>(c.size_class), c.open != 0, c.box});
  each_field(reader, tile.free);
  each_field(reader, tile.surfaces);
  each_ground_field(reader, tile.ground);
  if (!reader.at_end()) reader.fail();
  return tile;
}

}  // namespace veduta
