#include "worker/eroded_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "worker/convex_body.h"

namespace veduta {
namespace {

/// Does a convex polygon meet the inside of the box center + [-half, half]? Separating axes: the box's sides,
/// the polygon's plane, and the cross products of their edges (Akenine-Moeller 2001).
class PolygonAxes {
 public:
  PolygonAxes(const Obstacles& obstacles, uint32_t piece, const glm::dvec3& half) {
    const auto add = [&](const glm::dvec3& axis) {
      if (glm::dot(axis, axis) < 1e-18) return;
      double low = glm::dot(axis, *obstacles.begin(piece)), high = low;
      for (const glm::dvec3* c = obstacles.begin(piece); c != obstacles.end(piece); ++c) {
        const double d = glm::dot(axis, *c);
        low = std::min(low, d), high = std::max(high, d);
      }
      const double grown = support(half, axis);
      axes_.push_back({axis, low - grown, high + grown});
    };
    add(obstacles.normal(piece));
    for (int a = 0; a < 3; ++a) {
      glm::dvec3 axis(0);
      axis[a] = 1;
      add(axis);
    }
    const glm::dvec3* last = obstacles.end(piece) - 1;
    for (const glm::dvec3* c = obstacles.begin(piece); c != obstacles.end(piece); last = c++) {
      const glm::dvec3 edge = *c - *last;
      add({0, edge.z, -edge.y}), add({-edge.z, 0, edge.x}), add({edge.y, -edge.x, 0});
    }
  }

  bool meet(const glm::dvec3& center) const {
    for (const Axis& a : axes_) {
      const double d = glm::dot(a.axis, center);
      if (d <= a.low || d >= a.high) return false;
    }
    return true;
  }

 private:
  struct Axis {
    glm::dvec3 axis;
    double low, high;
  };
  std::vector<Axis> axes_;
};

}  // namespace

/// A byte a sample: 0 outside, else 1 until it belongs to a component.
struct ErodedSamples::Lattice {
  const SealedBlock& block;
  const GridFrame& frame;
  int stride_xy, stride_z;  // voxels
  int nx, ny, nz;
  std::vector<uint8_t> in;

  Lattice(const SealedBlock& b, const glm::dvec3& window_m)
      : block(b),
        frame(b.region.frame()),
        stride_xy(stride(0.25 * std::max(window_m.x, window_m.y))),
        stride_z(stride(std::max(0.5 * window_m.z, 0.1 * std::max(window_m.x, window_m.y)))) {
    nx = (b.i1 - b.i0) / stride_xy, ny = (b.j1 - b.j0) / stride_xy, nz = frame.nz / stride_z;
    nx = std::max(nx, 1), ny = std::max(ny, 1), nz = std::max(nz, 1);
    in.assign(static_cast<size_t>(nx) * ny * nz, 0);
  }
  int stride(double metres) const { return std::max(1, static_cast<int>(metres / frame.size_m)); }
  size_t index(int x, int y, int z) const { return (static_cast<size_t>(y) * nx + x) * nz + z; }
  /// Samples lie in the middle of voxels.
  int i(int x) const { return std::min(block.i0 + x * stride_xy + stride_xy / 2, frame.nx - 1); }
  int j(int y) const { return std::min(block.j0 + y * stride_xy + stride_xy / 2, frame.ny - 1); }
  int k(int z) const { return std::min(z * stride_z + stride_z / 2, frame.nz - 1); }
  glm::dvec3 at(int x, int y, int z) const {
    return {frame.x(i(x)) + 0.5 * frame.size_m, frame.y(j(y)) + 0.5 * frame.size_m,
            frame.z(k(z)) + 0.5 * frame.size_m};
  }

  /// The highest terrain under the samples of each column, that of the nearest column where there is none:
  /// the earth itself is left out, since it hides little but itself and joins all houses to one. (A hill does
  /// hide more.)
  std::vector<double> ground_heights(double lowest_m) const {
    std::vector<double> height(static_cast<size_t>(nx) * ny, -std::numeric_limits<double>::infinity());
    const glm::dvec3 origin = at(0, 0, 0);
    const double step = stride_xy * frame.size_m;
    for (const PlacedTriangle& t : block.triangles) {
      if (t.kind != Kind::terrain) continue;
      const glm::dvec3 a = t.corner[0], ab = glm::dvec3(t.corner[1]) - a, ac = glm::dvec3(t.corner[2]) - a;
      const double area = ab.x * ac.y - ab.y * ac.x;
      if (std::abs(area) < 1e-9) continue;  // a side: the ground above it is another triangle's
      Box box;
      for (const glm::vec3& corner : t.corner) box.extend(corner);
      const auto number = [&](double m, double from, int count) {
        return static_cast<int>(std::clamp((m - from) / step, -1.0, static_cast<double>(count)));
      };
      for (int y = std::max(number(box.lower.y, origin.y, ny), 0);
           y <= std::min(number(box.upper.y, origin.y, ny), ny - 1); ++y) {
        for (int x = std::max(number(box.lower.x, origin.x, nx), 0);
             x <= std::min(number(box.upper.x, origin.x, nx), nx - 1); ++x) {
          const glm::dvec3 p = at(x, y, 0) - a;
          const double u = (p.x * ac.y - p.y * ac.x) / area, v = (ab.x * p.y - ab.y * p.x) / area;
          if (u < -1e-6 || v < -1e-6 || u + v > 1 + 1e-6) continue;
          double& highest = height[static_cast<size_t>(y) * nx + x];
          highest = std::max(highest, a.z + u * ab.z + v * ac.z);
        }
      }
    }
    std::vector<int> queue;
    for (int c = 0; c < nx * ny; ++c) {
      if (std::isfinite(height[c])) queue.push_back(c);
    }
    if (queue.empty()) return std::vector<double>(height.size(), lowest_m);
    for (size_t n = 0; n < queue.size(); ++n) {
      const int x = queue[n] % nx, y = queue[n] / nx;
      for (const auto& [a, b] : {std::pair{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}}) {
        if (a < 0 || b < 0 || a >= nx || b >= ny || std::isfinite(height[b * nx + a])) continue;
        height[b * nx + a] = height[queue[n]], queue.push_back(b * nx + a);
      }
    }
    for (double& h : height) h = std::max(h, lowest_m);
    return height;
  }

  /// Sealed beyond doubt: what is close to free space is left out, within the window of which a surface lies
  /// anyway.
  void take_sealed(double lowest_m) {
    const std::vector<double> ground = ground_heights(lowest_m);
    const BitGrid sealed = sealed_voxels(block.region);
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        const double ground_m = ground[static_cast<size_t>(y) * nx + x];
        for (int z = 0; z < nz; ++z) {
          const int a = i(x), b = j(y), c = k(z);
          in[index(x, y, z)] = frame.z(c) >= ground_m && sealed.get(a, b, c);
        }
      }
    }
  }

  /// Windows that a piece of exposed surface passes are not sealed.
  void take_out(const Obstacles& obstacles, const glm::dvec3& window_m) {
    for (uint32_t piece = 0; piece < obstacles.size(); ++piece) {
      const Box& b = obstacles.bounds(piece);
      const auto first = [](double low, double origin, double step, int count) {
        return static_cast<int>(
            std::clamp(std::floor((low - origin) / step), 0.0, static_cast<double>(count)));
      };
      const glm::dvec3 origin = at(0, 0, 0);
      const double sx = stride_xy * frame.size_m, sz = stride_z * frame.size_m;
      const int x0 = first(b.lower.x - window_m.x, origin.x, sx, nx),
                x1 = first(b.upper.x + window_m.x, origin.x, sx, nx - 1);
      const int y0 = first(b.lower.y - window_m.y, origin.y, sx, ny),
                y1 = first(b.upper.y + window_m.y, origin.y, sx, ny - 1);
      const int z0 = first(b.lower.z - window_m.z, origin.z, sz, nz),
                z1 = first(b.upper.z + window_m.z, origin.z, sz, nz - 1);
      std::vector<PolygonAxes> axes;  // made when there is something to test
      for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
          for (int z = z0; z <= z1; ++z) {
            uint8_t& sample = in[index(x, y, z)];
            if (sample == 0) continue;
            if (axes.empty()) axes.emplace_back(obstacles, piece, window_m);
            if (axes.front().meet(at(x, y, z))) sample = 0;
          }
        }
      }
    }
  }

  /// Calls visit(x, y, z) for the six neighbours inside of the lattice.
  template <typename Visit>
  void neighbours(const std::array<int, 3>& p, const Visit& visit) const {
    const std::array<int, 3> size{nx, ny, nz};
    for (int axis = 0; axis < 3; ++axis) {
      for (const int d : {-1, 1}) {
        std::array<int, 3> q = p;
        q[axis] += d;
        if (q[axis] >= 0 && q[axis] < size[axis]) visit(q);
      }
    }
  }
};

ErodedSamples::ErodedSamples(const SealedBlock& block, const Obstacles& obstacles, const glm::dvec3& window_m,
                             double lowest_m) {
  Lattice lattice(block, window_m);
  step_m_ = block.region.frame().size_m * glm::dvec3(lattice.stride_xy, lattice.stride_xy, lattice.stride_z);
  lattice.take_sealed(lowest_m);
  lattice.take_out(obstacles, window_m);

  // Depth: breadth first from the samples beside what is out. The lattice's border does not count: sealed
  // space may go on behind it.
  std::vector<uint32_t> depth(lattice.in.size(), 0);
  std::vector<std::array<int, 3>> queue;
  const auto index = [&](const std::array<int, 3>& p) { return lattice.index(p[0], p[1], p[2]); };
  for (int y = 0; y < lattice.ny; ++y) {
    for (int x = 0; x < lattice.nx; ++x) {
      for (int z = 0; z < lattice.nz; ++z) {
        if (lattice.in[lattice.index(x, y, z)] == 0) continue;
        bool at_edge = false;
        lattice.neighbours({x, y, z}, [&](const auto& q) { at_edge = at_edge || lattice.in[index(q)] == 0; });
        if (at_edge) depth[lattice.index(x, y, z)] = 1, queue.push_back({x, y, z});
      }
    }
  }
  for (size_t n = 0; n < queue.size(); ++n) {
    const std::array<int, 3> p = queue[n];
    lattice.neighbours(p, [&](const auto& q) {
      if (lattice.in[index(q)] != 0 && depth[index(q)] == 0)
        depth[index(q)] = depth[index(p)] + 1, queue.push_back(q);
    });
  }

  for (int y = 0; y < lattice.ny; ++y) {
    for (int x = 0; x < lattice.nx; ++x) {
      for (int z = 0; z < lattice.nz; ++z) {
        if (lattice.in[lattice.index(x, y, z)] == 0) continue;
        std::vector<Sample> component;
        std::vector<std::array<int, 3>> stack{{x, y, z}};
        lattice.in[lattice.index(x, y, z)] = 0;
        while (!stack.empty()) {
          const std::array<int, 3> p = stack.back();
          stack.pop_back();
          component.push_back({lattice.at(p[0], p[1], p[2]), depth[index(p)]});
          lattice.neighbours(p, [&](const auto& q) {
            if (lattice.in[index(q)] != 0) lattice.in[index(q)] = 0, stack.push_back(q);
          });
        }
        std::stable_sort(component.begin(), component.end(),
                         [](const Sample& a, const Sample& b) { return a.depth > b.depth; });
        components_.push_back(std::move(component));
      }
    }
  }
}

}  // namespace veduta
