// What is refused, and that nothing is left behind by it.
#include "export/export.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/export/toy_result.h"

#ifdef __SANITIZE_ADDRESS__
/// HDF5 1.10 leaks when it refuses a file. Our own leaks are still found.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5";
}
#endif

namespace veduta {
namespace {

using test::status_of;
using test::TemporaryDirectory;

size_t files_in(const TemporaryDirectory& directory) {
  const std::filesystem::directory_iterator entries(directory.path());
  return static_cast<size_t>(std::distance(begin(entries), end(entries)));
}

TEST(Export, RefusesWhatItCannotWrite) {
  std::string message;
  EXPECT_EQ(status_of([] { check_exportable("a.blend", true); }, &message), ExitStatus::usage);
  EXPECT_NE(message.find(".jsonl"), std::string::npos);
  EXPECT_EQ(status_of([] { check_exportable("noextension", true); }), ExitStatus::usage);
  for (const char* const name : {"a.obj", "a.gltf", "a.glb", "a.svg"}) {
    EXPECT_EQ(status_of([&] { check_exportable(name, false); }, &message), ExitStatus::usage);
    EXPECT_NE(message.find("--cell"), std::string::npos);
    EXPECT_EQ(status_of([&] { check_exportable(name, true); }), ExitStatus::done);
  }
  EXPECT_EQ(status_of([] { check_exportable("A.JSONL", false); }), ExitStatus::done);
}

TEST(Export, FindsCells) {
  TemporaryDirectory directory;
  test::write_toy_result(directory / "city.pvs.h5");
  const PvsStream stream(directory / "city.pvs.h5");
  const PvsIndex& index = stream.index();
  EXPECT_EQ(cell_of_number(index, 2), 2u);
  EXPECT_EQ(cell_at(index, {15, -5, 1.5f}), 1u);
  EXPECT_EQ(cell_at(index, {10, -5, 1.5f}), 0u) << "on a shared face";
  std::string message;
  EXPECT_EQ(status_of([&] { cell_of_number(index, 3); }, &message), ExitStatus::usage);
  EXPECT_EQ(message, "cell 3: the file has cells 0 to 2; name one of them");
  EXPECT_EQ(status_of([&] { cell_of_number(index, UINT64_MAX); }), ExitStatus::usage);
  EXPECT_EQ(status_of([&] { cell_at(index, {33, -5, 6}); }, &message), ExitStatus::usage);
  EXPECT_EQ(message, "(33, -5, 6): lies in no cell; the nearest is cell 2, 5 m away");
  for (const float x : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
    EXPECT_EQ(status_of([&] { cell_at(index, {x, 0, 0}); }), ExitStatus::usage);
}

TEST(Export, OfAFileWithoutCells) {
  TemporaryDirectory directory;
  write_pvs(directory / "city.pvs.h5", test::small_city(3, 0), test::small_header(), test::small_row);
  const PvsStream stream(directory / "city.pvs.h5");
  EXPECT_EQ(status_of([&] { cell_of_number(stream.index(), 0); }), ExitStatus::usage);
  EXPECT_EQ(status_of([&] { cell_at(stream.index(), {0, 0, 0}); }), ExitStatus::usage);
  EXPECT_EQ(export_result(stream, {}, directory / "city.jsonl").cells, 0u);
}

/// One bit is turned over, anywhere in the file: whatever it is, an export fails by an Error
/// and leaves nothing, or has the bytes of the export of the whole file.
TEST(Export, OfDamagedFilesLeavesNothingOrTheSame) {
  TemporaryDirectory directory;
  test::write_toy_result(directory / "city.pvs.h5");
  const std::string whole = test::read_bytes(directory / "city.pvs.h5");
  std::map<std::string, std::string> expected;
  for (const char* const name : {"a.obj", "a.gltf", "a.glb", "a.svg", "a.jsonl"}) {
    export_result(PvsStream(directory / "city.pvs.h5"), 1, directory / name);
    expected[name] = test::read_bytes(directory / name);
    std::filesystem::remove(directory / name);
  }
  std::filesystem::remove(directory / "a.mtl");
  size_t refused = 0;
  for (size_t at = 7; at < whole.size(); at += whole.size() / 50) {
    SCOPED_TRACE(at);
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    test::write_bytes(directory / "city.pvs.h5", damaged);
    for (const auto& [name, bytes] : expected) {
      const ExitStatus status =
          status_of([&] { export_result(PvsStream(directory / "city.pvs.h5"), 1, directory / name); });
      if (status == ExitStatus::done) {
        EXPECT_EQ(test::read_bytes(directory / name), bytes);
        std::filesystem::remove(directory / name);
        std::filesystem::remove(directory / "a.mtl");
      } else {
        EXPECT_EQ(status, ExitStatus::bad_input);
        ++refused;
      }
      EXPECT_EQ(files_in(directory), 1u);
    }
  }
  EXPECT_GT(refused, 30u);
}

TEST(Export, KeepsTheOldFileWhereItFails) {
  TemporaryDirectory directory;
  test::write_toy_result(directory / "city.pvs.h5");
  const PvsStream stream(directory / "city.pvs.h5");
  std::filesystem::create_directory(directory / "a.obj");
  EXPECT_EQ(status_of([&] { export_result(stream, 1, directory / "a.obj"); }), ExitStatus::input_output);
  EXPECT_EQ(status_of([&] { export_result(stream, 1, directory / "missing" / "a.glb"); }),
            ExitStatus::input_output);
}

}  // namespace
}  // namespace veduta
