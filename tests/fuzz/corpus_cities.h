// Files of every kind that the format knows, each as small as it can be.
#pragma once

#include "pvs/pvs_file.h"
#include "tests/pvs/small_verification.h"

namespace veduta::test {

/// A terrain of triangles that is stored in more than one chunk a dataset, though it packs to little, and 64
/// buildings.
inline City wide_city() {
  City city = small_city(64, 40);
  Scene& scene = city.scene;
  Object& terrain = scene.objects.back();
  constexpr uint32_t strip = 23000;  // 12 bytes a vertex and a triangle: two chunks of 256 KiB
  const auto first = static_cast<uint32_t>(scene.vertices.size());
  for (uint32_t i = 0; i < strip; ++i)
    scene.vertices.push_back({static_cast<float>(i / 2), static_cast<float>(i % 2), -1});
  for (uint32_t i = 0; i + 2 < strip; ++i) {
    scene.triangles.push_back({first + i, first + i + 1, first + i + 2});
    scene.material.push_back(Material::terrain);
    city.triangle_slices.push_back({1, 1, 1, 1, 1, 1});
  }
  terrain.kind = Kind::terrain;
  terrain.triangle_end = scene.triangles.size();
  return city;
}

/// Rows of many entries, of all three bytes.
inline BakedCell wide_row(uint32_t c) {
  BakedCell cell{CellStatus::baked, 7 * c, {}, 1 + static_cast<float>(c) / 16, c % 2};
  for (uint32_t object = c % 5; object < 64; object += 1 + c % 4) {
    const auto x = static_cast<int8_t>(object % 4 - 2);
    cell.row.push_back({object, {x, 0, static_cast<int8_t>(x == 0 ? 1 + object % 2 : object % 3)}});
  }
  return cell;
}

inline void write_corpus(const std::filesystem::path& to) {
  write_pvs(to / "small.pvs.h5", small_city(), small_header(), small_row_of_worker, small_workers);
  std::filesystem::copy_file(to / "small.pvs.h5", to / "verified.pvs.h5",
                             std::filesystem::copy_options::overwrite_existing);
  store_verification(to / "verified.pvs.h5", read_pvs(to / "verified.pvs.h5"), small_verification());
  write_pvs(to / "nothing.pvs.h5", City{}, PvsHeader{}, small_row);
  write_pvs(to / "no_rows_baked.pvs.h5", small_city(3, 4), small_header(),
            [](uint32_t) { return BakedCell{}; });
  write_pvs(to / "wide.pvs.h5", wide_city(), small_header(), wide_row, small_workers);
}

}  // namespace veduta::test
