#include "viewer/draw/command_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>

#include "tests/viewer/toy_city.h"

namespace veduta {
namespace {

// The street of toy_city.h in two pages that lie anywhere in the element buffer, the second before the first.
class CommandListTest : public testing::Test {
 protected:
  CommandListTest() {
    index_.objects = city_.scene.objects;
    index_.slices = city_.slices;
    for (uint32_t o = 0; o < index_.objects.size(); ++o) index_.bounds.push_back(city_.scene.bounds(o));
    pages_ = {{toy::Street::ground, toy::Street::shed, 0, {}},
              {toy::Street::shed, toy::Street::tower + 1, 0, {}}};
    cities_ = {city_of(pages_[0]), city_of(pages_[1])};
    const auto stride = [&](size_t page) {
      return static_cast<uint32_t>(3 * cities_[page].scene.triangles.size());
    };
    places_ = {{7000, stride(0), 500}, {900, stride(1), 20}};
    lister_.emplace(index_, pages_);
  }

  City city_of(const PageSpan& span) const {
    City page;
    const uint64_t begin = city_.scene.objects[span.first_object].triangle_begin;
    for (uint32_t o = span.first_object; o < span.last_object; ++o) {
      Object object = city_.scene.objects[o];
      for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t) {
        page.scene.triangles.push_back(city_.scene.triangles[t]);
        page.triangle_slices.push_back(city_.triangle_slices[t]);
      }
      object.triangle_begin -= begin, object.triangle_end -= begin;
      page.scene.objects.push_back(object);
      page.slices.push_back(city_.slices[o]);
    }
    return page;
  }
  void add(uint32_t page) { lister_->add(page, places_[page], SliceRanges(cities_[page])); }

  // The triangles behind the commands, by number of the whole city, in the sequence in which they are drawn.
  std::vector<uint64_t> triangles(const CommandList& list) const {
    std::vector<uint64_t> all;
    for (const IndirectCommand& command : list.commands) {
      const size_t page = command.base_vertex == places_[0].base_vertex ? 0 : 1;
      EXPECT_EQ(command.base_vertex, places_[page].base_vertex);
      EXPECT_EQ(command.instances, 1u);
      const TriangleOrders orders = triangle_orders(cities_[page]);
      for (uint32_t element = command.first_index; element < command.first_index + command.count;
           element += 3) {
        const uint32_t inside = element - places_[page].first_index;
        all.push_back(orders[inside / places_[page].order_stride][inside % places_[page].order_stride / 3] +
                      city_.scene.objects[pages_[page].first_object].triangle_begin);
      }
    }
    return all;
  }
  std::vector<uint64_t> expected(const std::vector<PvsEntry>& entries) const {
    std::vector<uint64_t> all;
    for (uint32_t o = 0; o < city_.scene.objects.size(); ++o)
      for (uint64_t t = city_.scene.objects[o].triangle_begin; t < city_.scene.objects[o].triangle_end; ++t)
        if (std::any_of(entries.begin(), entries.end(), [&](const PvsEntry& entry) {
              return entry.object == o && draws(entry.index, city_.triangle_slices[t]);
            }))
          all.push_back(t);
    return all;
  }
  static std::vector<uint64_t> sorted(std::vector<uint64_t> numbers) {
    std::sort(numbers.begin(), numbers.end());
    return numbers;
  }
  VisibleObjects everything() const { return {-1, true, false, {}}; }

  toy::Street street_ = toy::make_street();
  const City& city_ = street_.file.city;
  PvsIndex index_;
  std::vector<PageSpan> pages_;
  std::vector<City> cities_;
  std::vector<PagePlace> places_;
  std::optional<CommandLister> lister_;
};

TEST_F(CommandListTest, EverythingIsOneCommandAPage) {
  add(0), add(1);
  const CommandList list = lister_->list(everything(), {});
  EXPECT_EQ(list.commands.size(), 2u);
  EXPECT_EQ(list.objects, 5u);
  EXPECT_EQ(list.absent, 0u);
  EXPECT_EQ(list.triangles, city_.scene.triangles.size());
  EXPECT_EQ(sorted(triangles(list)).size(), city_.scene.triangles.size());
  EXPECT_EQ(sorted(triangles(list)).back(), city_.scene.triangles.size() - 1);
}

TEST_F(CommandListTest, DrawsWhatTheRowSays) {
  add(0), add(1);
  const CommandList list = lister_->list({0, false, false, street_.file.entries}, {});
  EXPECT_EQ(list.objects, 4u);
  EXPECT_EQ(sorted(triangles(list)), expected(street_.file.entries));
  EXPECT_EQ(list.triangles, expected(street_.file.entries).size());
  EXPECT_LT(list.triangles, city_.scene.triangles.size()) << "no shed, and not the tower's lowest floor";
}

TEST_F(CommandListTest, TwoListsDrawWhatTheyShareInTheSameSequence) {
  add(0), add(1);
  const std::vector<uint64_t> part = triangles(lister_->list({0, false, false, street_.file.entries}, {}));
  std::vector<uint64_t> all = triangles(lister_->list(everything(), {}));
  all.erase(std::remove_if(all.begin(), all.end(),
                           [&](uint64_t t) { return std::find(part.begin(), part.end(), t) == part.end(); }),
            all.end());
  EXPECT_EQ(part, all);
}

TEST_F(CommandListTest, PagesThatTouchInTheBufferKeepTheirVertices) {
  places_[1].first_index =
      places_[0].first_index + static_cast<uint32_t>(order_count) * places_[0].order_stride;
  add(0), add(1);
  // The end of the first page's last order, and the begin of the second page's first.
  const std::vector<PvsEntry> row{{toy::Street::wall, completely_visible}, {toy::Street::shed, {1, 0, 0}}};
  const CommandList list = lister_->list({0, false, false, row}, {});
  ASSERT_EQ(list.commands.size(), 2u);
  EXPECT_EQ(sorted(triangles(list)), expected(row));
}

TEST_F(CommandListTest, CountsWhatIsNotHere) {
  EXPECT_EQ(lister_->list(everything(), {}).absent, 5u);
  add(1);
  const CommandList list = lister_->list({0, false, false, street_.file.entries}, {});
  EXPECT_EQ(list.objects, 1u);
  EXPECT_EQ(list.absent, 3u);
  EXPECT_EQ(sorted(triangles(list)), expected({street_.file.entries.back()}));
  add(0), lister_->remove(1);
  EXPECT_EQ(lister_->list(everything(), {}).absent, 2u) << "shed and tower";
}

TEST_F(CommandListTest, LeavesOutWhatIsOutsideOfAllFrusta) {
  add(0), add(1);
  const Frustum ahead = single_location_frustum({{0, 0, 1.7f}, 0, 0}, {});
  const Frustum back = single_location_frustum({{0, 0, 1.7f}, 180, 0}, {});
  EXPECT_EQ(lister_->list(everything(), {&ahead, 1}).objects, 5u);
  EXPECT_EQ(lister_->list(everything(), {&back, 1}).objects, 1u) << "only the ground is behind";
  const std::array both{back, ahead};
  EXPECT_EQ(lister_->list(everything(), both).objects, 5u);
  EXPECT_EQ(lister_->list({0, false, false, street_.file.entries}, {&back, 1}).objects, 1u);
}

TEST_F(CommandListTest, AnObjectOfTwoEntriesCountsOnce) {
  const std::vector<PvsEntry> two{{toy::Street::tower, {1, 0, 0}}, {toy::Street::tower, {0, 1, 0}}};
  EXPECT_EQ(lister_->list({0, false, false, two}, {}).absent, 1u);
  add(1);
  EXPECT_EQ(lister_->list({0, false, false, two}, {}).objects, 1u);
}

// Triangles at the four corners of an object that is cut once along x and once along z, and some in the lower
// left one.
City four_corners(uint64_t more) {
  City city;
  city.triangle_slices = {{1, 1, 1, 1, 2, 2}, {2, 2, 1, 1, 2, 2}, {2, 2, 1, 1, 1, 1}};
  city.triangle_slices.resize(4 + more, {1, 1, 1, 1, 1, 1});
  city.scene.triangles.resize(4 + more);
  city.scene.objects = {{"house", Kind::building, 0, 4 + more}};
  city.slices = {{2, 1, 2}};
  return city;
}

TEST(CommandList, AnObjectThatTwoRangesDrawAsOftenAsItIsLargeIsDrawnWhole) {
  for (uint64_t more : {0u, 3u}) {
    const City city = four_corners(more);
    PvsIndex index;
    index.objects = city.scene.objects, index.slices = city.slices, index.bounds = {{{0, 0, 0}, {1, 1, 1}}};
    CommandLister lister(index, {{0, 1, 4 + more, {}}});
    lister.add(0, {0, static_cast<uint32_t>(3 * (4 + more)), 0}, SliceRanges(city));
    const auto list = [&](VisibilityIndex part) { return lister.list({0, false, false, {{0, part}}}, {}); };
    // The upper half has 2 triangles, the right half 2; one is in both.
    EXPECT_EQ(list({-1, 0, 2}).commands.size(), more == 0 ? 1u : 2u);
    EXPECT_EQ(list({-1, 0, 2}).triangles, 4u);
    // The left half has the others, too.
    EXPECT_EQ(list({1, 0, 2}).commands.size(), 1u);
    EXPECT_EQ(list({1, 0, 2}).triangles, 4 + more);
  }
}

}  // namespace
}  // namespace veduta
