// The OBJ side of scene/import.h.
#include "temporary_models.h"

namespace veduta {
namespace {

using ImportObj = TemporaryModels;

const std::string two_squares =
    "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nv 0 0 5\nv 10 0 5\nv 10 10 5\nv 0 10 5\n";

TEST_F(ImportObj, ObjectsGroupsAndParts) {
  const ImportResult result =
      import("town.obj", two_squares +
                             "o house\ng roof\nf 5 6 7 8\ng floor\nf 1 2 3 4\ng roof\nf 1 2 6\n"
                             "o Terrain_1\nf 1 2 3\no nothing\n");
  const Scene& scene = result.scene;
  expect_consistent(scene);
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[0].name, "house");
  EXPECT_EQ(scene.objects[0].kind, Kind::building);
  EXPECT_EQ(scene.objects[1].name, "Terrain_1/0_0");
  EXPECT_EQ(scene.objects[1].kind, Kind::terrain);
  ASSERT_EQ(scene.parts.size(), 2u);
  EXPECT_EQ(scene.parts[0].name, "roof");
  EXPECT_EQ(scene.parts[0].triangle_end - scene.parts[0].triangle_begin, 3u);
  EXPECT_EQ(scene.parts[1].name, "floor");
  EXPECT_EQ(scene.parts[1].triangle_end - scene.parts[1].triangle_begin, 2u);
  EXPECT_EQ(result.report.dropped.at("object without triangles").count, 1u);
  EXPECT_EQ(result.report.format, "OBJ");
}

TEST_F(ImportObj, GroupsAloneAreObjectsAndWithoutThemComponentsAre) {
  const Scene groups =
      import("a.obj", two_squares + "g one\nf 1 2 3\ng two\nf 5 6 7\ng one\nf 1 3 4\n").scene;
  ASSERT_EQ(groups.objects.size(), 2u);
  EXPECT_EQ(groups.objects[0].name, "one");
  EXPECT_EQ(groups.objects[0].triangle_end, 2u);
  EXPECT_EQ(groups.objects[1].name, "two");
  EXPECT_TRUE(groups.parts.empty());
  const Scene plain = import("chapel.obj", two_squares + "f 1 2 6\nf 3 4 8\n").scene;
  ASSERT_EQ(plain.objects.size(), 2u);
  EXPECT_EQ(plain.objects[0].name, "chapel/1");
  EXPECT_EQ(plain.objects[1].name, "chapel/2");
  const Scene connected = import("chapel.obj", two_squares + "f 1 2 6\nf 3 4 8\nf 1 2 3\n").scene;
  ASSERT_EQ(connected.objects.size(), 1u);
  EXPECT_EQ(connected.objects[0].name, "chapel");
}

TEST_F(ImportObj, WhatExportersWrite) {
  // Negative indices, texture and normal indices, comments, continued lines, CRLF, a byte order mark, a '#'
  // in a name.
  const ImportResult result =
      import("odd.obj",
             "\xEF\xBB\xBF# path C:\\models\\\r\nmtllib a.mtl\r\nv 0 0 0 1.0 0.5 0.5\r\nv +1e1 0 0\r\n"
             "v 10 10 \\\r\n 0 # corner\r\nv 0 10 1e-400\r\nvt 0 0\r\nvn 0 0 1\r\no house #7\r\n"
             "usemtl stone\r\ns off\r\nf -4/1/1 -3//1 \\\r\n-2/1 -1\r\nl 1 2\r\n");
  expect_consistent(result.scene);
  EXPECT_EQ(result.scene.objects[0].name, "house #7");
  EXPECT_NEAR(area_m2(result.scene), 100, 1e-6);
  EXPECT_EQ(result.report.dropped.at("OBJ statement 'l'").count, 1u);
  EXPECT_TRUE(result.report.dropped.at("OBJ statement 'l'").first_place.ends_with("odd.obj: line 15"));
}

TEST_F(ImportObj, NamesAreUnique) {
  const Scene scene = import("n.obj", two_squares + "o a\nf 1 2 3\no a\nf 5 6 7\no a#2\nf 1 3 4\n").scene;
  ASSERT_EQ(scene.objects.size(), 3u);
  EXPECT_EQ(scene.objects[0].name, "a");
  EXPECT_EQ(scene.objects[1].name, "a#2");
  EXPECT_EQ(scene.objects[2].name, "a#2#2");
}

TEST_F(ImportObj, DegenerateAndDuplicateAreCountedWithTheFirstPlace) {
  const ImportResult result = import(
      "d.obj", two_squares + "f 1 2 3\nf 3 1 2\nf 1 3 2\nf 1 1 2\nf 1 2\nv 5 0 0\nv 5 1e-9 0\nf 1 9 10\n");
  EXPECT_EQ(result.scene.triangles.size(), 1u);
  EXPECT_EQ(result.report.dropped.at("duplicate triangle").count, 2u);
  EXPECT_TRUE(result.report.dropped.at("duplicate triangle").first_place.ends_with("d.obj: line 10"));
  EXPECT_EQ(result.report.dropped.at("degenerate polygon").count, 2u);
  EXPECT_TRUE(result.report.dropped.at("degenerate polygon").first_place.ends_with("d.obj: line 12"));
}

TEST_F(ImportObj, NationalGridCoordinatesKeepATenthOfAMillimetre) {
  const Scene scene = import("far.obj",
                             "v 500123.4567 5412345.6789 12.3456\nv 500133.4567 5412345.6789 12.3456\n"
                             "v 500133.4567 5412355.6789 12.3456\nf 1 2 3\n")
                          .scene;
  const double expected[3] = {500123.4567, 5412345.6789, 12.3456};
  const glm::vec3 lower = scene.bounds().lower;
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(scene.origin[static_cast<size_t>(axis)] + static_cast<double>(lower[axis]), expected[axis],
                1e-5);
}

TEST_F(ImportObj, MaterialsAreWhatTheirNamesOrElseTheGroupsSay) {
  const Scene scene = import("m.obj", two_squares +
                                          "o house\nf 5 6 7 8\ng window_2\nf 1 2 6 5\ng upper\nf 2 3 7 6\n"
                                          "usemtl door\nf 3 4 8 7\nusemtl c0ffee\nf 4 1 5 8\n")
                          .scene;
  EXPECT_EQ(scene.material,
            (std::vector{Material::roof, Material::roof, Material::window, Material::window, Material::wall,
                         Material::wall, Material::door, Material::door, Material::wall, Material::wall}));
}

}  // namespace
}  // namespace veduta
