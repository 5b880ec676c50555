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

/// The lowest terrain near a place: what does not stand out above it hides nothing but the ground itself. A
/// hill does stand out above its foot.
class LowestGround {
 public:
  LowestGround(const SealedBlock& block, double otherwise_m)
      : frame_(block.region.frame()), otherwise_m_(otherwise_m) {
    nx_ = static_cast<int>(frame_.nx * frame_.size_m / cell_m) + 1;
    ny_ = static_cast<int>(frame_.ny * frame_.size_m / cell_m) + 1;
    lowest_.assign(static_cast<size_t>(nx_) * ny_, unknown);
    for (const PlacedTriangle& t : block.triangles) {
      if (t.kind != Kind::terrain) continue;
      Box box;
      for (const glm::vec3& corner : t.corner) box.extend(corner);
      for (int j = cell(box.lower.y, frame_.y(0), ny_); j <= cell(box.upper.y, frame_.y(0), ny_); ++j)
        for (int i = cell(box.lower.x, frame_.x(0), nx_); i <= cell(box.upper.x, frame_.x(0), nx_); ++i) {
          float& lowest = lowest_[static_cast<size_t>(j) * nx_ + i];
          lowest = std::min(lowest, box.lower.z);
        }
    }
  }

  double at(const glm::dvec3& p) const {
    float lowest = unknown;
    const int ci = cell(p.x, frame_.x(0), nx_), cj = cell(p.y, frame_.y(0), ny_);
    for (int j = std::max(cj - 2, 0); j <= std::min(cj + 2, ny_ - 1); ++j)
      for (int i = std::max(ci - 2, 0); i <= std::min(ci + 2, nx_ - 1); ++i)
        lowest = std::min(lowest, lowest_[static_cast<size_t>(j) * nx_ + i]);
    return lowest == unknown ? otherwise_m_ : std::max<double>(lowest, otherwise_m_);
  }

 private:
  static constexpr double cell_m = 16;
  static constexpr float unknown = std::numeric_limits<float>::max();
  static int cell(double m, double origin, int count) {
    return static_cast<int>(std::clamp((m - origin) / cell_m, 0.0, count - 1.0));
  }
  const GridFrame& frame_;
  double otherwise_m_;
  int nx_, ny_;
  std::vector<float> lowest_;
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

  /// Sealed beyond doubt: what is close to free space is left out, within the window of which a surface lies
  /// anyway.
  void take_sealed(double lowest_m) {
    const LowestGround ground(block, lowest_m);
    const BitGrid sealed = sealed_voxels(block.region);
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        const double ground_m = ground.at(at(x, y, 0));
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
