// The steps of the preparation as the farm has them done: any number of workers, any order, the same bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <random>
#include <thread>

#include "farm/preparation_book.h"
#include "tests/pvs/small_city.h"
#include "worker/preparation.h"

namespace veduta {
namespace {

namespace fs = std::filesystem;

/// An OBJ file of a street: row houses, a hall with one side open, a passage under a house, a courtyard.
class Street {
 public:
  explicit Street(const fs::path& file) : out_(file) {
    out_ << "o ground\n";
    quad({-31, -23, 0}, {33, -23, 0}, {33, 27, 0}, {-31, 27, 0});
    for (int house = 0; house < 6; ++house) {
      const auto x = -25.0 + 7 * house;
      box({x, -14, 0}, {x + 7, -4, 6.0 + house % 3});
    }
    out_ << "o hall\n";
    quad({-20, 6, 5}, {-2, 6, 5}, {-2, 18, 5}, {-20, 18, 5});
    quad({-20, 6, 0}, {-20, 18, 0}, {-20, 18, 5}, {-20, 6, 5});
    quad({-20, 18, 0}, {-2, 18, 0}, {-2, 18, 5}, {-20, 18, 5});
    quad({-20, 6, 0}, {-2, 6, 0}, {-2, 6, 5}, {-20, 6, 5});
    box({4, 5, 3.5}, {12, 20, 9});  // above a passage
    box({4, 5, 0}, {6, 20, 3.5});
    box({10, 5, 0}, {12, 20, 3.5});
    box({16, 4, 0}, {30, 7, 8});
    box({16, 17, 0}, {30, 20, 8});
    box({16, 7, 0}, {19, 17, 8});
    box({27, 7, 0}, {30, 17, 8});
  }

 private:
  using Point = std::array<double, 3>;
  void quad(const Point& a, const Point& b, const Point& c, const Point& d) {
    for (const Point& p : {a, b, c, d}) out_ << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    out_ << "f -4 -3 -2 -1\n";
  }
  void box(const Point& l, const Point& u) {
    out_ << "o box" << ++boxes_ << '\n';
    quad({l[0], l[1], u[2]}, {u[0], l[1], u[2]}, {u[0], u[1], u[2]}, {l[0], u[1], u[2]});
    quad({l[0], l[1], l[2]}, {l[0], u[1], l[2]}, {u[0], u[1], l[2]}, {u[0], l[1], l[2]});
    quad({l[0], l[1], l[2]}, {u[0], l[1], l[2]}, {u[0], l[1], u[2]}, {l[0], l[1], u[2]});
    quad({u[0], u[1], l[2]}, {l[0], u[1], l[2]}, {l[0], u[1], u[2]}, {u[0], u[1], u[2]});
    quad({l[0], u[1], l[2]}, {l[0], l[1], l[2]}, {l[0], l[1], u[2]}, {l[0], u[1], u[2]});
    quad({u[0], l[1], l[2]}, {u[0], u[1], l[2]}, {u[0], u[1], u[2]}, {u[0], l[1], u[2]});
  }
  std::ofstream out_;
  int boxes_ = 0;
};

class PreparationOrders : public testing::Test {
 protected:
  PreparationOrders() {
    Street(directory_.path() / "street.obj");
    settings_.scene.model = {directory_.path() / "street.obj"};
    settings_.navigation.seed_size_m = 0.25;
    settings_.cells.size_m = 6;
    settings_.occlusion.resolution = 128, settings_.occlusion.subdivide = 2;
  }

  /// Prepares with so many workers on threads of their own. Before a part is begun, some are given back,
  /// which shuffles the order. \return the files of prepared/ and what is in them.
  std::map<std::string, std::string> prepare(const std::string& name, int workers, uint32_t seed) {
    const RunPaths run{directory_.path() / name};
    fs::create_directories(run.directory);
    std::mutex mutex;
    std::mt19937 random(seed);
    PreparationBook book;
    runs_ = 0;
    const auto work = [&](int number) {
      const WorkerId worker{0, number};
      std::unique_lock lock(mutex);
      while (!book.complete()) {
        const auto part = book.grant(worker);
        if (!part || (seed != 0 && random() % 2 == 0)) {
          book.lost(worker, false);
          lock.unlock();
          std::this_thread::yield();
          lock.lock();
          continue;
        }
        lock.unlock();
        std::vector<uint32_t> again;
        PreparationSize size;
        do_part(run, *part, again, size);
        lock.lock();
        ++runs_;
        if (part->stage == Stage::import) book.set_size(size.tiles, size.blocks), tiles_ = size.tiles;
        book.done(worker, again);
      }
    };
    std::vector<std::thread> threads;
    for (int number = 0; number < workers; ++number) threads.emplace_back(work, number);
    for (std::thread& thread : threads) thread.join();
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(run.prepared()))
      files[entry.path().filename()] = test::read_bytes(entry.path());
    return files;
  }

  void do_part(const RunPaths& run, const PreparationPart& part, std::vector<uint32_t>& again,
               PreparationSize& size) const {
    switch (part.stage) {
      case Stage::import:
        size = import_city(run, settings_, sizes_);
        break;
      case Stage::flood:
        again = flood_tile(run, part.part);
        break;
      case Stage::cells:
        make_tile_cells(run, settings_, part.part);
        break;
      case Stage::shrink:
        shrink_block(run, settings_, part.part);
        break;
      case Stage::finish:
        finish_preparation(run, settings_);
        break;
    }
  }

  test::TemporaryDirectory directory_;
  Settings settings_;
  PartSizes sizes_{16, 1};
  uint32_t tiles_ = 0, runs_ = 0;
};

TEST_F(PreparationOrders, AnyWorkersAndOrdersGiveTheSameBytes) {
  const auto expected = prepare("in order", 1, 0);
  ASSERT_TRUE(expected.contains("city.h5") && expected.contains("occluder_clusters.bin"));
  EXPECT_GT(tiles_, 8u);
  const uint32_t runs_in_order = runs_;
  std::vector<uint32_t> runs;
  for (const int workers : {1, 2, 4})
    for (uint32_t seed = 1; seed <= 3; ++seed) {
      const auto files = prepare(std::to_string(workers) + "-" + std::to_string(seed), workers, seed);
      ASSERT_EQ(files.size(), expected.size());
      for (const auto& [file, bytes] : expected)
        EXPECT_TRUE(files.at(file) == bytes) << file << " of " << workers << " workers, order " << seed;
      runs.push_back(runs_);
    }
  EXPECT_TRUE(std::any_of(runs.begin(), runs.end(), [&](uint32_t count) { return count != runs_in_order; }))
      << "the order made no difference to the flood";
}

}  // namespace
}  // namespace veduta
