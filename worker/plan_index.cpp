#include "worker/plan_index.h"

#include <algorithm>
#include <cmath>

namespace veduta {

PlanIndex::PlanIndex(std::vector<Box> boxes, double cell_m) : boxes_(std::move(boxes)), cell_m_(cell_m) {
  for (const Box& box : boxes_) all_.extend(box);
  if (boxes_.empty()) all_ = {glm::vec3(0), glm::vec3(0)};
  nx_ = cell_x(all_.upper.x) + 1, ny_ = cell_y(all_.upper.y) + 1;
  std::vector<uint32_t> count(static_cast<size_t>(nx_) * ny_ + 1, 0);
  const auto each_cell = [&](const Box& box, const auto& visit) {
    for (int j = cell_y(box.lower.y); j <= cell_y(box.upper.y); ++j)
      for (int i = cell_x(box.lower.x); i <= cell_x(box.upper.x); ++i)
        visit(static_cast<size_t>(j) * nx_ + i);
  };
  for (const Box& box : boxes_) each_cell(box, [&](size_t cell) { ++count[cell + 1]; });
  for (size_t c = 1; c < count.size(); ++c) count[c] += count[c - 1];
  begin_ = count, items_.resize(count.back());
  for (uint32_t p = 0; p < boxes_.size(); ++p)
    each_cell(boxes_[p], [&](size_t cell) { items_[count[cell]++] = p; });
}

int PlanIndex::cell_x(float x) const {
  return static_cast<int>(std::max(0.0, std::floor((static_cast<double>(x) - all_.lower.x) / cell_m_)));
}
int PlanIndex::cell_y(float y) const {
  return static_cast<int>(std::max(0.0, std::floor((static_cast<double>(y) - all_.lower.y) / cell_m_)));
}

void PlanIndex::find(const Box& box, std::vector<uint32_t>& found) const {
  found.clear();
  if (boxes_.empty() || box.lower.x > all_.upper.x || box.lower.y > all_.upper.y ||
      box.upper.x < all_.lower.x || box.upper.y < all_.lower.y)
    return;
  const int i1 = std::min(cell_x(box.upper.x), nx_ - 1), j1 = std::min(cell_y(box.upper.y), ny_ - 1);
  for (int j = cell_y(box.lower.y); j <= j1; ++j) {
    for (int i = cell_x(box.lower.x); i <= i1; ++i) {
      const size_t cell = static_cast<size_t>(j) * nx_ + i;
      for (uint32_t n = begin_[cell]; n < begin_[cell + 1]; ++n) {
        const Box& b = boxes_[items_[n]];
        if (b.lower.x <= box.upper.x && b.upper.x >= box.lower.x && b.lower.y <= box.upper.y &&
            b.upper.y >= box.lower.y && b.lower.z <= box.upper.z && b.upper.z >= box.lower.z)
          found.push_back(items_[n]);
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

}  // namespace veduta
