// Every folder of tests/cases with a case.toml: imported, prepared, baked by every method, and held against
// the exact reference. docs/hard-cases.md says what each is about.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "gl/egl_context.h"
#include "scene/error.h"
#include "tests/hard/generated_scenes.h"
#include "tests/hard/hard_case.h"
#include "worker/preparation.h"

namespace veduta::hard {
namespace {

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& folder : std::filesystem::directory_iterator(VEDUTA_TEST_CASES))
    if (std::filesystem::exists(folder.path() / "case.toml"))
      all.push_back(folder.path().filename().string());
  std::sort(all.begin(), all.end());
  return all;
}

bool gl_is_here() {
  try {
    EglContext("software");
    return true;
  } catch (const Error&) {
    return false;
  }
}

class HardCases : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    case_ = read_case(std::filesystem::path(VEDUTA_TEST_CASES) / GetParam());
    if (case_.generated.empty()) return;
    case_.settings.scene.model = {(directory_ / "city.obj").string()};
    write_generated_scene(case_.generated, directory_ / "city.obj");
  }

  void expect_refused() {
    std::string message;
    EXPECT_EQ(test::status_of([&] { prepare_all(RunPaths{directory_.path()}, case_.settings); }, &message),
              ExitStatus::bad_input);
    EXPECT_NE(message.find(case_.refused), std::string::npos) << message;
  }

  /// With what the case says is seen and hidden: that it is not blind.
  void expect_reference_agrees(const ExactReference& reference, const std::vector<CellSightings>& seen) {
    const auto sighted = [&](const std::string& name) {
      const auto shows = [&](const Sighting& s) {
        const auto of = [&](uint32_t t) {
          return reference.model().objects[reference.model().triangles[t].object] == name;
        };
        return !s.through_gap && std::ranges::any_of(s.sight.triangles, of);
      };
      return std::ranges::any_of(
          seen, [&](const CellSightings& c) { return std::ranges::any_of(c.sightings, shows); });
    };
    for (const std::string& name : case_.seen)
      EXPECT_TRUE(sighted(name)) << "the reference sees nothing of " << name;
    for (const std::string& name : case_.hidden) EXPECT_FALSE(sighted(name)) << "the reference sees " << name;
  }

  HardCase case_;
  test::TemporaryDirectory directory_;
};

TEST_P(HardCases, NothingSeenIsLeftOut) {
  SCOPED_TRACE(case_.hard);
  ASSERT_FALSE(case_.hard.empty()) << "case.hard: a sentence on what makes it hard";
  if (!case_.refused.empty()) return expect_refused();
  if (!gl_is_here()) GTEST_SKIP() << "no EGL device with OpenGL 4.3 here";
  const double unit = case_.settings.scene.unit_m > 0 ? case_.settings.scene.unit_m : 1;
  const PreparedCase prepared = prepare_case(case_.settings);
  const ExactReference reference(read_exact_model(case_.settings.scene.model.front(), unit),
                                 places_of_eyes(case_, prepared.city));
  std::vector<CellSightings> seen;
  for (const std::string method : {"panorama", "zoom"}) {
    SCOPED_TRACE(method);
    const PvsFile file = bake_case(prepared, case_.settings, method);
    if (seen.empty()) {
      seen = look_from_cells(reference, case_, file);
      expect_reference_agrees(reference, seen);
    }
    ASSERT_FALSE(seen.empty()) << "no cell has a certain eye";
    const Verdict verdict = judge(file, reference, seen);
    if (!case_.known_fault.empty()) {
      EXPECT_FALSE(verdict.wrong.empty()) << "mended: take known_fault out of case.toml";
      std::cout << method << ", known fault: " << verdict.wrong.size() << " left out: " << case_.known_fault
                << "\n";
      continue;
    }
    for (size_t n = 0; n < std::min<size_t>(verdict.wrong.size(), 5); ++n) ADD_FAILURE() << verdict.wrong[n];
    EXPECT_EQ(verdict.wrong.size(), 0u);
    for (const std::string& text : verdict.through_gaps)
      std::cout << method << ", through a gap that may close: " << text << "\n";
    for (const CellSightings& from : seen) {
      EXPECT_FALSE(from.sightings.empty());
      for (const std::string& name : case_.hidden)
        EXPECT_FALSE(lists(file, from.cell, name)) << name << " in the row of cell " << from.cell;
      for (const std::string& name : case_.seen)
        EXPECT_TRUE(lists(file, from.cell, name)) << name << " not in the row of cell " << from.cell;
    }
  }
}

TEST(HardCaseTable, NamesEveryCase) {
  const std::string table =
      test::read_bytes(std::filesystem::path(VEDUTA_TEST_CASES) / "../../docs/hard-cases.md");
  for (const std::string& name : names())
    EXPECT_NE(table.find("| `" + name + "` |"), std::string::npos) << name << " is not in docs/hard-cases.md";
}

INSTANTIATE_TEST_SUITE_P(Cases, HardCases, testing::ValuesIn(names()),
                         [](const auto& folder) { return folder.param; });

}  // namespace
}  // namespace veduta::hard
