// Coordinates of well-known places from one CRS to another, and what is said of a CRS that is none.
#include "scene/crs.h"

#include <gtest/gtest.h>
#include <ogr_srs_api.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <thread>
#include <vector>

#include "scene/error.h"

namespace veduta {
namespace {

glm::dvec3 transformed(const std::string& from, const std::string& to, glm::dvec3 point) {
  CrsTransform(from, to).apply({&point, 1});
  return point;
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::bad_input);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "";
}

// The reference of the UTM formulas: on the central meridian x is 500 km; on the equator y is 0 or 10,000 km.
TEST(Crs, UtmOnItsCentralMeridian) {
  const glm::dvec3 north = transformed("EPSG:4326", "EPSG:32633", {15, 0, 123.456});
  EXPECT_NEAR(north.x, 500000, 1e-6);
  EXPECT_NEAR(north.y, 0, 1e-6);
  EXPECT_EQ(north.z, 123.456);
  const glm::dvec3 south = transformed("EPSG:4326", "EPSG:32733", {15, 0, -3});
  EXPECT_NEAR(south.x, 500000, 1e-6);
  EXPECT_NEAR(south.y, 10000000, 1e-6);
  EXPECT_EQ(south.z, -3);
}

// Amersfoort, the origin of the Dutch grid: 155,000, 463,000 by definition; WGS 84 after RDNAP within a
// metre.
TEST(Crs, DutchGridAtAmersfoort) {
  for (const char* dutch :
       {"EPSG:28992", "EPSG:7415", "urn:ogc:def:crs:EPSG::7415", "http://www.opengis.net/def/crs/EPSG/0/7415",
        "https://www.opengis.net/def/crs/EPSG/0/28992"}) {
    const glm::dvec3 degrees = transformed(dutch, "EPSG:4326", {155000, 463000, 42});
    EXPECT_NEAR(degrees.x, 5.387204, 2e-5) << dutch;
    EXPECT_NEAR(degrees.y, 52.155174, 1e-5) << dutch;
    EXPECT_EQ(degrees.z, 42) << dutch;
  }
}

// EPSG:3946, conic conformal zone 5: false origin 1,700,000 / 5,200,000 at 3 E, 46 N. Its datum is WGS 84's.
TEST(Crs, LyonAtItsFalseOrigin) {
  const glm::dvec3 origin = transformed("EPSG:4326", "EPSG:3946", {3, 46, 0});
  EXPECT_NEAR(origin.x, 1700000, 1e-6);
  EXPECT_NEAR(origin.y, 5200000, 1e-3);
}

// x is east, also where the authority's first axis is the north (EPSG:31467, EPSG:4258).
TEST(Crs, AxesAreEastNorth) {
  const glm::dvec3 p = transformed("EPSG:4258", "EPSG:31467", {9, 50, 0});
  EXPECT_NEAR(p.x, 3500000, 200);
  EXPECT_NEAR(p.y, 5540000, 2000);
}

TEST(Crs, ThereAndBack) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 10000; ++i) points.emplace_back(80000 + i, 450000 + 3 * i, i);
  const std::vector<glm::dvec3> before = points;
  CrsTransform("EPSG:28992", "EPSG:32631").apply(points);
  EXPECT_GT(std::abs(points[9999].x - before[9999].x), 1000);
  CrsTransform("EPSG:32631", "EPSG:28992").apply(points);
  for (size_t i = 0; i < points.size(); ++i) {
    ASSERT_NEAR(points[i].x, before[i].x, 1e-3) << i;
    ASSERT_NEAR(points[i].y, before[i].y, 1e-3) << i;
    ASSERT_EQ(points[i].z, before[i].z) << i;
  }
}

TEST(Crs, GeographicAndSame) {
  EXPECT_TRUE(is_geographic("EPSG:4326"));
  EXPECT_TRUE(is_geographic("EPSG:4979"));  // 3D
  EXPECT_TRUE(is_geographic("urn:ogc:def:crs:OGC:1.3:CRS84"));
  EXPECT_FALSE(is_geographic("EPSG:7415"));
  EXPECT_TRUE(same_crs("EPSG:7415", "http://www.opengis.net/def/crs/EPSG/0/28992"));
  EXPECT_TRUE(same_crs("urn:ogc:def:crs:OGC:1.3:CRS84", "EPSG:4326"));
  EXPECT_TRUE(same_crs("urn:ogc:def:crs:EPSG::3946", "EPSG:3946"));
  EXPECT_FALSE(same_crs("EPSG:32632", "EPSG:32633"));
  EXPECT_FALSE(same_crs("EPSG:4326", "EPSG:3857"));
}

TEST(Crs, UtmZones) {
  EXPECT_EQ(utm_zone(15, 50), "EPSG:32633");
  EXPECT_EQ(utm_zone(11.999, 50), "EPSG:32632");
  EXPECT_EQ(utm_zone(12, 0), "EPSG:32633");
  EXPECT_EQ(utm_zone(-74, 40.7), "EPSG:32618");
  EXPECT_EQ(utm_zone(151.2, -33.9), "EPSG:32756");
  EXPECT_EQ(utm_zone(-180, 1), "EPSG:32601");
  EXPECT_EQ(utm_zone(180, 1), "EPSG:32601");
  EXPECT_EQ(utm_zone(179.9, 1), "EPSG:32660");
  EXPECT_NE(refusal([] { utm_zone(155000, 463000); }), "");
  EXPECT_NE(refusal([] { utm_zone(std::nan(""), 0); }), "");
}

TEST(Crs, UnknownOnesAreNamed) {
  for (const std::string& crs :
       {std::string("EPSG:999999"), std::string("nonsense"), std::string(""), std::string("PROJCS[\"cut"),
        std::string("EPSG:x\n4326"), std::string("http://example.invalid/crs.xml"),
        std::string("/etc/passwd"), std::string("@/etc/passwd"), std::string(100000, 'x')}) {
    const std::string what = refusal([&] { is_geographic(crs); });
    EXPECT_TRUE(what.starts_with("CRS: ")) << what << crs.substr(0, 40);
    EXPECT_NE(what.find("is not known"), std::string::npos) << what;
    EXPECT_LT(what.size(), 250u);
  }
  EXPECT_NE(refusal([] { CrsTransform("EPSG:4326", "EPSG:999999"); }).find("EPSG:999999"), std::string::npos);
  EXPECT_NE(refusal([] { is_geographic("EPSG:4978"); }).find("neither projected"), std::string::npos);
  EXPECT_NE(refusal([] { is_geographic("EPSG:5709"); }).find("neither projected"), std::string::npos);
}

// In a child, since PROJ keeps its search paths for good.
TEST(Crs, MissingDatabase) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto without_database = [] {
    setenv("PROJ_LIB", "/nonexistent", 1);
    const char* const nowhere[2] = {"/nonexistent", nullptr};
    OSRSetPROJSearchPaths(nowhere);
    fputs(refusal([] { is_geographic("EPSG:28992"); }).c_str(), stderr);
    exit(0);
  };
  EXPECT_EXIT(without_database(), testing::ExitedWithCode(0),
              "^CRS: EPSG:28992: PROJ's database proj.db is missing; [^\n]*$");
}

TEST(Crs, PointWithoutAPlace) {
  const std::string what = refusal([] { transformed("EPSG:4326", "EPSG:32633", {15, 95, 0}); });
  EXPECT_NE(what.find("(15.000000, 95.000000) has no place in EPSG:32633"), std::string::npos) << what;
  EXPECT_NE(refusal([] {
              transformed("EPSG:32633", "EPSG:4326", {std::numeric_limits<double>::infinity(), 0, 0});
            }),
            "");
}

TEST(Crs, ThreadsEachWithTheirOwn) {
  std::array<glm::dvec3, 4> points;
  std::vector<std::thread> threads;
  for (size_t i = 0; i < points.size(); ++i)
    threads.emplace_back([&, i] {
      for (int round = 0; round < 20; ++round)
        points[i] = transformed("EPSG:4326", "EPSG:32633", {15, 0, static_cast<double>(i)});
    });
  for (std::thread& thread : threads) thread.join();
  for (size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(points[i].x, 500000, 1e-6);
    EXPECT_EQ(points[i].z, static_cast<double>(i));
  }
}

TEST(Crs, UnitsOfProjectedOnes) {
  EXPECT_EQ(metres_per_unit("EPSG:28992"), 1);
  EXPECT_EQ(metres_per_unit("EPSG:7415"), 1) << "its flat part";
  EXPECT_EQ(metres_per_unit("EPSG:4326"), 1);
  EXPECT_NEAR(metres_per_unit("EPSG:2263"), 1200.0 / 3937, 1e-12) << "US survey feet";
  EXPECT_THROW(metres_per_unit("EPSG:1"), Error);
}

}  // namespace
}  // namespace veduta
