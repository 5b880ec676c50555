#include "tests/fuzz/pieces.h"

#include <cstring>
#include <set>
#include <string_view>

#include "pvs/city_columns.h"
#include "pvs/verification_columns.h"

namespace veduta::test {

namespace {

using hdf5::ColumnReader;
using hdf5::ColumnWriter;
using hdf5::Input;
using hdf5::Output;

bool of_verification(const Column& column) {
  return std::string_view(column.path).starts_with("/verification/");
}

/// Makes the groups on the way to a dataset that are not there yet.
void make_groups(Output& output, const std::string& path, std::set<std::string>& made) {
  for (size_t slash = path.find('/', 1); slash != std::string::npos; slash = path.find('/', slash + 1))
    if (made.insert(path.substr(0, slash)).second) output.group(path.substr(0, slash).c_str());
}

void write_lattice(Output& output, const char* group, const OctreeForest& forest) {
  output.attribute(group, "lower", std::vector<float>{forest.lower.x, forest.lower.y, forest.lower.z});
  output.attribute(group, "leaf_size_m", std::vector<float>{forest.leaf_size_m});
  output.attribute(group, "depth", forest.depth);
}

}  // namespace

Pieces take_apart(const std::filesystem::path& file) {
  const Input input(file);
  Pieces out;
  out.root = read_root(input, pvs_format);
  out.frame.scene.crs = out.root.crs;
  out.frame.scene.origin = out.root.origin;
  read_lattices(input, out.frame.navigation);
  for (const Column* column : column::all) {
    if (of_verification(*column) || !input.has(column->path)) continue;
    const ColumnReader reader(input, *column);
    Piece piece{column, reader.rows(), reader.columns(), 1, {}};
    piece.element_bytes = reader.row_bytes() / std::max<uint64_t>(1, reader.columns());
    reader.read([&](const std::byte* rows, uint64_t, size_t count) {
      piece.bytes.append(reinterpret_cast<const char*>(rows), count * reader.row_bytes());
    });
    out.pieces.push_back(std::move(piece));
  }
  if (input.has(verification_group)) out.verification = read_verification(input, out.root.content_digest);
  return out;
}

void put_together(const std::filesystem::path& file, const Pieces& pieces) {
  Output output(file);
  std::set<std::string> made;
  ColumnDigests digests;
  for (const Piece& piece : pieces.pieces) {
    make_groups(output, piece.column->path, made);
    ColumnWriter writer(output, *piece.column, piece.rows, piece.element_bytes, piece.columns);
    writer.append(piece.bytes.data(), piece.rows);
    digests[piece.column->path] = writer.finish();
  }
  const Navigation& navigation = pieces.frame.navigation;
  write_lattice(output, column::free_forest.group, navigation.free);
  write_lattice(output, column::surface_forest.group, navigation.surfaces);
  output.attribute("/navigation/ground", "lower",
                   std::vector<float>{navigation.ground.lower_x, navigation.ground.lower_y});
  output.attribute("/navigation/ground", "step_m", std::vector<float>{navigation.ground.step_m});
  RootAttributes root = pieces.root;
  City frame = pieces.frame;
  frame.scene.crs = root.crs;
  frame.scene.origin = root.origin;
  root.content_digest = content_digest(frame, root.header.conservative, digests);
  write_root(output, root);
  if (pieces.verification) write_verification(output, *pieces.verification, root.content_digest, digests);
  output.close();
}

}  // namespace veduta::test
