#include "scene/city/cut_face.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace veduta::city {
namespace {

using Sides = std::array<std::vector<uint32_t>, 4>;

// Of a strip's length: two points across from one another, as far as a quad between them is concerned.
constexpr double level = 1e-6;

}  // namespace

void FaceCutter::cut(const Mesh& mesh, const Face& face, const Sides& sides, std::vector<Face>& faces) {
  mesh_ = &mesh;
  faces_ = &faces;
  layer_ = face.layer;
  if (face.is_quad()) {
    cut_quad(face, sides);
  } else {
    cut_triangle(face, sides);
  }
}

// Two sides are the rails of a strip, from the corner that they share or from the side between them.
void FaceCutter::cut_triangle(const Face& face, const Sides& sides) {
  size_t across = 0;  // the side with the fewest points
  for (size_t i = 1; i < 3; ++i)
    if (sides[i].size() < sides[across].size()) across = i;
  const size_t to_tip = (across + 1) % 3, from_tip = (across + 2) % 3;
  const uint32_t tip = face.corner[from_tip], right_foot = face.corner[across],
                 left_foot = face.corner[to_tip];
  // Downwards from the tip, whose first triangle has it alone.
  right_.assign(1, tip);
  right_.insert(right_.end(), sides[from_tip].begin(), sides[from_tip].end());
  right_.push_back(right_foot);
  left_.assign(1, tip);
  left_.insert(left_.end(), sides[to_tip].rbegin(), sides[to_tip].rend());
  left_.push_back(left_foot);
  add(tip, right_[1], left_[1], left_[1]);
  if (sides[across].empty()) return strip(1, left_.size() - 1, 1, right_.size() - 1);
  // All sides have points then, so that the point before the foot is not the tip.
  strip(1, left_.size() - 2, 1, right_.size() - 1);
  fan(left_[left_.size() - 2], right_foot, sides[across], left_foot);
}

// Two opposite sides are the rails of a strip; of the other two each is the edge of a fan, unless it is
// plain.
void FaceCutter::cut_quad(const Face& face, const Sides& sides) {
  const size_t first = sides[0].size() + sides[2].size() >= sides[1].size() + sides[3].size() ? 0 : 1;
  const auto corner = [&](size_t i) { return face.corner[(first + i) % 4]; };
  const auto side = [&](size_t i) -> const std::vector<uint32_t>& { return sides[(first + i) % 4]; };
  right_.assign(1, corner(0));
  right_.insert(right_.end(), side(0).begin(), side(0).end());
  right_.push_back(corner(1));
  left_.assign(1, corner(3));
  left_.insert(left_.end(), side(2).rbegin(), side(2).rend());
  left_.push_back(corner(2));
  const size_t right_begin = side(3).empty() ? 0 : 1;
  const size_t left_end = left_.size() - (side(1).empty() ? 1 : 2);
  if (right_begin == 1) fan(right_[1], corner(3), side(3), corner(0));
  strip(0, left_end, right_begin, right_.size() - 1);
  if (left_end + 2 == left_.size()) fan(left_[left_end], corner(1), side(1), corner(2));
}

// Between two rails that run the same way, from one pair of points to another.
void FaceCutter::strip(size_t left, size_t left_end, size_t right, size_t right_end) {
  const auto& at = mesh_->vertices;
  const glm::dvec3 along = at[right_.back()] - at[right_.front()] + at[left_.back()] - at[left_.front()];
  const double nearly = level * glm::dot(along, along);
  while (left < left_end || right < right_end) {
    const bool left_goes = left < left_end, right_goes = right < right_end;
    const double ahead = left_goes && right_goes
                             ? glm::dot(at[left_[left + 1]] - at[right_[right + 1]], along)
                         : left_goes ? -1
                                     : 1;
    if (left_goes && right_goes && std::abs(ahead) <= nearly) {
      add(right_[right], right_[right + 1], left_[left + 1], left_[left]);
      ++left;
      ++right;
    } else if (ahead > 0) {
      add(right_[right], right_[right + 1], left_[left], left_[left]);
      ++right;
    } else {
      add(right_[right], left_[left + 1], left_[left], left_[left]);
      ++left;
    }
  }
}

void FaceCutter::fan(uint32_t apex, uint32_t from, const std::vector<uint32_t>& points, uint32_t to) {
  for (const uint32_t point : points) {
    add(apex, from, point, point);
    from = point;
  }
  add(apex, from, to, to);
}

void FaceCutter::add(uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  faces_->push_back({{a, b, c, d}, layer_});
}

}  // namespace veduta::city
