// The last step of the preparation, killed at any time and done again.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "pvs/pvs_file.h"
#include "tests/pvs/small_city.h"
#include "worker/preparation.h"

namespace veduta {
namespace {

using test::read_bytes;
using test::TemporaryDirectory;
namespace fs = std::filesystem;

/// A wall on a plain, with 1,000 files more than it needs in prepared.tmp/, so that removing them takes a
/// while.
class PreparationFinish : public testing::Test {
 protected:
  PreparationFinish() {
    std::ofstream(directory / "city.obj")
        << "o ground\nv -20 -20 0\nv 20 -20 0\nv 20 20 0\nv -20 20 0\nf 1 2 3 4\n"
           "o wall\nv -9 0 0\nv 9 0 0\nv 9 0 6\nv -9 0 6\nf 5 6 7 8\n";
    settings.scene.model = {(directory / "city.obj").string()};
    settings.cells.size_m = 4;
  }
  /// In a child, so that this process has no threads when it forks. \return its process.
  template <typename Work>
  static pid_t begin(const Work& work) {
    const pid_t child = fork();
    if (child != 0) return child;
    work();
    _exit(0);
  }
  void prepare_up_to_the_finish() {
    waitpid(begin([&] {
              prepare_all(run, settings, [](const std::string& stage, uint32_t, uint32_t) {
                if (stage == "finish") _exit(0);
              });
            }),
            nullptr, 0);
    for (int i = 0; i < 1000; ++i)
      std::ofstream(directory / "prepared.tmp/cells" / ("more" + std::to_string(i)));
  }
  bool left() const { return fs::exists(directory / "prepared.tmp"); }

  TemporaryDirectory directory;
  RunPaths run{directory.path()};
  Settings settings;
};

TEST_F(PreparationFinish, MayBeKilledWheneverAndDoneAgain) {
  prepare_up_to_the_finish();
  fs::copy(directory / "prepared.tmp", directory / "kept", fs::copy_options::recursive);
  const PreparedSize size = finish_preparation(run, settings);
  const auto city = read_bytes(run.city()), occluders = read_bytes(run.occluders());
  EXPECT_GT(size.cells, 10u);
  EXPECT_FALSE(left());

  int while_it_removed = 0;
  for (int kills = 0; kills < 20; ++kills) {
    fs::remove_all(run.prepared());
    fs::remove_all(directory / "prepared.tmp");
    fs::copy(directory / "kept", directory / "prepared.tmp", fs::copy_options::recursive);
    const pid_t child = begin([&] { finish_preparation(run, settings); });
    while (!fs::exists(run.city()) && waitpid(child, nullptr, WNOHANG) == 0) {
    }
    std::this_thread::sleep_for(std::chrono::microseconds(100 * kills));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    while_it_removed += left() && !fs::exists(directory / "prepared.tmp/plan.json");
    const PreparedSize again = finish_preparation(run, settings);
    EXPECT_EQ(again.cells, size.cells);
    EXPECT_EQ(again.objects, size.objects);
    EXPECT_EQ(again.triangles, size.triangles);
    EXPECT_EQ(read_bytes(run.city()), city);
    EXPECT_EQ(read_bytes(run.occluders()), occluders);
    EXPECT_FALSE(left());
  }
  RecordProperty("killed_while_it_removed", while_it_removed);
}

// What the loop above may miss by bad luck: nothing of the plan, some of the rest.
TEST_F(PreparationFinish, KnowsThatItIsDoneByThePlan) {
  prepare_up_to_the_finish();
  const PreparedSize size = finish_preparation(run, settings);
  fs::create_directories(directory / "prepared.tmp/cells");
  std::ofstream(directory / "prepared.tmp/cells/0") << "left";
  const PreparedSize again = finish_preparation(run, settings);
  EXPECT_EQ(again.cells, size.cells);
  EXPECT_EQ(again.triangles, size.triangles);
  EXPECT_FALSE(left());
}

}  // namespace
}  // namespace veduta
