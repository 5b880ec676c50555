#include "tests/campaign/plots.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

namespace veduta::campaign {
namespace {

/// Pieces in the axes of a site: x across the line of sight, y away from the viewer.
class Builder {
 public:
  Builder(const Site& site, Dice& dice) : site_(site), dice_(dice) {
    turn_ = std::atan2(site.at.y, site.at.x) - 0.5 * std::numbers::pi;
    if (dice.chance(0.3)) turn_ += dice.real(-0.5, 0.5);
    if (dice.chance(0.3)) turn_ = 0;
  }

  void begin(const std::string& name) { things.push_back({name, {}}); }
  Piece& add(Shape shape, const glm::dvec3& foot, const glm::dvec3& size) {
    Piece piece;
    piece.shape = shape, piece.size = size, piece.turn = turn_;
    const double c = std::cos(turn_), s = std::sin(turn_);
    piece.foot = {site_.at.x + c * foot.x - s * foot.y, site_.at.y + s * foot.x + c * foot.y,
                  site_.ground_m + foot.z};
    return things.back().pieces.emplace_back(piece);
  }
  Piece& box(const glm::dvec3& foot, const glm::dvec3& size) { return add(Shape::box, foot, size); }
  /// What an occluder is mostly: a few metres to some tens of them.
  glm::dvec3 house() { return {dice_.real(4, 20), dice_.real(2, 14), dice_.real(3, 16)}; }
  /// Of the sizes at which gaps open and close: of seeds, and of half a pixel over there.
  double slit() {
    const double seed = site_.settings.navigation.seed_size_m;
    const double pixel = 2 * glm::length(site_.at) / site_.settings.occlusion.resolution;
    return dice_.chance(0.2) ? 0.5 * pixel
                             : seed * dice_.pick({0.1, 0.5, 0.99, 1.0, 1.5, 1.99, 2.0, 2.01, 2.5, 3.0, 4.0});
  }
  double little() { return site_.settings.navigation.seed_size_m * dice_.scale(0.02, 4); }
  Dice& dice() { return dice_; }

  std::vector<Thing> things;

 private:
  const Site& site_;
  Dice& dice_;
  double turn_ = 0;
};

void block(Builder& b) {
  b.begin("block");
  const auto shape = b.dice().pick({Shape::box, Shape::box, Shape::prism, Shape::gable, Shape::ell});
  Piece& piece = b.add(shape, {0, 0, 0}, b.house());
  piece.sides = b.dice().whole(3, 9);
  if (b.dice().chance(0.3)) piece.turn = b.dice().angle();
  if (b.dice().chance(0.1)) piece.lean = b.dice().real(-0.3, 0.3);
}

glm::dvec3 wall_size(Dice& dice) {
  return {dice.real(8, 40), dice.scale(0.2, 10), dice.real(2.5, 14)};
}

void wall(Builder& b) {
  b.begin("wall");
  b.box({0, 0, 0}, wall_size(b.dice()));
}

void slit_wall(Builder& b) {
  const glm::dvec3 size = wall_size(b.dice());
  const double slit = b.slit(), split = b.dice().real(0.3, 0.7) * size.x;
  const bool one = b.dice().chance(0.5);
  b.begin("slit_left");
  b.box({0.5 * (split - size.x), 0, 0}, {split, size.y, size.z});
  if (!one) b.begin("slit_right");
  const double right = size.x - split - slit;
  b.box({0.5 * (size.x - right), 0, 0}, {right, size.y, size.z * (b.dice().chance(0.3) ? 0.8 : 1)});
}

void fence(Builder& b) {
  const double thick = b.little(), step = thick + b.slit() * b.dice().pick({1.0, 2.0, 5.0});
  const double height = b.dice().real(1, 5);
  b.begin("fence");
  const int count = b.dice().whole(4, 14);
  for (int n = 0; n < count; ++n) b.box({step * (n - 0.5 * count), 0, 0}, {thick, thick, height});
  if (b.dice().chance(0.4)) b.box({-0.5 * step, 0, 0.7 * height}, {step * count, 0.5 * thick, 0.1});
}

void tower(Builder& b) {
  b.begin("tower");
  glm::dvec3 size = b.house();
  double z = 0;
  const int storeys = b.dice().whole(1, 4);
  for (int n = 0; n < storeys; ++n) {
    b.box({0, 0, z}, size).turn += b.dice().chance(0.2) ? b.dice().angle() : 0;
    z += size.z;
    size *= b.dice().real(0.4, 1.0);
  }
  if (b.dice().chance(0.5)) b.add(Shape::spike, {0, 0, z}, size);
}

void row_houses(Builder& b) {
  const int count = b.dice().whole(2, 6);
  const bool several = b.dice().chance(0.6), gabled = b.dice().chance(0.4);
  double x = -3.0 * count;
  b.begin("row");
  const double deep = b.dice().real(3, 10);
  for (int n = 0; n < count; ++n) {
    if (several && n > 0) b.begin("row");
    const double wide = b.dice().real(3, 8), high = b.dice().real(3, 9);
    Piece& house =
        b.box({x + 0.5 * wide, b.dice().chance(0.3) ? b.dice().real(-1, 1) : 0, 0}, {wide, deep, high});
    if (gabled) house.shape = Shape::gable;
    x += wide;
    if (b.dice().chance(0.2)) x += b.slit();
    if (b.dice().chance(0.1)) x -= b.little();  // into each other
  }
}

void courtyard(Builder& b) {
  const double half = b.dice().real(5, 12), deep = b.dice().real(1, 6), high = b.dice().real(3, 10);
  const double archway = b.dice().chance(0.4) ? b.slit() + b.dice().pick({0.0, 1.0}) : 0;
  b.begin("court");
  b.box({0, half, 0}, {2 * half + deep, deep, high});
  b.box({-half, 0, 0}, {deep, 2 * half, high});
  b.box({half, 0, 0}, {deep, 2 * half, high});
  const double left = half - 0.5 * archway;
  b.box({-0.5 * (half + 0.5 * archway), -half, 0}, {left, deep, high});
  b.box({0.5 * (half + 0.5 * archway), -half, 0}, {left, deep, high});
  if (archway > 0) b.box({0, -half, 0.6 * high}, {archway, deep, 0.4 * high});
}

void arcade(Builder& b) {
  const double wide = b.dice().real(8, 24), deep = b.dice().real(0.5, 6), high = b.dice().real(4, 10);
  const double arch = b.dice().chance(0.5) ? b.dice().real(1, 3) : b.slit();
  const int bays = b.dice().whole(1, 4);
  const double pillar = std::max((wide - bays * arch) / (bays + 1), 0.1), low = b.dice().real(1.5, 3);
  b.begin("arcade");
  b.box({0, 0, low}, {wide, deep, high - low});
  for (int n = 0; n <= bays; ++n)
    b.box({-0.5 * wide + 0.5 * pillar + n * (pillar + arch), 0, 0}, {pillar, deep, low});
}

void overhang(Builder& b) {
  const double wide = b.dice().real(4, 20), deep = b.dice().real(4, 20), low = b.dice().real(2.2, 6);
  b.begin("overhang");
  b.box({0, 0, low}, {wide, deep, b.dice().scale(0.05, 4)});
  b.box({-0.45 * wide, 0, 0}, {0.3, 0.3, low});
  b.box({0.45 * wide, 0, 0}, {0.3, 0.3, low - (b.dice().chance(0.3) ? b.slit() : 0)});
}

void thin_wall(Builder& b) {
  b.begin("thin");
  const double wide = b.dice().real(4, 30), high = b.dice().real(2, 10);
  if (b.dice().chance(0.5))
    b.add(Shape::sheet, {0, 0, 0}, {wide, 0, high});
  else
    b.box({0, 0, 0}, {wide, b.little(), high});
}

void spikes(Builder& b) {
  b.begin("spike");
  const int count = b.dice().whole(1, 4);
  for (int n = 0; n < count; ++n)
    b.add(Shape::spike, {b.dice().real(-4, 4), b.dice().real(-4, 4), 0},
          {b.dice().scale(0.05, 8), b.dice().scale(0.05, 8), b.dice().real(3, 20)});
}

void stacked(Builder& b) {
  const glm::dvec3 size = b.house();
  const double gap = b.dice().chance(0.6) ? b.slit() : 0;
  const bool one = b.dice().chance(0.5);
  b.begin("stack");
  b.box({0, 0, 0}, {size.x, size.y, 0.5 * size.z});
  if (!one) b.begin("stack");
  b.box({0, 0, 0.5 * size.z + gap}, {size.x * b.dice().pick({1.0, 0.8, 1.2}), size.y, 0.5 * size.z});
}

void open_box(Builder& b) {
  b.begin("open");
  b.add(b.dice().pick({Shape::box, Shape::gable, Shape::ell}), {0, 0, 0}, b.house()).open_top = true;
}

void nested(Builder& b) {
  const glm::dvec3 size = b.house();
  b.begin("outer");
  b.box({0, 0, 0}, size).open_top = b.dice().chance(0.2);
  b.begin("inner");
  b.box({0, 0, b.dice().chance(0.5) ? 0 : 0.2}, size * b.dice().pick({0.3, 0.9, 1.0}));
}

void sliver(Builder& b) {
  b.begin("sliver");
  Piece& piece =
      b.add(Shape::prism, {0, 0, 0}, {b.dice().real(3, 20), b.dice().scale(1e-4, 0.2), b.dice().real(1, 10)});
  piece.sides = 3, piece.lean = b.dice().real(-0.5, 0.5);
}

void far_away(Builder& b) {
  b.begin("far");
  b.box({0, 0, 0}, {b.dice().real(10, 60), b.dice().real(2, 20), b.dice().real(5, 40)});
}

void over_cell(Builder& b) {
  const double cell = b.dice().real(0.2, 1.5) * 4;
  b.begin("over");
  switch (b.dice().whole(0, 2)) {
    case 0:  // cuts it
      b.box({b.dice().real(-1, 1), 0, 0},
            {b.dice().scale(0.02, 1), b.dice().real(1, 20), b.dice().real(1, 6)});
      break;
    case 1:  // stands in it
      b.box({b.dice().real(-1, 1), b.dice().real(-1, 1), 0}, {b.little(), b.little(), b.dice().real(0.5, 4)});
      break;
    default:  // hangs over it
      b.box({0, 0, b.dice().real(2.3, 4)}, {cell, 2 * cell, b.dice().scale(0.05, 2)});
  }
}

constexpr std::array<void (*)(Builder&), static_cast<size_t>(Plot::count)> builders{
    block,     wall,   slit_wall, fence,    tower,  row_houses, courtyard, arcade,   overhang,
    thin_wall, spikes, stacked,   open_box, nested, sliver,     far_away,  over_cell};

}  // namespace

std::vector<Thing> build(Plot plot, const Site& site, Dice& dice) {
  Builder builder(site, dice);
  builders[static_cast<size_t>(plot)](builder);
  return std::move(builder.things);
}

}  // namespace veduta::campaign
