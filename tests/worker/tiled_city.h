// A scene in a run directory, cut into tiles as the preparation does.
#pragma once

#include <vector>

#include "tests/pvs/small_city.h"
#include "tests/worker/mesh.h"
#include "worker/preparation_plan.h"
#include "worker/tile_flood.h"
#include "worker/tile_triangles.h"

namespace veduta::test {

struct TiledCity {
  TiledCity(const Scene& scene, const Settings& settings, const PartSizes& sizes)
      : run{directory.path()}, plan(make_plan(scene, settings, sizes)) {
    clear_preparation(run);
    write_tile_triangles(run, scene, plan, 1000);
    write_plan(run, plan);
  }

  /// Floods in a random order until nothing changes. \return how many fills that took.
  int flood(Random& random) {
    std::vector<uint32_t> waiting;
    for (uint32_t tile = 0; tile < plan.tiles(); ++tile) waiting.push_back(tile);
    int fills = 0;
    while (!waiting.empty()) {
      const auto at = static_cast<size_t>(random.integer(0, static_cast<int>(waiting.size()) - 1));
      std::swap(waiting[at], waiting.back());
      const uint32_t tile = waiting.back();
      waiting.pop_back();
      ++fills;
      for (const uint32_t next : flood_tile(run, plan, tile)) {
        if (std::find(waiting.begin(), waiting.end(), next) == waiting.end()) waiting.push_back(next);
      }
    }
    return fills;
  }

  TemporaryDirectory directory;
  RunPaths run;
  PreparationPlan plan;
};

/// A town with what makes a fill wander: halls open to one side only, slits, a long tunnel, party walls.
inline Mesh wandering_town(Random& random) {
  Mesh mesh;
  mesh.ground(-13, -11, 14, 12, 0);
  for (int n = 0; n < 7; ++n) {
    const glm::vec3 at = random.point({{-11, -9, 0}, {9, 8, 0}});
    const Box box{at, at + random.point({{1, 1, 1}, {6, 5, 6}})};
    const glm::vec3 l = box.lower, u = box.upper;
    mesh.object();
    if (n % 3 == 0) {
      mesh.box(box);
    } else {  // a hall: a roof and three walls; the fourth has a gap of `gap` m or is not there
      mesh.quad({l.x, l.y, u.z}, {u.x, l.y, u.z}, {u.x, u.y, u.z}, {l.x, u.y, u.z});
      mesh.quad({l.x, l.y, 0}, {u.x, l.y, 0}, {u.x, l.y, u.z}, {l.x, l.y, u.z});
      mesh.quad({l.x, u.y, 0}, {u.x, u.y, 0}, {u.x, u.y, u.z}, {l.x, u.y, u.z});
      mesh.quad({l.x, l.y, 0}, {l.x, u.y, 0}, {l.x, u.y, u.z}, {l.x, l.y, u.z});
      const auto gap = static_cast<float>(random.real(0, 0.8));
      if (n % 3 == 1) mesh.quad({u.x, l.y + gap, 0}, {u.x, u.y, 0}, {u.x, u.y, u.z}, {u.x, l.y + gap, u.z});
    }
  }
  mesh.object();  // a tunnel across the town, open at one end, with a turn
  const auto wall = [&](float x0, float y0, float x1, float y1) {
    mesh.quad({x0, y0, 0}, {x1, y1, 0}, {x1, y1, 1.6f}, {x0, y0, 1.6f});
  };
  wall(-12, -10, 12.3f, -10), wall(-12, -8.5f, 10.7f, -8.5f);
  wall(12.3f, -10, 12.3f, 10), wall(10.7f, -8.5f, 10.7f, 10), wall(10.7f, 10, 12.3f, 10);
  mesh.quad({-12, -10, 1.6f}, {12.3f, -10, 1.6f}, {12.3f, -8.5f, 1.6f}, {-12, -8.5f, 1.6f});
  mesh.quad({10.7f, -8.5f, 1.6f}, {12.3f, -8.5f, 1.6f}, {12.3f, 10, 1.6f}, {10.7f, 10, 1.6f});
  return mesh;
}

/// Triangles anywhere: mazes.
inline Mesh triangle_soup(Random& random) {
  Mesh mesh;
  const Box room{{-9, -8, 0}, {8, 9, 5}};
  for (int n = 0; n < 60; ++n) {
    mesh.object(n % 7 == 0 ? Kind::terrain : Kind::building);
    const glm::vec3 at = random.point(room), reach{6, 6, 4};
    const Box around{glm::max(at - reach, room.lower), glm::min(at + reach, room.upper)};
    mesh.triangle(random.point(around), random.point(around), random.point(around));
  }
  return mesh;
}

}  // namespace veduta::test
