#include "sweep/labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string_view>

namespace veduta {
namespace {

constexpr double mark_px = 7.5;    // half the edge of what a point's mark covers
constexpr double led_from_px = 9;  // beyond its mark
constexpr double cluster_px = 30;  // points as near as that may have leaders over each other
constexpr std::array<double, 14> distances{3, 8, 14, 22, 32, 44, 58, 76, 98, 124, 156, 194, 240, 300};
constexpr int directions = 36;
constexpr double rim_px = 3;  // between a box and a line
constexpr int rounds = 8;

double cross(double ax, double ay, double bx, double by) {
  return ax * by - ay * bx;
}

double clamped(double value, double low, double extent) {
  return std::clamp(value, low, low + extent);
}

/// The box at a distance from the mark, in a direction.
Rectangle box_at(const LabelWish& wish, double angle, double distance) {
  const double dx = std::cos(angle), dy = std::sin(angle);
  const double x = wish.x + dx * (mark_px + distance + wish.width / 2);
  const double y = wish.y + dy * (mark_px + distance + wish.height / 2);
  return {x - wish.width / 2, y - wish.height / 2, wish.width, wish.height};
}

PlacedLabel candidate(const LabelWish& wish, const Rectangle& box) {
  PlacedLabel label{true, box, false, {}};
  const double x = clamped(wish.x, box.x, box.width), y = clamped(wish.y, box.y, box.height);
  const double gap = std::hypot(x - wish.x, y - wish.y) - mark_px;
  label.led = gap > led_from_px;
  if (label.led) label.leader = {wish.x, wish.y, x, y};
  return label;
}

struct Placing {
  const std::vector<LabelWish>& wishes;
  const Rectangle& room;
  const std::vector<Segment>& lines;
  std::vector<PlacedLabel> labels;

  Rectangle mark(size_t i) const {
    return {wishes[i].x - mark_px, wishes[i].y - mark_px, 2 * mark_px, 2 * mark_px};
  }

  bool near(size_t i, size_t k) const {
    return std::hypot(wishes[i].x - wishes[k].x, wishes[i].y - wishes[k].y) < cluster_px;
  }

  /// Would two labels be in each other's way?
  bool clash(size_t i, const PlacedLabel& a, size_t k, const PlacedLabel& b) const {
    return a.box.meets(b.box) || (a.led && a.leader.meets(b.box)) || (b.led && b.leader.meets(a.box)) ||
           (a.led && b.led && !near(i, k) && a.leader.meets(b.leader));
  }

  bool clear_of_points(size_t i, const PlacedLabel& label) const {
    if (!room.holds(label.box)) return false;
    for (size_t k = 0; k < wishes.size(); ++k)
      if (label.box.meets(mark(k)) || (k != i && label.led && !near(i, k) && label.leader.meets(mark(k))))
        return false;
    return true;
  }

  /// The labels in the way of one.
  std::vector<size_t> in_the_way(size_t i, const PlacedLabel& label) const {
    std::vector<size_t> out;
    for (size_t k = 0; k < wishes.size(); ++k)
      if (k != i && labels[k].shown && clash(i, label, k, labels[k])) out.push_back(k);
    return out;
  }

  double cost(size_t i, const PlacedLabel& label) const {
    const double x = clamped(wishes[i].x, label.box.x, label.box.width);
    const double y = clamped(wishes[i].y, label.box.y, label.box.height);
    double cost = std::hypot(x - wishes[i].x, y - wishes[i].y);
    const Rectangle with_rim{label.box.x - rim_px, label.box.y - rim_px, label.box.width + 2 * rim_px,
                             label.box.height + 2 * rim_px};
    for (const Segment& line : lines) {
      if (line.meets(with_rim)) cost += 40;
      if (label.led && line.meets(label.leader)) cost += 6;
    }
    for (size_t k = 0; k < wishes.size() && label.led; ++k) {
      if (k == i) continue;
      if (label.leader.meets(mark(k))) cost += 12;
      if (labels[k].led && label.leader.meets(labels[k].leader)) cost += 30;
    }
    if (label.box.x < wishes[i].x) cost += 2;  // to the right of its point, where there is a choice
    return cost;
  }

  /// Every place that is clear of the points.
  std::vector<PlacedLabel> candidates(size_t i) const {
    std::vector<PlacedLabel> out;
    if (wishes[i].width == 0) return out;
    for (const double distance : distances)
      for (int n = 0; n < directions; ++n) {
        const double angle = 2 * std::numbers::pi * n / directions;
        const PlacedLabel label = candidate(wishes[i], box_at(wishes[i], angle, distance));
        if (clear_of_points(i, label)) out.push_back(label);
      }
    return out;
  }

  void place(size_t i) {
    labels[i] = {};
    PlacedLabel best;
    double least = 1e30;
    for (const PlacedLabel& label : candidates(i)) {
      const double price = cost(i, label);
      if (price < least && in_the_way(i, label).empty()) best = label, least = price;
    }
    labels[i] = best;
  }

  /// For one without a place: takes that of a neighbour who finds another.
  void make_room(size_t i) {
    for (const PlacedLabel& label : candidates(i)) {
      const std::vector<size_t> others = in_the_way(i, label);
      if (others.size() != 1) continue;
      const PlacedLabel before = labels[others[0]];
      labels[i] = label;
      place(others[0]);
      if (labels[others[0]].shown) return;
      labels[i] = {}, labels[others[0]] = before;
    }
  }
};

}  // namespace

bool Segment::meets(const Segment& o) const {
  const auto side = [](const Segment& s, double x, double y) {
    return cross(s.x1 - s.x0, s.y1 - s.y0, x - s.x0, y - s.y0);
  };
  return side(*this, o.x0, o.y0) * side(*this, o.x1, o.y1) <= 0 && side(o, x0, y0) * side(o, x1, y1) <= 0 &&
         std::max(x0, x1) >= std::min(o.x0, o.x1) && std::max(o.x0, o.x1) >= std::min(x0, x1) &&
         std::max(y0, y1) >= std::min(o.y0, o.y1) && std::max(o.y0, o.y1) >= std::min(y0, y1);
}

bool Segment::meets(const Rectangle& b) const {
  const double right = b.x + b.width, lower = b.y + b.height;
  if (x0 >= b.x && x0 <= right && y0 >= b.y && y0 <= lower) return true;
  return meets(Segment{b.x, b.y, right, lower}) || meets(Segment{b.x, lower, right, b.y});
}

std::vector<PlacedLabel> place_labels(const std::vector<LabelWish>& wishes, const Rectangle& room,
                                      const std::vector<Segment>& lines) {
  Placing placing{wishes, room, lines, std::vector<PlacedLabel>(wishes.size())};
  // The most crowded choose first, since the others have more choice.
  std::vector<double> crowd(wishes.size());
  for (size_t i = 0; i < wishes.size(); ++i)
    for (const LabelWish& other : wishes)
      crowd[i] += 1 / (20 + std::hypot(wishes[i].x - other.x, wishes[i].y - other.y));
  std::vector<size_t> order(wishes.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return std::pair(wishes[a].first, crowd[a]) > std::pair(wishes[b].first, crowd[b]);
  });
  for (int round = 0; round < rounds; ++round)
    for (const size_t i : order) {
      placing.place(i);
      if (!placing.labels[i].shown) placing.make_room(i);
    }
  return placing.labels;
}

double text_width(const std::string& text, double font_px) {
  constexpr std::string_view narrow = "ijltfrI.,:;'|!()[] ", wide = "mwMW@%";
  double em = 0;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xC0) == 0x80) continue;  // the rest of a character
    if (static_cast<unsigned char>(c) >= 0x80)
      em += 1;
    else if (narrow.find(c) != std::string_view::npos)
      em += 0.36;
    else if (wide.find(c) != std::string_view::npos)
      em += 0.95;
    else
      em += c >= 'A' && c <= 'Z' ? 0.7 : 0.61;
  }
  return em * font_px;
}

}  // namespace veduta
