#include "pvs/pvs_stream.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <random>
#include <set>

#include "pvs/pvs_layout.h"
#include "tests/pvs/small_verification.h"
#include "tests/pvs/stream_compare.h"

namespace veduta {
namespace {

using test::status_of;
using test::TemporaryDirectory;

/// Objects of 0 to 60 triangles whose vertices lie in a row, or anywhere in the file: the format promises
/// neither.
City random_city(uint32_t objects, uint32_t cells, bool vertices_in_a_row, uint32_t seed) {
  std::mt19937 random(seed);
  City city = test::small_city(0, cells);
  Scene& scene = city.scene;
  scene.objects.clear();
  city.slices.clear();
  const auto metre = [&] { return static_cast<float>(random() % 4096) / 64; };
  for (uint32_t i = 0; i < objects; ++i) {
    const uint64_t begin = scene.triangles.size();
    for (uint32_t t = random() % 61; t > 0; --t) {
      const auto v = static_cast<uint32_t>(scene.vertices.size());
      for (int corner = 0; corner < 3; ++corner)
        scene.vertices.push_back({metre() + static_cast<float>(i), metre(), metre()});
      scene.triangles.push_back({v, v + 1, v + 2});
      scene.material.push_back(static_cast<Material>(random() % 10));
      city.triangle_slices.push_back({1, 3, static_cast<uint8_t>(1 + random() % 2), 2, 1, 1});
    }
    scene.objects.push_back({"o" + std::to_string(i), Kind::building, begin, scene.triangles.size()});
    city.slices.push_back({3, 2, 1});
  }
  if (!vertices_in_a_row) {
    std::vector<uint32_t> place(scene.vertices.size());
    std::iota(place.begin(), place.end(), 0u);
    std::shuffle(place.begin(), place.end(), random);
    std::vector<glm::vec3> moved(place.size());
    for (size_t v = 0; v < place.size(); ++v) moved[place[v]] = scene.vertices[v];
    scene.vertices = moved;
    for (glm::uvec3& t : scene.triangles) t = {place[t.x], place[t.y], place[t.z]};
  }
  return city;
}

CellSource random_rows(uint32_t objects) {
  return [objects](uint32_t c) {
    std::mt19937 random(c / 3);  // cells share rows
    BakedCell cell{CellStatus::baked, c, {}, 0};
    if (c % 50 == 49) cell.status = CellStatus::all_visible;
    for (uint32_t o = random() % 5; o < objects; o += 1 + random() % 9)
      cell.row.push_back({o, {static_cast<int8_t>(random() % 4), 0, static_cast<int8_t>(random() % 2)}});
    std::erase_if(cell.row, [](const PvsEntry& e) { return e.index.nothing(); });
    return cell;
  };
}

void expect_same_file(const std::filesystem::path& path, size_t objects_a_page) {
  PvsStream stream(path);
  stream.read_navigation();
  const PvsFile file = read_pvs(path);
  test::expect_same_index(stream.index(), file);
  for (uint32_t row = 0; row + 1 < file.row_begin.size(); ++row) test::expect_same_row(stream, file, row);
  const auto objects = static_cast<uint32_t>(file.city.scene.objects.size());
  for (uint32_t first = 0; first < objects; first += static_cast<uint32_t>(objects_a_page))
    test::expect_same_objects(stream, file, first,
                              std::min(objects, first + static_cast<uint32_t>(objects_a_page)));
}

TEST(PvsStream, OfASmallFileIsWhatIsReadWhole) {
  TemporaryDirectory directory;
  write_pvs(directory / "a.h5", test::small_city(), test::small_header(), test::small_row);
  expect_same_file(directory / "a.h5", 2);
  EXPECT_FALSE(PvsStream(directory / "a.h5").index().verification.has_value());
  store_verification(directory / "a.h5", read_pvs(directory / "a.h5"), test::small_verification());
  expect_same_file(directory / "a.h5", 1);
  EXPECT_EQ(PvsStream(directory / "a.h5").index().verification, test::small_verification());
  EXPECT_EQ(PvsStream(directory / "a.h5").index().row_size(2), 2u);
}

TEST(PvsStream, SaysWhoBaked) {
  TemporaryDirectory directory;
  write_pvs(directory / "a.h5", test::small_city(), test::small_header(), test::small_row_of_worker,
            test::small_workers);
  expect_same_file(directory / "a.h5", 3);
  EXPECT_EQ(PvsStream(directory / "a.h5").index().workers, test::small_workers);
}

TEST(PvsStream, EveryRunOfObjects) {
  TemporaryDirectory directory;
  write_pvs(directory / "a.h5", test::small_city(), test::small_header(), test::small_row);
  const PvsStream stream(directory / "a.h5");
  const PvsFile file = read_pvs(directory / "a.h5");
  for (uint32_t first = 0; first <= 6; ++first)
    for (uint32_t last = first; last <= 6; ++last) test::expect_same_objects(stream, file, first, last);
}

TEST(PvsStream, OfFilesOfManyChunksIsWhatIsReadWhole) {
  TemporaryDirectory directory;
  for (const bool in_a_row : {true, false}) {
    SCOPED_TRACE(in_a_row);
    write_pvs(directory / "a.h5", random_city(1500, 900, in_a_row, 5), test::small_header(),
              random_rows(1500));
    expect_same_file(directory / "a.h5", in_a_row ? 7 : 101);
    const PvsStream stream(directory / "a.h5");
    const PvsFile file = read_pvs(directory / "a.h5");
    ASSERT_GT(file.city.scene.triangles.size(), 40000u) << "no more than a chunk";
    ASSERT_GT(file.entries.size(), 70000u) << "no more than a chunk";
    std::mt19937 random(8);
    for (int i = 0; i < 60; ++i) {
      test::expect_same_row(stream, file, random() % static_cast<uint32_t>(file.row_begin.size() - 1));
      const uint32_t first = random() % 1500, last = first + random() % std::min(1501 - first, 50u);
      test::expect_same_objects(stream, file, first, last);
    }
    test::expect_same_objects(stream, file, 0, 1500);
  }
}

TEST(PvsStream, KeepsWithinItsMemory) {
  TemporaryDirectory directory;
  write_pvs(directory / "a.h5", random_city(1500, 900, false, 5), test::small_header(), random_rows(1500));
  const PvsFile file = read_pvs(directory / "a.h5");
  uint64_t most = 0;
  for (const uint64_t budget : {uint64_t{0}, uint64_t{1} << 20, uint64_t{5} << 18, uint64_t{1} << 30}) {
    SCOPED_TRACE(budget);
    const PvsStream stream(directory / "a.h5", budget);
    most = 0;
    const auto look = [&] {
      ASSERT_LE(stream.kept_bytes(), std::max(budget, uint64_t{chunk_bytes}));
      most = std::max(most, stream.kept_bytes());
    };
    for (uint32_t row = 0; row + 1 < file.row_begin.size(); row += 7) {
      test::expect_same_row(stream, file, row);
      look();
    }
    for (uint32_t object = 0; object < 1500; object += 50) {
      test::expect_same_objects(stream, file, object, object + 3);
      look();
    }
  }
  EXPECT_GT(most, uint64_t{7} << 18) << "of the last budget; there is no more than the others have room for";
}

TEST(PvsStream, KnowsWhichRowsItKeeps) {
  TemporaryDirectory directory;
  write_pvs(directory / "a.h5", random_city(1500, 900, true, 5), test::small_header(), random_rows(1500));
  const PvsStream stream(directory / "a.h5");
  const auto last = static_cast<uint32_t>(stream.index().row_begin.size() - 2);
  EXPECT_FALSE(stream.keeps_row(0));
  stream.read_row(0);
  EXPECT_TRUE(stream.keeps_row(0));
  EXPECT_TRUE(stream.keeps_row(1)) << "of the same chunks";
  EXPECT_FALSE(stream.keeps_row(last)) << "of others";
  stream.read_row(last);
  EXPECT_TRUE(stream.keeps_row(last));
}

TEST(PvsStream, ReadsTheNavigationWhenItIsAskedFor) {
  TemporaryDirectory directory;
  const City city = test::small_city();
  write_pvs(directory / "a.h5", city, test::small_header(), test::small_row);
  PvsStream stream(directory / "a.h5");
  const Navigation& navigation = stream.index().navigation;
  EXPECT_TRUE(navigation.free.states.empty() && navigation.surfaces.states.empty());
  EXPECT_EQ(navigation.ground.nx, 0u);
  stream.read_navigation();
  EXPECT_EQ(navigation.free, city.navigation.free);
  EXPECT_EQ(navigation.surfaces, city.navigation.surfaces);
  EXPECT_EQ(navigation.ground.nx, city.navigation.ground.nx);
}

TEST(PvsStream, KeepsOnlyVerticesThatAreUsed) {
  TemporaryDirectory directory;
  write_pvs(directory / "a.h5", random_city(300, 5, false, 6), test::small_header(), random_rows(300));
  const City page = PvsStream(directory / "a.h5").read_objects(20, 30);
  std::set<uint32_t> used;
  for (const glm::uvec3& t : page.scene.triangles) used.insert({t.x, t.y, t.z});
  EXPECT_EQ(page.scene.vertices.size(), used.size());
}

TEST(PvsStream, OfRealFilesIsWhatIsReadWhole) {
  const char* const named = std::getenv("VEDUTA_PVS_FILE");
  if (!named) GTEST_SKIP() << "VEDUTA_PVS_FILE names no baked file to compare with";
  expect_same_file(named, 100);
}

TEST(PvsStream, MayBeMoved) {
  TemporaryDirectory directory;
  write_pvs(directory / "a.h5", test::small_city(), test::small_header(), test::small_row);
  PvsStream first(directory / "a.h5");
  PvsStream second(std::move(first));
  EXPECT_EQ(second.read_row(1), test::small_row(1).row);
  EXPECT_EQ(second.index().find_cell({25, -5, 1.5f}), 2);
}

TEST(PvsStream, RefusesWhatIsNoFileOfOurs) {
  TemporaryDirectory directory;
  const auto open = [&](const std::string& name) { return [=, &directory] { PvsStream(directory / name); }; };
  std::string message;
  EXPECT_EQ(status_of(open("none.h5"), &message), ExitStatus::bad_input);
  EXPECT_NE(message.find("no such file"), std::string::npos) << message;
  test::write_bytes(directory / "text.h5", "no HDF5 at all");
  EXPECT_EQ(status_of(open("text.h5")), ExitStatus::bad_input);
  EXPECT_EQ(status_of(open(".")), ExitStatus::bad_input);
  write_city(directory / "city.h5", test::small_city());
  EXPECT_EQ(status_of(open("city.h5"), &message), ExitStatus::bad_input);
  EXPECT_NE(message.find("veduta-city"), std::string::npos) << message;
}

TEST(PvsStream, NamesTheVersionOfAFileOfAnother) {
  TemporaryDirectory directory;
  write_pvs(directory / "a.h5", test::small_city(), test::small_header(), test::small_row);
  const hid_t file = H5Fopen((directory / "a.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t version = H5Aopen(file, "version", H5P_DEFAULT);
  const uint32_t next = 5;
  ASSERT_GE(H5Awrite(version, H5T_NATIVE_UINT32, &next), 0);
  H5Aclose(version);
  ASSERT_GE(H5Ldelete(file, "/pvs", H5P_DEFAULT), 0) << "which may lack what this one has";
  H5Fclose(file);
  std::string message;
  EXPECT_EQ(status_of([&] { PvsStream(directory / "a.h5"); }, &message), ExitStatus::bad_input);
  EXPECT_NE(message.find("version 5, this program reads 4; use the version that wrote it"), std::string::npos)
      << message;
}

}  // namespace
}  // namespace veduta
