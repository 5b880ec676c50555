#include "scene/plans/nested_rings.h"

#include <cpl_quad_tree.h>
#include <ogr_geometry.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "scene/gdal_errors.h"

namespace veduta {
namespace {

// Rings of neighbours share edges but for rounding: what counts as inside may stick out by this part of its
// area.
constexpr double tolerance = 0.01;
// Comparing two areas is dear, and all of n rings in one another are n^2 of them.
constexpr size_t always_allowed = 20'000, allowed_for_each = 5;

struct Item {
  std::unique_ptr<OGRGeometry> area;  // of the ring, valid
  OGREnvelope box;
  double size = 0;    // m2, or what the unit is
  size_t number = 0;  // of the ring
  std::vector<const Item*> around;
  std::vector<Item*> equals;
  enum class Role { unknown, outline, hole } role = Role::unknown;
  const Item* outline = nullptr;  // of a hole
};

void bounds_of(const void* item, CPLRectObj* bounds) {
  const OGREnvelope& box = static_cast<const Item*>(item)->box;
  *bounds = {box.MinX, box.MinY, box.MaxX, box.MaxY};
}

double area_of(const OGRGeometry& geometry) {
  const OGRwkbGeometryType type = geometry.getGeometryType();
  if (OGR_GT_IsSurface(type)) return geometry.toSurface()->get_Area();
  if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) return geometry.toGeometryCollection()->get_Area();
  return 0;
}

Item item_of(const FlatRing& ring, size_t number) {
  Item item;
  item.number = number;
  OGRLinearRing line;
  for (const glm::dvec2& p : ring) line.addPoint(p.x, p.y);
  line.closeRings();
  auto polygon = std::make_unique<OGRPolygon>();
  polygon->addRing(&line);
  item.area = std::move(polygon);
  if (!item.area->IsValid()) item.area.reset(item.area->MakeValid());
  if (!item.area) item.area = std::make_unique<OGRPolygon>();
  item.area->getEnvelope(&item.box);
  item.size = area_of(*item.area);
  return item;
}

// A cheap look before the dear one: whether the boxes allow it.
bool may_be_inside(const Item& inner, const Item& outer) {
  OGREnvelope shared = inner.box;
  shared.Intersect(outer.box);
  const auto area = [](const OGREnvelope& box) { return (box.MaxX - box.MinX) * (box.MaxY - box.MinY); };
  return shared.IsInit() && area(shared) >= 0.9 * area(inner.box) &&
         inner.size <= outer.size * (1 + tolerance);
}

bool inside(const Item& inner, const Item& outer) {
  const std::unique_ptr<OGRGeometry> shared(inner.area->Intersection(outer.area.get()));
  return shared && area_of(*shared) >= (1 - tolerance) * inner.size;
}

bool same(const Item& a, const Item& b) {
  return std::abs(a.size - b.size) <= tolerance * std::max(a.size, b.size);
}

void find_around(std::vector<Item>& items, const std::string& place) {
  size_t left = always_allowed + allowed_for_each * items.size();
  CPLRectObj all{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                 -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Item& item : items) {
    all.minx = std::min(all.minx, item.box.MinX);
    all.miny = std::min(all.miny, item.box.MinY);
    all.maxx = std::max(all.maxx, item.box.MaxX);
    all.maxy = std::max(all.maxy, item.box.MaxY);
  }
  const std::unique_ptr<CPLQuadTree, void (*)(CPLQuadTree*)> tree(CPLQuadTreeCreate(&all, bounds_of),
                                                                  CPLQuadTreeDestroy);
  for (Item& item : items) CPLQuadTreeInsert(tree.get(), &item);
  for (Item& item : items) {
    if (item.size == 0) continue;
    CPLRectObj box;
    bounds_of(&item, &box);
    int count = 0;
    void** found = CPLQuadTreeSearch(tree.get(), &box, &count);
    for (int i = 0; i < count; ++i) {
      Item& other = *static_cast<Item*>(found[i]);
      if (&other == &item || !may_be_inside(item, other)) continue;
      if (left-- == 0) {
        CPLFree(found);
        throw Error(ExitStatus::bad_input, place +
                                               ": its closed lines lie in one another too often for "
                                               "buildings and courtyards; leave this layer out");
      }
      if (!inside(item, other)) continue;
      if (same(item, other)) {
        item.equals.push_back(&other);
      } else {
        item.around.push_back(&other);
      }
    }
    CPLFree(found);
  }
}

const Item* smallest_outline_around(const Item& item) {
  const Item* smallest = nullptr;
  for (const Item* other : item.around)
    if (other->role == Item::Role::outline && (!smallest || other->size < smallest->size)) smallest = other;
  return smallest;
}

// Of equal rings in an outline, the hole: programs write it after its outline.
Item& hole_among_equals(Item& item, const Item& outline) {
  Item* hole = &item;
  const auto rank = [&](const Item& one) { return std::pair(one.number < outline.number, one.number); };
  for (Item* other : item.equals)
    if (other->role == Item::Role::unknown && rank(*other) < rank(*hole)) hole = other;
  return *hole;
}

// From the largest to the smallest, so that all around a ring is known before it.
void give_roles(std::vector<Item>& items) {
  std::vector<Item*> order;
  for (Item& item : items) order.push_back(&item);
  std::stable_sort(order.begin(), order.end(),
                   [](const Item* a, const Item* b) { return a->size > b->size; });
  for (Item* item : order) {
    if (item->role != Item::Role::unknown) continue;
    const Item* outline = item->around.size() % 2 == 1 ? smallest_outline_around(*item) : nullptr;
    if (!outline) {
      item->role = Item::Role::outline;
      continue;
    }
    Item& hole = hole_among_equals(*item, *outline);
    item->role = Item::Role::outline;
    for (Item* other : item->equals) other->role = Item::Role::outline;
    hole.role = Item::Role::hole;
    hole.outline = outline;
  }
}

}  // namespace

std::vector<std::vector<size_t>> nest_rings(const std::vector<FlatRing>& rings, const std::string& place) {
  const GdalErrors errors;
  std::vector<Item> items;
  items.reserve(rings.size());
  for (size_t i = 0; i < rings.size(); ++i) items.push_back(item_of(rings[i], i));
  if (!items.empty()) find_around(items, place);
  give_roles(items);
  std::vector<std::vector<size_t>> holes(items.size()), polygons;
  for (const Item& item : items)
    if (item.outline) holes[item.outline->number].push_back(item.number);
  for (const Item& item : items) {
    if (item.role == Item::Role::hole) continue;
    polygons.push_back({item.number});
    polygons.back().insert(polygons.back().end(), holes[item.number].begin(), holes[item.number].end());
  }
  return polygons;
}

}  // namespace veduta
