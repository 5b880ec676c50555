// The group /verification in HDF5.
#include <fmt/format.h>

#include <cstring>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "pvs/city_columns.h"
#include "pvs/pvs_file.h"
#include "pvs/verification_columns.h"
#include "scene/atomic_file.h"
#include "scene/error.h"

namespace veduta {
namespace {

using hdf5::ColumnReader;
using hdf5::ColumnWriter;
using hdf5::Input;
using hdf5::Output;

/// Every attribute that is stored as it is: `attribute(name, member)`.
template <typename V, typename Attribute>
void each_attribute(V& v, const Attribute& attribute) {
  attribute("when", v.when);
  attribute("program", v.program);
  attribute("seed", v.seed);
  attribute("rays_per_cell", v.rays_per_cell);
  attribute("eyes_per_cell", v.eyes_per_cell);
  attribute("overestimate_objects", v.overestimate_objects);
  attribute("overestimate_buildings", v.overestimate_buildings);
  attribute("overestimate_triangles", v.overestimate_triangles);
  attribute("tightest_triangles", v.tightest_triangles);
  attribute("false_invisible_solid_angle_mean", v.false_invisible_solid_angle_mean);
  attribute("false_invisible_solid_angle_worst", v.false_invisible_solid_angle_worst);
  attribute("narrow_gap_limit_m", v.narrow_gap_limit_m);
  attribute("narrow_gap_triangles", v.narrow_gap_triangles);
  attribute("narrow_gap_solid_angle_mean", v.narrow_gap_solid_angle_mean);
  attribute("narrow_gap_solid_angle_worst", v.narrow_gap_solid_angle_worst);
}

/// Those that follow from the cells, for readers who do not add up.
template <typename Attribute>
void each_sum(const Verification& v, const Attribute& attribute) {
  attribute("cells_checked", uint64_t{v.cells.size()});
  attribute("cells_without_eye", v.cells_without_eye());
  attribute("rays", v.rays());
  attribute("false_invisible_objects", v.false_invisible_objects());
  attribute("false_invisible_triangles", v.false_invisible_triangles());
  attribute("narrow_gap_objects", v.narrow_gap_objects());
  attribute("passed", uint64_t{v.passed()});
}

/// Over everything in the group, and over which cells it is about: another's verification does not pass.
std::string group_digest(const Verification& v, const std::string& content_digest,
                         const ColumnDigests& columns) {
  Digest digest;
  digest.update_text(content_digest);
  const auto add = [&](const char* name, const auto& value) {
    digest.update_text(name);
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>)
      digest.update_text(value);
    else
      digest.update(&value, sizeof value);
  };
  each_attribute(v, add);
  for (const auto& [path, hex] : columns) add(path.c_str(), hex);
  return digest.hex();
}

template <typename T>
void put(std::vector<std::byte>& row, const T& member) {
  const auto* bytes = reinterpret_cast<const std::byte*>(&member);
  row.insert(row.end(), bytes, bytes + sizeof member);
}

template <typename T>
void take(const std::byte*& row, T& member) {
  std::memcpy(&member, row, sizeof member);
  row += sizeof member;
}

/// Every dataset: `dataset(column, items, members of an item)`. A row holds the members one after the other.
template <typename V, typename Dataset>
void each_dataset(V& v, const Dataset& dataset) {
  dataset(column::verified_cell, v.cells, [](auto& c) { return std::tie(c.cell); });
  dataset(column::verified_rays, v.cells, [](auto& c) { return std::tie(c.rays); });
  dataset(column::verified_objects, v.cells, [](auto& c) { return std::tie(c.pvs_objects, c.seen_objects); });
  dataset(column::verified_triangles, v.cells,
          [](auto& c) { return std::tie(c.pvs_triangles, c.seen_triangles); });
  dataset(column::verified_false, v.cells, [](auto& c) {
    return std::tie(c.false_invisible_objects, c.false_invisible_triangles, c.narrow_gap_objects);
  });
  dataset(column::verified_solid_angle, v.cells,
          [](auto& c) { return std::tie(c.false_invisible_solid_angle); });
  dataset(column::witness_cell, v.witnesses, [](auto& w) { return std::tie(w.cell); });
  dataset(column::witness_object, v.witnesses, [](auto& w) { return std::tie(w.object); });
  dataset(column::witness_triangle, v.witnesses, [](auto& w) { return std::tie(w.triangle); });
  dataset(column::witness_ray, v.witnesses, [](auto& w) { return std::tie(w.eye, w.direction, w.hit); });
  dataset(column::witness_gap, v.witnesses, [](auto& w) { return std::tie(w.gap_m, w.gap_from_eye_m); });
}

}  // namespace

void write_verification(Output& output, const Verification& v, const std::string& content_digest,
                        ColumnDigests& digests) {
  for (const char* group : {verification_group, "/verification/cells", "/verification/examples"})
    output.group(group);
  ColumnDigests own;
  each_dataset(v, [&](const Column& column, const auto& items, const auto& members_of) {
    ColumnWriter writer(output, column, items.size());
    std::vector<std::byte> row;
    for (const auto& item : items) {
      row.clear();
      std::apply([&](const auto&... member) { (put(row, member), ...); }, members_of(item));
      writer.append(row.data(), 1);
    }
    own[column.path] = writer.finish();
  });
  const auto attribute = [&](const char* name, const auto& value) {
    output.attribute(verification_group, name, value);
  };
  each_attribute(v, attribute);
  each_sum(v, attribute);
  output.attribute(verification_group, "digest", group_digest(v, content_digest, own));
  digests.insert(own.begin(), own.end());
}

Verification read_verification(const Input& input, const std::string& content_digest) {
  Verification v;
  v.cells.resize(ColumnReader(input, column::verified_cell).rows());
  v.witnesses.resize(ColumnReader(input, column::witness_cell).rows());
  ColumnDigests own;
  each_dataset(v, [&](const Column& column, auto& items, const auto& members_of) {
    const ColumnReader reader(input, column);
    if (reader.rows() != items.size()) input.fail(column.path, "not one for each of its group");
    own[column.path] = reader.read([&](const std::byte* rows, uint64_t first, size_t count) {
      for (size_t i = 0; i < count; ++i)
        std::apply([&](auto&... member) { (take(rows, member), ...); }, members_of(items[first + i]));
    });
  });
  each_attribute(v, [&](const char* name, auto& value) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, std::string>)
      value = input.text(verification_group, name);
    else if constexpr (std::is_same_v<Value, double>)
      value = input.real(verification_group, name);
    else
      value = input.large_number(verification_group, name);
  });
  each_sum(v, [&](const char* name, uint64_t sum) {
    if (input.large_number(verification_group, name) != sum)
      input.fail(fmt::format("{}@{}", verification_group, name), "not what follows from its cells");
  });
  if (input.text(verification_group, "digest") != group_digest(v, content_digest, own))
    input.fail(verification_group, "its digest does not hold: damaged, or about another file; verify again");
  return v;
}

namespace {

/// The digests of all that is in the file but a verification; check_written compares them with the values.
ColumnDigests stored_digests(const Input& input) {
  ColumnDigests digests;
  for (const Column* column : column::all)
    if (!std::string_view(column->path).starts_with("/verification/") && input.has(column->path))
      digests[column->path] = input.text(column->path, "digest");
  return digests;
}

}  // namespace

void store_verification(const std::filesystem::path& name, const PvsFile& checked, const Verification& v) {
  const std::filesystem::path file = std::filesystem::weakly_canonical(name);  // a link goes on leading to it
  if (const auto defect = find_defect(v, checked.city.cells.size(), checked.city.scene.objects))
    throw Error(ExitStatus::defect, fmt::format("{}: {}; a defect of the verification, please report it",
                                                name.string(), *defect));
  RootAttributes root;
  ColumnDigests digests;
  bool replaces = false;
  {
    const Input input(file);
    root = read_root(input, pvs_format);
    if (root.content_digest != checked.content_digest)
      input.fail("/@content_digest", "the file was replaced while it was verified; verify again");
    digests = stored_digests(input);
    replaces = input.has(verification_group);
  }
  write_atomically(
      file,
      [&](const std::filesystem::path& temporary) {
        hdf5::copy_output(file, temporary);
        Output output(temporary, Output::Start::go_on);
        if (replaces) output.remove(verification_group);
        write_verification(output, v, root.content_digest, digests);
        output.close();
      },
      [&](const std::filesystem::path& temporary) {
        check_written(temporary, digests, root);
        if (read_verification(Input(temporary), root.content_digest) != v)
          throw Error(ExitStatus::input_output,
                      fmt::format("{}: read back other values than were written: the disk is full or faulty",
                                  temporary.string()));
      });
}

}  // namespace veduta
