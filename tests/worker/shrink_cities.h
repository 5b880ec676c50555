// Small cities that are hard to shrink, each of one thing, and mixtures of them: on a closed ground, 12 m a
// plot.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "tests/worker/mesh.h"

namespace veduta::test {

/// What stands on a plot.
enum class Plot {
  box,
  gable,
  l_shape,
  row_touching,     // party walls in one plane
  row_overlapping,  // by 5 mm
  row_gap,          // of 0.1 m: below a seed
  row_slit,         // of 0.6 m: open
  arcade,
  balconies,
  hole_closed,   // in a wall, below a seed
  hole_between,  // of one to two seeds: may be either
  hole_open,     // of more than two seeds
  inverted,      // some triangles turned round
  dirty,         // triangles twice, without area, and slivers
  open_box,      // no wall on one side
  fin,           // a wall that three surfaces share an edge with
  edge_sharing,  // two boxes with an edge in common
  nested,        // a building inside a building
  slanted,       // walls that lean
  spire,         // a pyramid, thin
  count
};

inline const char* plot_name(Plot plot) {
  constexpr const char* names[] = {
      "box",      "gable",     "l_shape",      "row_touching", "row_overlapping", "row_gap",  "row_slit",
      "arcade",   "balconies", "hole_closed",  "hole_between", "hole_open",       "inverted", "dirty",
      "open_box", "fin",       "edge_sharing", "nested",       "slanted",         "spire"};
  static_assert(std::size(names) == static_cast<size_t>(Plot::count));
  return names[static_cast<int>(plot)];
}

/// Builds plots; what a plot needs is made around the origin on z = 0, then turned and moved.
class ShrinkCity {
 public:
  explicit ShrinkCity(uint32_t seed) : random_(seed) {}

  /// \param angle about the plot's middle, radians.
  void plot(Plot plot, const glm::vec3& middle, double angle) {
    const size_t first = mesh.scene.vertices.size();
    build(plot);
    const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
    for (size_t v = first; v < mesh.scene.vertices.size(); ++v) {
      glm::vec3& p = mesh.scene.vertices[v];
      p = middle + glm::vec3(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
    }
  }

  /// An earth of n x n squares that rises by `slope` along x and has bumps, closed down to `bottom`: a whole
  /// voxel, or the fill finds a way underneath.
  void earth(float x0, float x1, float bottom, float slope, float bumps, int n = 4) {
    mesh.object(Kind::terrain);
    const float step = (x1 - x0) / static_cast<float>(n);
    std::vector<glm::vec3> top;
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        const float x = x0 + static_cast<float>(i) * step, y = x0 + static_cast<float>(j) * step;
        top.push_back({x, y, slope * x + static_cast<float>(random_.real(0, 1)) * bumps});
      }
    }
    const auto at = [&](int i, int j) { return top[static_cast<size_t>(j * (n + 1) + i)]; };
    const auto skirt = [&](glm::vec3 a, glm::vec3 b) {
      mesh.quad({b.x, b.y, bottom}, {a.x, a.y, bottom}, a, b);
    };
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) mesh.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      skirt(at(j + 1, 0), at(j, 0)), skirt(at(j, n), at(j + 1, n));
      skirt(at(0, j), at(0, j + 1)), skirt(at(n, j + 1), at(n, j));
    }
  }

  Mesh mesh;

 private:
  float real(double lower, double upper) { return static_cast<float>(random_.real(lower, upper)); }

  void build(Plot plot) {
    mesh.object();
    const float w = real(3.5, 5), d = real(3.5, 5), h = real(6, 10);  // half width and depth
    const Box whole{{-w, -d, 0}, {w, d, h}};
    switch (plot) {
      case Plot::box:
        mesh.box(whole);
        break;
      case Plot::gable:
        gable(w, d, h);
        break;
      case Plot::l_shape:
        l_shape(w, d, h);
        break;
      case Plot::row_touching:
        row(0, d, h);
        break;
      case Plot::row_overlapping:
        row(-0.005f, d, h);
        break;
      case Plot::row_gap:
        row(0.1f, d, h);
        break;
      case Plot::row_slit:
        row(0.6f, d, h);
        break;
      case Plot::arcade:
        arcade(w, d, h);
        break;
      case Plot::balconies:
        balconies(w, d, h);
        break;
      case Plot::hole_closed:
        with_hole(w, d, h, 0.2f);
        break;
      case Plot::hole_between:
        with_hole(w, d, h, real(0.27, 0.48));
        break;
      case Plot::hole_open:
        with_hole(w, d, h, 0.6f);
        break;
      case Plot::inverted:
        mesh.box(whole), invert(0.4);
        break;
      case Plot::dirty:
        gable(w, d, h), dirt();
        break;
      case Plot::open_box:
        open_box(w, d, h);
        break;
      case Plot::fin:
        mesh.box(whole), mesh.quad({w, -d, 0}, {w + 2, -d - 1, 0}, {w + 2, -d - 1, h}, {w, -d, h});
        break;
      case Plot::edge_sharing:
        mesh.box({{-5, -5, 0}, {0, 0, h}}), mesh.box({{0, 0, 0}, {5, 5, h - 1}});
        break;
      case Plot::nested:
        mesh.box(whole), mesh.object(), mesh.box({{-2, -2, 0}, {2, 2, 4}});
        mesh.object(), mesh.box({{-1, -1, 1}, {1, 1, 3}});
        break;
      case Plot::slanted:
        frustum(w, d, 0.6f, h);
        break;
      case Plot::spire:
        frustum(w, d, 0, 14);
        break;
      case Plot::count:
        break;
    }
  }

  void gable(float w, float d, float h) {
    const float r = h + real(2, 4);
    mesh.box({{-w, -d, 0}, {w, d, h}}, false);
    mesh.quad({-w, -d, h}, {w, -d, h}, {w, 0, r}, {-w, 0, r});
    mesh.quad({w, d, h}, {-w, d, h}, {-w, 0, r}, {w, 0, r});
    mesh.triangle({w, -d, h}, {w, d, h}, {w, 0, r});
    mesh.triangle({-w, d, h}, {-w, -d, h}, {-w, 0, r});
  }

  void l_shape(float w, float d, float h) {  // its corner that points inwards is the origin
    const std::vector<glm::vec2> outline{{0, 0}, {0, d}, {-w, d}, {-w, -d}, {w, -d}, {w, 0}};
    for (size_t n = 0; n < outline.size(); ++n) {
      const glm::vec2 a = outline[n], b = outline[(n + 1) % outline.size()];
      mesh.quad({a.x, a.y, 0}, {b.x, b.y, 0}, {b.x, b.y, h}, {a.x, a.y, h});
      if (n == 0 || n + 1 == outline.size()) continue;
      mesh.triangle({0, 0, h}, {a.x, a.y, h}, {b.x, b.y, h});
      mesh.triangle({0, 0, 0}, {b.x, b.y, 0}, {a.x, a.y, 0});
    }
  }

  void row(float gap, float d, float h) {
    for (int n = 0; n < 4; ++n) {
      if (n > 0) mesh.object();
      const float x = -6 + static_cast<float>(n) * (3 + gap);
      mesh.box({{x, -d, 0}, {x + 3, d, h + 0.5f * static_cast<float>(n % 2)}});
    }
  }

  void arcade(float w, float d, float h) {
    mesh.box({{-w, -d, 3}, {w, d, h + 2}});
    for (const float x : {-w, w - 0.6f}) {
      for (const float y : {-d, d - 0.6f}) mesh.box({{x, y, 0}, {x + 0.6f, y + 0.6f, 3}});
    }
    mesh.box({{-1.5f, -d, 0}, {1.5f, d, 3}});
  }

  void balconies(float w, float d, float h) {
    mesh.box({{-w, -d, 0}, {w, d, h}});
    for (float z = 2.5f; z + 1 < h; z += 2.8f) {
      mesh.box({{-1, -d - 0.9f, z}, {1, -d + 0.05f, z + 0.1f}});
      mesh.quad({-1, -d - 0.9f, z}, {1, -d - 0.9f, z}, {1, -d - 0.9f, z + 1}, {-1, -d - 0.9f, z + 1});
    }
  }

  void with_hole(float w, float d, float h, float edge) {
    const float x = real(-1, 1), z = real(1, 3);
    mesh.quad({w, d, 0}, {-w, d, 0}, {-w, d, h}, {w, d, h});
    mesh.quad({-w, d, 0}, {-w, -d, 0}, {-w, -d, h}, {-w, d, h});
    mesh.quad({w, -d, 0}, {w, d, 0}, {w, d, h}, {w, -d, h});
    mesh.quad({-w, -d, h}, {w, -d, h}, {w, d, h}, {-w, d, h});
    mesh.quad({-w, -d, 0}, {x, -d, 0}, {x, -d, h}, {-w, -d, h});
    mesh.quad({x + edge, -d, 0}, {w, -d, 0}, {w, -d, h}, {x + edge, -d, h});
    mesh.quad({x, -d, 0}, {x + edge, -d, 0}, {x + edge, -d, z}, {x, -d, z});
    mesh.quad({x, -d, z + edge}, {x + edge, -d, z + edge}, {x + edge, -d, h}, {x, -d, h});
  }

  void open_box(float w, float d, float h) {
    mesh.quad({w, d, 0}, {-w, d, 0}, {-w, d, h}, {w, d, h});
    mesh.quad({-w, d, 0}, {-w, -d, 0}, {-w, -d, h}, {-w, d, h});
    mesh.quad({w, -d, 0}, {w, d, 0}, {w, d, h}, {w, -d, h});
    mesh.quad({-w, -d, h}, {w, -d, h}, {w, d, h}, {-w, d, h});
  }

  void frustum(float w, float d, float top, float h) {
    const glm::vec3 low[4] = {{-w, -d, 0}, {w, -d, 0}, {w, d, 0}, {-w, d, 0}};
    const glm::vec3 scale(top, top, 0), up(0, 0, h);
    for (int n = 0; n < 4; ++n) {
      const glm::vec3 a = low[n], b = low[(n + 1) % 4];
      mesh.triangle(a, b, b * scale + up);
      if (top > 0) mesh.triangle(a, b * scale + up, a * scale + up);
    }
    if (top > 0)
      mesh.quad(low[0] * scale + up, low[1] * scale + up, low[2] * scale + up, low[3] * scale + up);
  }

  void invert(double share) {
    const Object& last = mesh.scene.objects.back();
    for (uint64_t t = last.triangle_begin; t < last.triangle_end; ++t) {
      if (random_.chance(share)) std::swap(mesh.scene.triangles[t].y, mesh.scene.triangles[t].z);
    }
  }

  void dirt() {
    const Object last = mesh.scene.objects.back();
    for (uint64_t t = last.triangle_begin; t < last.triangle_end; t += 3) {
      const glm::uvec3 v = mesh.scene.triangles[t];
      const glm::vec3 a = mesh.scene.vertices[v.x], b = mesh.scene.vertices[v.y],
                      c = mesh.scene.vertices[v.z];
      if (t % 2 == 0) mesh.triangle(a, b, c);
      mesh.triangle(a, b, 0.5f * (a + b));
      mesh.triangle(a, b, 0.5f * (a + b) + glm::vec3(1e-4f, 1e-4f, 1e-4f));
    }
  }

  Random random_;
};

/// One plot alone, turned by a random angle or not at all, on level ground.
inline Scene one_plot(Plot plot, uint32_t seed) {
  ShrinkCity city(seed);
  Random random(seed + 1000);
  city.earth(-10, 10, -1, 0, 0, 1);
  city.plot(plot, {0, 0, 0}, seed % 3 == 0 ? 0 : random.real(0, 6.28));
  return city.mesh.scene;
}

/// Three by three plots of any kind, close enough to run into each other, on a slope.
inline Scene random_city(uint32_t seed) {
  ShrinkCity city(seed);
  Random random(seed + 2000);
  const auto slope = static_cast<float>(random.real(0, 0.15));
  city.earth(-22, 22, -5, slope, 0.6f);
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      const auto at_x = static_cast<float>(12 * x + random.real(-1, 1)),
                 at_y = static_cast<float>(12 * y + random.real(-1, 1));
      const auto plot = static_cast<Plot>(random.integer(0, static_cast<int>(Plot::count) - 1));
      city.plot(plot, {at_x, at_y, slope * at_x - 0.5f}, random.chance(0.3) ? 0 : random.real(0, 6.28));
    }
  }
  return city.mesh.scene;
}

}  // namespace veduta::test
