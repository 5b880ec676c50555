#include "worker/welded_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <set>

#include "worker/covered_faces.h"

namespace veduta {
namespace {

constexpr double weld_m = 1e-3;
constexpr double ground_m = 1e-2;  // vertices this near to a building's lowest touch the ground

class UnionFind {
 public:
  explicit UnionFind(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  uint32_t find(uint32_t n) {
    while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
    return n;
  }
  void unite(uint32_t a, uint32_t b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);  // the first stands for all
  }

 private:
  std::vector<uint32_t> parent_;
};

bool is_sheet(Kind kind) {
  return kind == Kind::terrain || kind == Kind::road || kind == Kind::water;
}

/// Triangles of buildings by welded vertices, in the order that they came.
struct Soup {
  std::vector<glm::dvec3> vertices;
  std::vector<glm::uvec3> faces;
  std::vector<uint32_t> source;
};

Soup weld(const std::vector<PlacedTriangle>& triangles) {
  Soup soup;
  std::map<std::array<int64_t, 3>, uint32_t> numbers;
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    if (is_sheet(triangles[t].kind)) continue;
    glm::uvec3 face;
    for (int n = 0; n < 3; ++n) {
      const glm::dvec3 p = triangles[t].corner[n];
      const auto [at, is_new] = numbers.try_emplace(
          {std::llround(p.x / weld_m), std::llround(p.y / weld_m), std::llround(p.z / weld_m)},
          static_cast<uint32_t>(soup.vertices.size()));
      if (is_new) soup.vertices.push_back(p);
      face[n] = at->second;
    }
    const glm::dvec3 &a = soup.vertices[face.x], &b = soup.vertices[face.y], &c = soup.vertices[face.z];
    if (!(glm::length(glm::cross(b - a, c - a)) > weld_m * weld_m)) continue;
    soup.faces.push_back(face), soup.source.push_back(t);
  }
  return soup;
}

void keep_only(Soup& soup, const std::vector<uint8_t>& keep) {
  size_t kept = 0;
  for (size_t f = 0; f < keep.size(); ++f) {
    if (keep[f] == 0) continue;
    soup.faces[kept] = soup.faces[f], soup.source[kept] = soup.source[f];
    ++kept;
  }
  soup.faces.resize(kept), soup.source.resize(kept);
}

/// Leaves one of triangles with the same corners that face the same way.
void drop_doubles(Soup& soup) {
  std::set<std::array<uint32_t, 3>> seen;
  std::vector<uint8_t> keep;
  for (const glm::uvec3& face : soup.faces) {
    std::array<uint32_t, 3> key{face.x, face.y, face.z};
    std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
    keep.push_back(seen.insert(key).second);
  }
  keep_only(soup, keep);
}

void drop_party_walls(Soup& soup) {
  std::vector<uint8_t> keep = covered_faces(soup.vertices, soup.faces);
  for (uint8_t& k : keep) k = k == 0;
  keep_only(soup, keep);
}

/// Turns closed shells whose faces agree so that they face outwards, and marks them.
void orient(WeldedMesh& mesh) {
  UnionFind shells(mesh.vertices.size());
  std::map<std::pair<uint32_t, uint32_t>, int> edges;  // directed
  for (const glm::uvec3& f : mesh.faces) {
    for (int n = 0; n < 3; ++n) {
      shells.unite(f[n], f[(n + 1) % 3]);
      ++edges[{f[n], f[(n + 1) % 3]}];
    }
  }
  struct Shell {
    bool agrees = true;
    double volume = 0;
  };
  std::map<uint32_t, Shell> found;
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (count != 1 || back == edges.end() || back->second != 1) found[shells.find(edge.first)].agrees = false;
  }
  for (const glm::uvec3& f : mesh.faces) {
    const glm::dvec3 &o = mesh.vertices[0], a = mesh.vertices[f.x] - o, b = mesh.vertices[f.y] - o,
                     c = mesh.vertices[f.z] - o;
    found[shells.find(f.x)].volume += glm::dot(a, glm::cross(b, c)) / 6;
  }
  for (glm::uvec3& f : mesh.faces) {
    const Shell& shell = found[shells.find(f.x)];
    mesh.oriented.push_back(shell.agrees);
    if (shell.agrees && shell.volume < 0) std::swap(f.y, f.z);
  }
}

void mark_ground(WeldedMesh& mesh, const std::vector<PlacedTriangle>& triangles) {
  std::map<uint32_t, double> lowest;  // of a building
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    double& low = lowest.try_emplace(triangles[mesh.source[f]].object, HUGE_VAL).first->second;
    for (int n = 0; n < 3; ++n) low = std::min(low, mesh.vertices[mesh.faces[f][n]].z);
  }
  mesh.on_ground.assign(mesh.vertices.size(), 0);
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    for (int n = 0; n < 3; ++n) {
      const uint32_t v = mesh.faces[f][n];
      if (mesh.vertices[v].z <= lowest[triangles[mesh.source[f]].object] + ground_m) mesh.on_ground[v] = 1;
    }
  }
}

}  // namespace

std::vector<WeldedMesh> weld_buildings(const std::vector<PlacedTriangle>& triangles) {
  Soup soup = weld(triangles);
  UnionFind groups(soup.vertices.size());
  std::map<uint32_t, uint32_t> vertex_of_object;
  for (size_t f = 0; f < soup.faces.size(); ++f) {
    const glm::uvec3& face = soup.faces[f];
    groups.unite(face.x, face.y), groups.unite(face.y, face.z);
    groups.unite(face.x,
                 vertex_of_object.try_emplace(triangles[soup.source[f]].object, face.x).first->second);
  }
  drop_doubles(soup);
  drop_party_walls(soup);  // after they have joined what they part

  std::vector<WeldedMesh> meshes;
  std::map<uint32_t, uint32_t> mesh_of_group;
  constexpr uint32_t none = UINT32_MAX;
  std::vector<uint32_t> local(soup.vertices.size(), none);
  for (size_t f = 0; f < soup.faces.size(); ++f) {
    const auto [at, is_new] =
        mesh_of_group.try_emplace(groups.find(soup.faces[f].x), static_cast<uint32_t>(meshes.size()));
    if (is_new) meshes.emplace_back();
    WeldedMesh& mesh = meshes[at->second];
    glm::uvec3 face;
    for (int n = 0; n < 3; ++n) {
      uint32_t& number = local[soup.faces[f][n]];
      if (number == none) {
        number = static_cast<uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(soup.vertices[soup.faces[f][n]]);
      }
      face[n] = number;
    }
    mesh.faces.push_back(face), mesh.source.push_back(soup.source[f]);
  }
  for (WeldedMesh& mesh : meshes) {
    orient(mesh);
    mark_ground(mesh, triangles);
  }
  return meshes;
}

}  // namespace veduta
