#include "viewer/tour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace veduta {
namespace {

constexpr size_t directions = 36;
constexpr size_t most_candidates = 1500;  // enough for a choice, and under a second in a large city
constexpr float longest_view_m = 90.0f;   // farther than this, a longer street makes no better picture
constexpr float upwards_deg = 6;          // level, half of the picture would be the ground

struct Candidate {
  uint32_t cell = 0;
  Pose pose;
  float score = 0;
};

float yaw_of(size_t direction) {
  return 360.0f * static_cast<float>(direction) / directions;
}

// How far one can go in each direction, m, without leaving the navigable space.
std::array<float, directions> free_lengths(const OctreeForest& free, const glm::vec3& eye) {
  std::array<float, directions> length{};
  const float step_m = std::max(free.leaf_size_m, longest_view_m / 256);
  for (size_t d = 0; d < directions; ++d) {
    const float yaw = glm::radians(yaw_of(d));
    const glm::vec3 ahead(std::cos(yaw), std::sin(yaw), 0);
    while (length[d] < longest_view_m && free.contains(eye + (length[d] + step_m) * ahead))
      length[d] += step_m;
  }
  return length;
}

// How much of the horizon the visible buildings fill in each direction: sums of their apparent widths,
// radians.
std::array<float, directions> built_horizon(const PvsIndex& index, const PvsRow& row, const glm::vec3& eye) {
  std::array<float, directions> built{};
  for (const PvsEntry& entry : row) {
    if (index.objects[entry.object].kind != Kind::building) continue;
    const Box& bounds = index.bounds[entry.object];
    const glm::vec3 away = bounds.center() - eye;
    const float distance_m = std::max(glm::length(glm::vec2(away)), 5.0f);
    const float turn = glm::degrees(std::atan2(away.y, away.x)) / 360.0f + 1.0f;
    const auto d = static_cast<size_t>(std::lround(turn * directions)) % directions;
    built[d] += std::min(1.0f, glm::length(glm::vec2(bounds.half_extent())) / distance_m);
  }
  return built;
}

// The best direction of a cell: a long view with some space beside it, and buildings on both sides.
Candidate rate(const PvsIndex& index, const PvsRow& row, uint32_t cell) {
  const glm::vec3 eye = index.cells[cell].center();
  const auto length = free_lengths(index.navigation.free, eye);
  const auto built = built_horizon(index, row, eye);
  Candidate best{cell, {eye, 0, upwards_deg}, -1};
  for (size_t d = 0; d < directions; ++d) {
    const auto beside = [&](const std::array<float, directions>& of, size_t by) {
      return of[(d + by) % directions] + of[(d + directions - by) % directions];
    };
    const float open_m = length[d] + 0.5f * beside(length, 1) + 0.25f * beside(length, 3);
    const auto side = [&](size_t turn) {
      float sum = 0;
      for (size_t by = 1; by <= 4; ++by) sum += built[(d + turn * by) % directions];
      return std::min(sum, 3.0f);
    };
    const float city = std::min(built[d], 1.0f) + 2 * std::sqrt(side(1) * side(directions - 1));
    const float score = (open_m + 0.1f) * (city + 0.1f);
    if (score > best.score) best.score = score, best.pose.yaw_deg = yaw_of(d);
  }
  return best;
}

std::vector<Candidate> candidates(const PvsIndex& index, const std::function<PvsRow(uint32_t)>& row) {
  const size_t cells = index.cells.size();
  const size_t stride = std::max<size_t>(1, cells / most_candidates);
  std::vector<Candidate> rated;
  for (size_t cell = 0; cell < cells; cell += stride) {
    const auto number = static_cast<uint32_t>(cell);
    rated.push_back(rate(index, row(number), number));
  }
  std::stable_sort(rated.begin(), rated.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  return rated;
}

}  // namespace

std::vector<Pose> make_tour(const PvsIndex& index, const std::function<PvsRow(uint32_t)>& row,
                            size_t frames) {
  std::vector<Candidate> rated = candidates(index, row), chosen;
  Box extent;
  for (const Candidate& candidate : rated) extent.extend(candidate.pose.position_m);
  // The best first, then the best of those far enough from all before; nearer ones only when those run out.
  float apart_m = rated.empty() ? 0 : glm::length(extent.upper - extent.lower) / 3;
  while (chosen.size() < frames && !rated.empty()) {
    std::erase_if(rated, [&](const Candidate& candidate) {
      const bool near = std::any_of(chosen.begin(), chosen.end(), [&](const Candidate& other) {
        return glm::distance(candidate.pose.position_m, other.pose.position_m) < apart_m;
      });
      if (near || chosen.size() == frames) return false;
      chosen.push_back(candidate);
      return true;
    });
    apart_m = apart_m > 1e-3f ? apart_m / 2 : 0;
  }
  std::sort(chosen.begin(), chosen.end(), [](const auto& a, const auto& b) { return a.cell < b.cell; });
  std::vector<Pose> tour;
  for (const Candidate& candidate : chosen) tour.push_back(candidate.pose);
  return tour;
}

}  // namespace veduta
