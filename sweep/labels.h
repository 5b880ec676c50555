// Names beside the points of a chart, so that none covers another.
#pragma once

#include <string>
#include <vector>

namespace veduta {

/// In pixels, y downwards.
struct Rectangle {
  double x = 0, y = 0, width = 0, height = 0;  ///< x, y: the upper left corner

  bool meets(const Rectangle& other) const {
    return x < other.x + other.width && other.x < x + width && y < other.y + other.height &&
           other.y < y + height;
  }
  bool holds(const Rectangle& other) const {
    return other.x >= x && other.y >= y && other.x + other.width <= x + width &&
           other.y + other.height <= y + height;
  }
};

struct Segment {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool meets(const Segment& other) const;
  bool meets(const Rectangle& box) const;
};

/// A point of a chart and the size of its name; width 0: it has none.
struct LabelWish {
  double x = 0, y = 0, width = 0, height = 0;
  bool first = false;  ///< is placed before the others
};

struct PlacedLabel {
  bool shown = false;  ///< else there was no room
  Rectangle box;
  bool led = false;  ///< is far enough from its point for a line between them
  Segment leader;    ///< from the point to the box
};

/// Boxes within `room` that meet no other box, no point and no other leader, near to their points, and where
/// possible off the `lines`. Deterministic.
std::vector<PlacedLabel> place_labels(const std::vector<LabelWish>& wishes, const Rectangle& room,
                                      const std::vector<Segment>& lines);

/// What a text takes in the fonts of the page, rather more than less.
double text_width(const std::string& text, double font_px);

}  // namespace veduta
