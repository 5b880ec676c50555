// That the judge of the hard cases can find fault: rows that were right, spoilt by little.
#include <gtest/gtest.h>

#include <algorithm>

#include "gl/egl_context.h"
#include "scene/error.h"
#include "tests/hard/hard_case.h"

namespace veduta::hard {
namespace {

class SpoiltRows : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    try {
      EglContext("software");
    } catch (const Error&) {
      GTEST_SKIP() << "no EGL device with OpenGL 4.3 here";
    }
    case_ = read_case(std::filesystem::path(VEDUTA_TEST_CASES) / GetParam());
    file_ = bake_case(prepare_case(case_.settings), case_.settings, "panorama");
    reference_.emplace(read_exact_model(case_.settings.scene.model.front(), 1),
                       places_of_eyes(case_, file_.city));
    seen_ = look_from_cells(*reference_, case_, file_);
  }

  size_t complaints(const PvsFile& file) const { return judge(file, *reference_, seen_).wrong.size(); }

  HardCase case_;
  PvsFile file_;
  std::optional<ExactReference> reference_;
  std::vector<CellSightings> seen_;
};

TEST_P(SpoiltRows, AnEntryThatIsDroppedIsMissed) {
  ASSERT_EQ(complaints(file_), 0u);
  size_t dropped = 0;
  for (PvsEntry& entry : file_.entries) {
    const std::string& name = file_.city.scene.objects[entry.object].name;
    if (std::ranges::count(case_.seen, name) == 0) continue;  // it may be seen by nobody
    const PvsEntry whole = entry;
    entry.index = {};
    EXPECT_GT(complaints(file_), 0u) << name;
    entry = whole;
    ++dropped;
  }
  EXPECT_GE(dropped, case_.seen.size());
}

// Bytes are as tight as the bake makes them, so that one step less leaves out something that is seen, often
// enough.
TEST_P(SpoiltRows, AByteThatIsTighterByOneIsMissed) {
  size_t spoilt = 0, missed = 0;
  for (PvsEntry& entry : file_.entries) {
    const PvsEntry whole = entry;
    const SliceCounts slices = file_.city.slices[entry.object];
    if (whole.index.z >= 1 && whole.index.z < slices.z) {
      ++entry.index.z;
      ++spoilt, missed += complaints(file_) > 0;
      entry = whole;
    }
    for (int8_t VisibilityIndex::*byte : {&VisibilityIndex::x, &VisibilityIndex::y}) {
      if (whole.index.*byte == 0) continue;
      entry.index.*byte = static_cast<int8_t>(whole.index.*byte - 1);  // +k and -k alike
      ++spoilt, missed += complaints(file_) > 0;
      entry = whole;
    }
  }
  EXPECT_GT(missed, 0u) << "of " << spoilt;
}

INSTANTIATE_TEST_SUITE_P(Cases, SpoiltRows, testing::Values("spikes", "far_coordinates", "t_junctions"),
                         [](const auto& folder) { return folder.param; });

}  // namespace
}  // namespace veduta::hard
