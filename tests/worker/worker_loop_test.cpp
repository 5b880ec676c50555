// The worker's side of the protocol, spoken over pipes as a shepherd does.
#include "worker/worker_loop.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <deque>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "pvs/shard.h"
#include "scene/error.h"
#include "worker/protocol.h"

namespace veduta {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A run directory with a configuration, and a worker on a thread at the other end of two pipes.
class WorkerLoop : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = fs::temp_directory_path() / ("veduta_loop_" + std::to_string(getpid()));
    fs::remove_all(directory_);
    fs::create_directories(directory_);
    std::ofstream(directory_ / "city.obj")
        << "o ground\nv -30 -30 0\nv 30 -30 0\nv 30 30 0\nv -30 30 0\nf 1 2 3 4\n"
           "o wall\nv 10 -20 0\nv 10 20 0\nv 10 20 9\nv 10 -20 9\nf 5 6 7 8\n";
    std::ofstream(directory_ / "run.toml")
        << "[scene]\nmodel = '" << (directory_ / "city.obj").string() << "'\n[cells]\nsize = 6.0\n"
        << "region = [-9.0, -9.0, 9.0, 9.0]\n[occlusion]\nresolution = 128\nsubdivide = 2\n";
    ASSERT_EQ(pipe(to_worker_), 0);
    ASSERT_EQ(pipe(from_worker_), 0);
    worker_ = std::thread([this] {
      status_ = run_worker(to_worker_[0], from_worker_[1], "software");
      close(from_worker_[1]);
    });
    const std::optional<Frame> hello = read_frame(from_worker_[0]);
    ASSERT_TRUE(hello);
    EXPECT_EQ(hello->verb, Verb::hello);
  }
  void TearDown() override {
    hang_up();
    if (worker_.joinable()) worker_.join();
    for (const int end : {to_worker_[0], from_worker_[0]}) close(end);
    fs::remove_all(directory_);
  }

  void hang_up() {
    if (to_worker_[1] >= 0) close(to_worker_[1]);
    to_worker_[1] = -1;
  }
  void say(Verb verb, const std::string& payload) { write_frame(to_worker_[1], encode_frame(verb, payload)); }
  std::string in_directory() const { return "{\"directory\": \"" + directory_.string() + "\"}"; }

  Frame hear() {
    std::optional<Frame> frame = read_frame(from_worker_[0]);
    if (!frame) throw std::runtime_error("the worker left");
    return *frame;
  }
  /// The answer to a part of the preparation.
  Frame prepare(Stage stage, uint32_t part) {
    say(Verb::prepare,
        json{{"directory", directory_.string()}, {"stage", name_of(stage)}, {"part", part}, {"threads", 2}}
            .dump());
    return hear();
  }
  /// The whole preparation, as a coordinator with one worker has it done. \return the first answer that is
  /// not `prepared`, or the last answer.
  Frame prepare_all() {
    uint32_t tiles = 0, blocks = 0;
    for (std::deque<std::pair<Stage, uint32_t>> parts{{Stage::import, 0}};;) {
      const auto [stage, part] = parts.front();
      parts.pop_front();
      Frame frame = prepare(stage, part);
      if (frame.verb != Verb::prepared || stage == Stage::finish) return frame;
      const json answer = json::parse(frame.text());
      if (stage == Stage::import) tiles = answer.at("tiles"), blocks = answer.at("blocks");
      for (const uint32_t tile : answer.value("again", std::vector<uint32_t>()))
        parts.emplace_back(Stage::flood, tile);
      for (Stage next = stage; parts.empty();) {
        next = static_cast<Stage>(static_cast<uint32_t>(next) + 1);
        const uint32_t count = next == Stage::finish ? 1 : next == Stage::shrink ? blocks : tiles;
        for (uint32_t each = 0; each < count; ++each) parts.emplace_back(next, each);
      }
    }
  }
  int leave() {
    hang_up();
    worker_.join();
    return status_;
  }

  fs::path directory_;
  int to_worker_[2] = {-1, -1}, from_worker_[2] = {-1, -1};
  std::thread worker_;
  int status_ = -1;
};

TEST_F(WorkerLoop, PreparesOpensAndBakes) {
  const Frame prepared = prepare_all();
  ASSERT_EQ(prepared.verb, Verb::prepared) << prepared.text();
  say(Verb::open, in_directory());
  const Frame opened = hear();
  if (opened.verb == Verb::failed) GTEST_SKIP() << "no EGL here: " << opened.text();
  ASSERT_EQ(opened.verb, Verb::opened) << opened.text();
  say(Verb::bake, "{\"cells\": [1, 0]}");
  for (const uint32_t cell : {1u, 0u}) {
    const Frame baked = hear();
    ASSERT_EQ(baked.verb, Verb::cell_baked) << baked.text();
    const CellRecord record = decode_cell_record(baked.payload.data(), baked.payload.size());
    EXPECT_EQ(record.cell, cell);
    EXPECT_FALSE(record.row.empty()) << "the wall is in plain sight";
  }
  EXPECT_EQ(hear().verb, Verb::lease_done);
  EXPECT_EQ(leave(), 0);
}

TEST_F(WorkerLoop, SaysWhatIsWrongWithAModel) {
  fs::remove(directory_ / "city.obj");
  const Frame failed = prepare_all();
  ASSERT_EQ(failed.verb, Verb::failed);
  EXPECT_NE(failed.text().find("city.obj"), std::string::npos) << failed.text();
  EXPECT_EQ(leave(), static_cast<int>(ExitStatus::bad_input));
  EXPECT_FALSE(fs::exists(directory_ / "prepared")) << "nothing half-written";
}

TEST_F(WorkerLoop, RefusesDamagedOccluders) {
  ASSERT_EQ(prepare_all().verb, Verb::prepared);
  fs::resize_file(directory_ / "prepared" / "occluder_clusters.bin", 20);
  say(Verb::open, in_directory());
  const Frame failed = hear();
  ASSERT_EQ(failed.verb, Verb::failed);
  EXPECT_NE(failed.text().find("occluder_clusters.bin"), std::string::npos) << failed.text();
  EXPECT_EQ(leave(), static_cast<int>(ExitStatus::bad_input));
}

TEST_F(WorkerLoop, BakeBeforeOpenIsADefectOfTheShepherd) {
  say(Verb::bake, "{\"cells\": [0]}");
  EXPECT_EQ(hear().verb, Verb::failed);
  EXPECT_EQ(leave(), static_cast<int>(ExitStatus::defect));
}

}  // namespace
}  // namespace veduta
