// A city of all sorts of slices in a file, and what the installed library should say of it.
#pragma once

#include <gtest/gtest.h>

#include <veduta/pvs.h>
#include <algorithm>
#include <random>
#include <string>

#include "tests/pvs/small_city.h"

namespace veduta::test {

/// Objects cut into as many slices as they like, triangles in any of them; no two triangles are equal.
inline veduta::City sliced_city(uint32_t objects, uint32_t cells, uint32_t seed) {
  std::mt19937 random(seed);
  veduta::City city = small_city(0, cells);
  Scene& scene = city.scene;
  scene.objects.clear();
  city.slices.clear();
  const auto upto = [&](int most) {
    return static_cast<uint8_t>(1 + random() % static_cast<uint32_t>(most));
  };
  for (uint32_t i = 0; i < objects; ++i) {
    const SliceCounts counts{upto(5), upto(5), upto(5)};
    const uint64_t begin = scene.triangles.size();
    for (uint32_t t = random() % 30; t > 0; --t) {
      const auto v = static_cast<uint32_t>(scene.vertices.size());
      const auto x = static_cast<float>(v), y = static_cast<float>(i);
      scene.vertices.insert(scene.vertices.end(), {{x, y, 0}, {x + 1, y, 0}, {x, y, 1}});
      scene.triangles.push_back({v, v + 1, v + 2});
      scene.material.push_back(static_cast<Material>(random() % 10));
      TriangleSlices s{upto(counts.x), upto(counts.x), upto(counts.y),
                       upto(counts.y), upto(counts.z), upto(counts.z)};
      if (s.x_first > s.x_last) std::swap(s.x_first, s.x_last);
      if (s.y_first > s.y_last) std::swap(s.y_first, s.y_last);
      if (s.z_first > s.z_last) std::swap(s.z_first, s.z_last);
      city.triangle_slices.push_back(s);
    }
    scene.objects.push_back(
        {"o" + std::to_string(i), static_cast<veduta::Kind>(i % 7), begin, scene.triangles.size()});
    city.slices.push_back(counts);
  }
  return city;
}

/// Rows of entries that their objects may have; of every 20 cells one is all visible, one coarse.
inline CellSource sliced_rows(const veduta::City& city) {
  return [&city](uint32_t c) {
    std::mt19937 random(c / 2);  // cells share rows
    BakedCell cell{veduta::CellStatus::baked, c, {}, 0};
    if (c % 20 == 18) cell.status = veduta::CellStatus::coarse;
    if (c % 20 == 19) cell.status = veduta::CellStatus::all_visible;
    for (uint32_t o = random() % 3; o < city.slices.size(); o += 1 + random() % 4) {
      const SliceCounts n = city.slices[o];
      const auto either = [&](int most) {
        return static_cast<int8_t>(static_cast<int>(random() % static_cast<uint32_t>(2 * most - 1)) -
                                   (most - 1));
      };
      VisibilityIndex index{0, 0, static_cast<int8_t>(random() % (n.z + 1u))};
      if (index.z != 1) (random() % 2 ? index.x = either(n.x) : index.y = either(n.y));
      if (!index.nothing()) cell.row.push_back({o, index});
    }
    return cell;
  };
}

inline pvs::Point to_point(const glm::vec3& p) {
  return {p.x, p.y, p.z};
}

inline void expect_same_box(const pvs::Box& a, const Box& b) {
  EXPECT_EQ(a.lower, to_point(b.lower));
  EXPECT_EQ(a.upper, to_point(b.upper));
}

inline void expect_same_city(const pvs::City& city, const PvsFile& file) {
  EXPECT_EQ(city.crs(), file.city.scene.crs);
  EXPECT_EQ(city.origin(), file.city.scene.origin);
  EXPECT_EQ(city.content_digest(), file.content_digest);
  EXPECT_EQ(city.conservative(), file.header.conservative);
  ASSERT_EQ(city.object_count(), file.city.scene.objects.size());
  for (uint32_t i = 0; i < city.object_count(); ++i) {
    const pvs::Object& object = city.object(i);
    const veduta::Object& known = file.city.scene.objects[i];
    EXPECT_EQ(object.name, known.name);
    EXPECT_EQ(static_cast<int>(object.kind), static_cast<int>(known.kind));
    EXPECT_EQ(object.triangles, known.triangle_end - known.triangle_begin);
    expect_same_box(object.bounds, file.city.scene.bounds(i));
    const SliceCounts n = file.city.slices[i];
    EXPECT_EQ(object.slices, (std::array<uint8_t, 3>{n.x, n.y, n.z}));
  }
  ASSERT_EQ(city.cell_count(), file.city.cells.size());
  for (uint32_t c = 0; c < city.cell_count(); ++c) {
    expect_same_box(city.cell(c), file.city.cells[c]);
    EXPECT_EQ(static_cast<int>(city.cell_status(c)), static_cast<int>(file.cell_status[c]));
  }
}

inline void expect_same_rows(const pvs::City& city, const PvsFile& file) {
  pvs::Row row{{99, 1, 1, 1}};  // what was there before is gone
  for (uint32_t c = 0; c < city.cell_count(); ++c) {
    city.read_row(c, row);
    const PvsFile::Span known = file.row(c);
    ASSERT_EQ(row.size(), known.size()) << "cell " << c;
    for (size_t i = 0; i < row.size(); ++i) {
      const VisibilityIndex& index = known.first[i].index;
      ASSERT_EQ(row[i], (pvs::Entry{known.first[i].object, index.x, index.y, index.z})) << "cell " << c;
    }
  }
}

/// The message of the Error that an action throws.
template <typename Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const pvs::Error& error) {
    return error.what();
  }
  return "";
}

class SlicedCity : public testing::Test {
 protected:
  SlicedCity() {
    const veduta::City city = sliced_city(40, 60, 7);
    write_pvs(path_, city, small_header(), sliced_rows(city));
    file_ = read_pvs(path_);
  }

  TemporaryDirectory directory_;
  std::filesystem::path path_ = directory_ / "a.pvs.h5";
  PvsFile file_;
};

}  // namespace veduta::test
