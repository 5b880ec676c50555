// A verification in the file: stored beside the cells, read with the same care.
#include "pvs/verification.h"

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "pvs/verification_columns.h"
#include "tests/pvs/small_verification.h"

namespace veduta {
namespace {

using test::TemporaryDirectory;

std::filesystem::path written_file(const TemporaryDirectory& directory) {
  const std::filesystem::path path = directory / "city.pvs.h5";
  write_pvs(path, test::small_city(), test::small_header(), test::small_row);
  return path;
}

TEST(Verification, ReadsAsStoredAndLeavesTheCellsAlone) {
  const TemporaryDirectory directory;
  const std::filesystem::path path = written_file(directory);
  const PvsFile before = read_pvs(path);
  EXPECT_FALSE(before.verification);
  const Verification stored = test::small_verification();
  store_verification(path, before, stored);
  const PvsFile after = read_pvs(path);
  ASSERT_TRUE(after.verification);
  EXPECT_EQ(*after.verification, stored);
  EXPECT_EQ(after.content_digest, before.content_digest);
  EXPECT_EQ(after.entries, before.entries);
  EXPECT_EQ(after.overestimate, before.overestimate);
  EXPECT_EQ(after.header.config, before.header.config);
  EXPECT_FALSE(stored.passed());
  EXPECT_EQ(stored.rays(), 5000u);
  EXPECT_EQ(stored.cells_without_eye(), 1u);
  for (const auto& entry : std::filesystem::directory_iterator(directory.path()))
    EXPECT_EQ(entry.path(), path) << "left behind";
}

TEST(Verification, StoringAgainReplaces) {
  const TemporaryDirectory directory;
  const std::filesystem::path path = written_file(directory);
  const PvsFile file = read_pvs(path);
  Verification v = test::small_verification();
  store_verification(path, file, v);
  const auto size = std::filesystem::file_size(path);
  for (int i = 0; i < 20; ++i) {
    v.seed = 100 + static_cast<uint64_t>(i);
    v.witnesses = test::small_verification().witnesses;
    v.witnesses.resize(static_cast<size_t>(i % 3));
    store_verification(path, read_pvs(path), v);
  }
  EXPECT_EQ(*read_pvs(path).verification, v);
  // HDF5 uses most of the room again, and loses some.
  EXPECT_LT(std::filesystem::file_size(path), size + 20 * 4096) << "grows with each";
  v = {}, v.when = "2026-01-31T12:00:00Z";  // nothing checked
  store_verification(path, file, v);
  EXPECT_EQ(*read_pvs(path).verification, v);
  EXPECT_FALSE(v.passed());
}

TEST(Verification, FollowsALinkAndKeepsIt) {
  const TemporaryDirectory directory;
  const std::filesystem::path path = written_file(directory), link = directory / "link.h5";
  std::filesystem::create_symlink(path, link);
  store_verification(link, read_pvs(link), test::small_verification());
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_TRUE(read_pvs(path).verification);
}

/// What was verified has to be what is in the file.
TEST(Verification, RefusesAnotherCity) {
  const TemporaryDirectory directory;
  const std::filesystem::path path = written_file(directory);
  const PvsFile checked = read_pvs(path);
  write_pvs(path, test::small_city(), test::small_header(),
            [](uint32_t c) { return test::small_row(c + 1); });
  const std::string bytes = test::read_bytes(path);
  std::string message;
  EXPECT_EQ(test::status_of([&] { store_verification(path, checked, test::small_verification()); }, &message),
            ExitStatus::bad_input);
  EXPECT_NE(message.find("verify again"), std::string::npos) << message;
  EXPECT_EQ(test::read_bytes(path), bytes);
  EXPECT_EQ(test::status_of([&] { store_verification(directory / "none.h5", checked, {}); }),
            ExitStatus::bad_input);
}

/// A verification copied into the file of another city is found out.
TEST(Verification, BelongsToItsContent) {
  const TemporaryDirectory directory;
  const std::filesystem::path path = directory / "alone.h5";
  {
    hdf5::Output output(path);
    ColumnDigests digests;
    write_verification(output, test::small_verification(), "digest of one city", digests);
    output.close();
  }
  const hdf5::Input input(path);
  EXPECT_EQ(read_verification(input, "digest of one city"), test::small_verification());
  std::string message;
  EXPECT_EQ(test::status_of([&] { read_verification(input, "digest of another"); }, &message),
            ExitStatus::bad_input);
  EXPECT_NE(message.find("/verification: "), std::string::npos) << message;
}

TEST(Verification, NumbersFitTheCity) {
  const City city = test::small_city();
  EXPECT_EQ(find_defect(test::small_verification(), city.cells.size(), city.scene.objects), std::nullopt);
  EXPECT_EQ(find_defect(Verification{}, city.cells.size(), city.scene.objects), std::nullopt);
  const auto refused = [&](const char* place, const std::function<void(Verification&)>& change) {
    Verification v = test::small_verification();
    change(v);
    const auto defect = find_defect(v, city.cells.size(), city.scene.objects);
    ASSERT_TRUE(defect) << place;
    EXPECT_EQ(defect->rfind(place, 0), 0u) << *defect;
    EXPECT_NE(defect->find(": "), std::string::npos) << *defect;
  };
  refused("/verification@when", [](Verification& v) { v.when = "now\n"; });
  refused("/verification@program", [](Verification& v) { v.program = std::string(65, 'x'); });
  refused("/verification", [](Verification& v) { v.overestimate_buildings = NAN; });
  refused("/verification", [](Verification& v) { v.narrow_gap_limit_m = -1; });
  refused("/verification", [](Verification& v) { v.false_invisible_solid_angle_worst = 1.01; });
  refused("/verification/cells/cell", [](Verification& v) { v.cells[2].cell = 7; });
  refused("/verification/cells/cell", [](Verification& v) { v.cells[2].cell = v.cells[1].cell; });
  refused("/verification/cells/objects", [](Verification& v) { v.cells[0].seen_objects = 7; });
  refused("/verification/cells/objects", [](Verification& v) { v.cells[0].narrow_gap_objects = UINT64_MAX; });
  refused("/verification/cells/triangles", [](Verification& v) { v.cells[0].pvs_triangles = 6; });
  refused("/verification/cells/solid_angle",
          [](Verification& v) { v.cells[0].false_invisible_solid_angle = NAN; });
  refused("/verification/examples/cell", [](Verification& v) { v.witnesses[0].cell = 7; });
  refused("/verification/examples/object", [](Verification& v) { v.witnesses[0].object = 6; });
  refused("/verification/examples/triangle", [](Verification& v) { v.witnesses[0].triangle = 4; });
  refused("/verification/examples/triangle", [](Verification& v) { v.witnesses[0].object = 5; });  // has none
  refused("/verification/examples/ray", [](Verification& v) { v.witnesses[0].eye.x = NAN; });
  refused("/verification/examples/ray", [](Verification& v) { v.witnesses[0].direction = {0, 0, 0}; });
  refused("/verification/examples/gap", [](Verification& v) { v.witnesses[1].gap_m = -1; });
  // And nothing of the kind is written.
  const TemporaryDirectory directory;
  const std::filesystem::path path = written_file(directory);
  Verification v = test::small_verification();
  v.cells[2].cell = 7;
  EXPECT_EQ(test::status_of([&] { store_verification(path, read_pvs(path), v); }), ExitStatus::defect);
  EXPECT_FALSE(read_pvs(path).verification);
}

/// Digests hold over anything: a reader asks for ranges as well.
TEST(Verification, RangesAreCheckedOnReading) {
  const TemporaryDirectory directory;
  const std::filesystem::path path = written_file(directory);
  const std::string digest = read_pvs(path).content_digest;
  Verification v = test::small_verification();
  v.witnesses[0].triangle = 4;
  {
    hdf5::Output output(path, hdf5::Output::Start::go_on);
    ColumnDigests digests;
    write_verification(output, v, digest, digests);
    output.close();
  }
  std::string message;
  EXPECT_EQ(test::status_of([&] { read_pvs(path); }, &message), ExitStatus::bad_input);
  EXPECT_NE(message.find("/verification/examples/triangle: 4 is not of object 3"), std::string::npos)
      << message;
}

TEST(Verification, Described) {
  const TemporaryDirectory directory;
  const std::filesystem::path path = written_file(directory);
  EXPECT_NE(describe(read_pvs(path), path).find("verified   no"), std::string::npos);
  EXPECT_TRUE(nlohmann::json::parse(describe_json(read_pvs(path), path))["verification"].is_null());
  store_verification(path, read_pvs(path), test::small_verification());
  const std::string text = describe(read_pvs(path), path);
  EXPECT_NE(text.find("2026-01-31T12:00:00Z FAILED: 3 of 7 cells, 5000 rays, seed 9"), std::string::npos)
      << text;
  EXPECT_NE(text.find("--witness 0"), std::string::npos) << text;
  const auto json = nlohmann::json::parse(describe_json(read_pvs(path), path))["verification"];
  EXPECT_EQ(json["passed"], false);
  EXPECT_EQ(json["rays"], 5000);
  EXPECT_EQ(json["examples"].size(), 2u);
  EXPECT_EQ(json["examples"][1]["gap_m"], 0.25);
}

}  // namespace
}  // namespace veduta
