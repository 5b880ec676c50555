#include "bench/merge_run.h"

#include <fmt/format.h>

#include <fstream>

#include "pvs/pvs_file.h"
#include "pvs/shard.h"

namespace veduta::bench {

namespace {

constexpr const char* job = "0123456789abcdef0123456789abcdef";

/// A number that looks random and depends on its arguments alone.
uint64_t mix(uint64_t a, uint64_t b) {
  uint64_t x = a * 0x9E3779B97F4A7C15u + b + 0x632BE59BD9B4E019u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

City city_of(const MergeCity& size) {
  City city;
  Scene& scene = city.scene;
  for (uint32_t i = 0; i < size.objects; ++i) {
    const auto x = static_cast<float>(20 * (i % 1000)), y = static_cast<float>(20 * (i / 1000));
    const auto first = static_cast<uint32_t>(scene.triangles.size());
    for (uint32_t t = 0; t < size.triangles_per_object; ++t) {
      const auto v = static_cast<uint32_t>(scene.vertices.size());
      const auto z = static_cast<float>(t);
      scene.vertices.insert(scene.vertices.end(), {{x, y, z}, {x + 8, y, z}, {x, y + 6, z + 12}});
      scene.triangles.push_back({v, v + 1, v + 2});
      scene.material.push_back(Material::wall);
      city.triangle_slices.push_back({1, 4, 1, 1, 1, 4});
    }
    scene.objects.push_back({fmt::format("building-{}", i), Kind::building, first,
                             static_cast<uint32_t>(scene.triangles.size())});
    city.slices.push_back({4, 1, 4});
  }
  for (uint32_t c = 0; c < size.cells; ++c) {
    const auto x = static_cast<float>(10 * (c % 1000)), y = static_cast<float>(10 * (c / 1000));
    city.cells.push_back({{x, y, 1}, {x + 10, y + 10, 2}});
  }
  return city;
}

CellRecord record_of(const MergeCity& size, uint32_t cell) {
  const uint32_t seen_from = cell - (cell % 8 == 7 ? 1 : 0);
  CellRecord record{cell, CellStatus::baked, static_cast<uint32_t>(20000 + mix(cell, 1) % 60000), {}, 1.25f};
  uint32_t object = static_cast<uint32_t>(uint64_t{seen_from} * size.objects / size.cells / 4);
  for (uint32_t run = 0; record.row.size() < size.entries; ++run) {
    object += static_cast<uint32_t>(mix(seen_from / 8, run) % 40 + 2);
    const auto length = static_cast<uint32_t>(mix(seen_from / 4, run + 1000) % 9 + mix(seen_from, run) % 2);
    for (uint32_t k = 0; k < length && object < size.objects; ++k, ++object) {
      const uint64_t part = mix(object, seen_from / 4);
      record.row.push_back({object, part % 3 == 0 ? VisibilityIndex{static_cast<int8_t>(part / 4 % 3 + 1), 0,
                                                                    static_cast<int8_t>(part / 32 % 3 + 2)}
                                                  : completely_visible});
    }
    if (object >= size.objects) break;
  }
  return record;
}

}  // namespace

uint64_t write_merge_run(const RunPaths& run, const MergeCity& size) {
  std::filesystem::create_directories(run.prepared());
  std::filesystem::create_directories(run.shards());
  std::ofstream(run.fingerprint()) << job << "\n";
  std::ofstream(run.settings()) << "# generated\n";
  write_city(run.city(), city_of(size));
  uint64_t bytes = 0;
  const uint32_t leases = (size.cells + size.lease - 1) / size.lease;
  // Neighbouring leases go to different workers, in an order that never repeats.
  for (uint32_t shard = 0; shard < size.shards; ++shard) {
    ShardWriter writer(run.shards() / fmt::format("0001-{:05}-00.shard", shard), job, "generated");
    for (uint32_t group = 0; group * size.shards < leases; ++group) {
      const uint32_t lease =
          group * size.shards + static_cast<uint32_t>((shard + mix(group, 7)) % size.shards);
      for (uint32_t c = lease * size.lease; c < std::min((lease + 1) * size.lease, size.cells); ++c)
        writer.append(record_of(size, c));
    }
    bytes += writer.bytes();
  }
  return bytes;
}

}  // namespace veduta::bench
