// Shrinking methods against each other: volume kept of what erosion leaves, triangles and seconds a building.
// JSON in, JSON out:
//
//   echo '{"config": "configs/demo.toml", "methods": ["sealed", "vertex"], "blocks": 6}' |
//   veduta-bench-shrink
//
// Model, seed and windows are the configuration's: parts of cells and whole cells, unless "half_extents"
// names others ([[x, y, z], ...] in m). The city is cut into blocks ("core_m") with a halo; of those with
// buildings "blocks" are taken, spread over the city (0: all). Volumes are by "points" random points a block,
// in the ring nearest to the eye. "alone": so many of the buildings are shrunk again, each by itself.
//
// "veduta-bench-shrink --table FILE..." writes the table of docs/shrinking.md from such answers.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>

#include "bench/shrink_city.h"
#include "bench/shrink_table.h"
#include "bench/shrink_volumes.h"
#include "worker/shrink_vertex.h"

namespace veduta::bench {
namespace {

/// Triangles of a building: of the bodies whose middle lies over it, or nearest to it.
std::vector<uint64_t> triangles_by_building(const Scene& scene, const std::vector<uint32_t>& buildings,
                                            const OccluderMesh& mesh) {
  std::vector<uint64_t> counts(buildings.size(), 0);
  for (size_t b = 0; b < mesh.bodies(); ++b) {
    const glm::vec3 middle = mesh.bounds(b).center();
    size_t nearest = 0;
    double least = HUGE_VAL;
    for (size_t n = 0; n < buildings.size(); ++n) {
      const Box box = scene.bounds(buildings[n]);
      const glm::vec3 beside = middle - glm::clamp(middle, box.lower, box.upper), off = middle - box.center();
      const double distance =
          1e6 * (std::abs(beside.x) + std::abs(beside.y)) + std::abs(off.x) + std::abs(off.y);
      if (distance < least) least = distance, nearest = n;
    }
    uint64_t triangles = 0;
    for (uint32_t f = mesh.body_begin[b]; f < mesh.body_begin[b + 1]; ++f)
      triangles += mesh.face_begin[f + 1] - mesh.face_begin[f] - 2;
    counts[nearest] += triangles;
  }
  return counts;
}

struct MethodResult {
  double seconds = 0;
  std::vector<std::vector<uint64_t>> triangles;  // by window, of each building
  VertexCounts counts;
};

std::vector<WindowOccluders> shrink_timed(const Job& job, const SealedBlock& block, const std::string& name,
                                          MethodResult& result) {
  const std::unique_ptr<Shrinker> shrinker = make_shrinker(name);
  const auto begin = std::chrono::steady_clock::now();
  const auto* vertex = dynamic_cast<const VertexShrinker*>(shrinker.get());
  std::vector<WindowOccluders> windows = vertex != nullptr ? vertex->shrink(block, job.request, result.counts)
                                                           : shrinker->shrink(block, job.request);
  result.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return windows;
}

double median(std::vector<uint64_t> values) {
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return static_cast<double>(values[values.size() / 2]);
}

double mean(const std::vector<uint64_t>& values) {
  double sum = 0;
  for (const uint64_t v : values) sum += static_cast<double>(v);
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

Json counts_json(const VertexCounts& c) {
  return {{"faces", c.faces},   {"spikes", c.spikes}, {"turned", c.turned}, {"intersecting", c.intersecting},
          {"unsafe", c.unsafe}, {"kept", c.kept}};
}

/// All blocks, whole.
Json measure_blocks(const Job& job, const City& city, const std::vector<Piece>& pieces) {
  const size_t windows = job.request.half_extents_m.size(), methods = job.methods.size();
  std::vector<MethodResult> results(methods, {0, std::vector<std::vector<uint64_t>>(windows), {}});
  Volumes volumes(windows, methods);
  size_t buildings = 0;
  for (const Piece& piece : pieces) {
    buildings += piece.buildings.size();
    Made made;
    for (size_t m = 0; m < methods; ++m) {
      made.push_back(shrink_timed(job, piece.block, job.methods[m], results[m]));
      for (size_t w = 0; w < windows; ++w) {
        const auto counts =
            triangles_by_building(city.scene(), piece.buildings, made.back()[w].rings.front().occluders);
        results[m].triangles[w].insert(results[m].triangles[w].end(), counts.begin(), counts.end());
      }
    }
    volumes.add(job, piece.block, made, job.points);
  }
  Json out = {{"blocks", pieces.size()}, {"buildings", buildings}};
  for (size_t m = 0; m < methods; ++m) {
    Json& method = out["methods"][job.methods[m]];
    method["seconds_a_building"] = results[m].seconds / static_cast<double>(std::max<size_t>(buildings, 1));
    if (results[m].counts.faces > 0) method["faces"] = counts_json(results[m].counts);
  }
  for (size_t w = 0; w < windows; ++w) {
    const glm::dvec3& e = job.request.half_extents_m[w];
    const double eroded = volumes.eroded[w].m3;
    Json window = {{"half_extent_m", {e.x, e.y, e.z}},
                   {"eroded_m3", eroded},
                   {"eroded_error_m3", volumes.eroded[w].error()}};
    for (size_t m = 0; m < methods; ++m) {
      const Volumes::Kept& kept = volumes.kept[w][m];
      window["methods"][job.methods[m]] = {{"kept_share", eroded > 0 ? kept.volume.m3 / eroded : 1},
                                           {"kept_error", eroded > 0 ? kept.volume.error() / eroded : 0},
                                           {"points_outside", kept.outside},
                                           {"triangles_median", median(results[m].triangles[w])},
                                           {"triangles_mean", mean(results[m].triangles[w])}};
    }
    out["windows"].push_back(window);
  }
  return out;
}

/// The same buildings together and one by one: whole blocks, until there are as many as asked for.
Json measure_alone(const Job& job, const City& city, const std::vector<Piece>& pieces) {
  const size_t windows = job.request.half_extents_m.size(), methods = job.methods.size();
  Volumes together(windows, methods), alone(windows, methods);
  ExactVolumes exact(windows, methods);
  size_t count = 0;
  for (const Piece& piece : pieces) {
    if (count >= job.alone) break;
    MethodResult ignored;
    const auto make = [&](const SealedBlock& block) {
      Made made;
      for (const std::string& name : job.methods) made.push_back(shrink_timed(job, block, name, ignored));
      return made;
    };
    together.add(job, piece.block, make(piece.block), job.points);
    for (const uint32_t object : piece.buildings) {
      const SealedBlock block = city.alone(object);
      const Made made = make(block);
      alone.add(job, block, made, job.points / 10);
      if (count < job.exact) exact.add(job, block, made);
      ++count;
    }
  }
  Json out = {{"buildings", count}};
  for (size_t w = 0; w < windows; ++w) {
    Json window = {{"eroded_together_m3", together.eroded[w].m3}, {"eroded_alone_m3", alone.eroded[w].m3}};
    for (size_t m = 0; m < methods; ++m) {
      window["methods"][job.methods[m]] = {{"kept_together_m3", together.kept[w][m].volume.m3},
                                           {"kept_alone_m3", alone.kept[w][m].volume.m3}};
    }
    out["windows"].push_back(window);
  }
  if (job.exact > 0) out["exact"] = exact.json(job);
  return out;
}

Json measure(const Json& in) {
  Job job = job_from(in);
  const City city(job);
  const std::vector<Piece> pieces = city.pieces();
  Json out = {{"name", in.value("name", in.at("config").get<std::string>())},
              {"seed_size_m", city.seed_size_m()},
              {"core_m", job.core_m}};
  out.update(measure_blocks(job, city, pieces));
  if (job.alone > 0) out["alone"] = measure_alone(job, city, pieces);
  return out;
}

}  // namespace
}  // namespace veduta::bench

int main(int count, char** arguments) {
  try {
    if (count > 1 && std::string(arguments[1]) == "--table") {
      std::cout << veduta::bench::shrink_table({arguments + 2, arguments + count});
    } else {
      std::cout << veduta::bench::measure(nlohmann::ordered_json::parse(std::cin)).dump(2) << std::endl;
    }
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "veduta-bench-shrink: " << error.what()
              << "; give {\"config\": \"FILE.toml\", \"methods\": [\"sealed\", ...]}\n";
    return 2;
  }
}
