#include "farm/devices.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/farm/bake_fixture.h"

namespace veduta {
namespace {

using Names = std::vector<std::string>;

/// As a node with four GPUs lists them: EGL counts from the other end, and the software renderer comes last.
std::vector<Device> four_gpus() {
  std::vector<Device> devices;
  for (const char* line :
       {"0: hardware /dev/dri/card3 cuda 3", "1: hardware /dev/dri/card2 cuda 2",
        "2: hardware /dev/dri/card1 cuda 1", "3: hardware /dev/dri/card0 cuda 0", "4: software"})
    devices.push_back(parse_device(line).value());
  return devices;
}

TEST(Devices, AreReadFromTheLinesOfAProbe) {
  const auto device = parse_device("2: hardware /dev/dri/card1 cuda 7");
  ASSERT_TRUE(device);
  EXPECT_EQ(device->number, 2u);
  EXPECT_FALSE(device->software);
  EXPECT_EQ(device->cuda, 7);
  EXPECT_TRUE(parse_device("0: software").value().software);
  EXPECT_FALSE(parse_device("0: hardware").value().cuda);
  for (const char* other : {"", "libEGL warning: 0", "x: hardware", "1: llvmpipe, OpenGL 4.5"})
    EXPECT_FALSE(parse_device(other)) << other;
}

TEST(Devices, AutoIsEveryUsableHardwareDevice) {
  EXPECT_EQ(gpus_in_turn(four_gpus(), "auto", nullptr), (Names{"0", "1", "2", "3"}));
  auto devices = four_gpus();
  devices[1].refusal = "cannot be used: signal 11 (Segmentation fault)";
  EXPECT_EQ(gpus_in_turn(devices, "auto", nullptr), (Names{"0", "2", "3"}));
}

TEST(Devices, WithoutHardwareAWorkerChoosesAndWithRefusedHardwareItDoesNot) {
  EXPECT_EQ(gpus_in_turn({}, "auto", nullptr), (Names{"auto"}));
  EXPECT_EQ(gpus_in_turn({parse_device("0: software").value()}, "auto", "0"), (Names{"auto"}));
  auto device = parse_device("0: hardware").value();
  device.refusal = "draws in software";
  EXPECT_EQ(gpus_in_turn({device}, "auto", nullptr), (Names{"software"}));
}

TEST(Devices, WhatTheUserNamesIsTaken) {
  EXPECT_EQ(gpus_in_turn(four_gpus(), "2", "0"), (Names{"2"}));
  EXPECT_EQ(gpus_in_turn(four_gpus(), "software", nullptr), (Names{"software"}));
}

// The scheduler counts as CUDA does, not as EGL.
TEST(Devices, CudaVisibleDevicesNarrowsAuto) {
  EXPECT_EQ(gpus_in_turn(four_gpus(), "auto", "0"), (Names{"3"}));
  EXPECT_EQ(gpus_in_turn(four_gpus(), "auto", "1,3"), (Names{"2", "0"}));
  EXPECT_EQ(gpus_in_turn(four_gpus(), "auto", ""), (Names{"0", "1", "2", "3"}));
  EXPECT_EQ(gpus_in_turn(four_gpus(), "auto", "GPU-5b1d,x"), (Names{"0", "1", "2", "3"}));
}

// With cgroups a job's only GPU is 0 for CUDA whatever it is for the driver, and the others cannot be opened.
TEST(Devices, ADeviceThatAloneCanBeOpenedIsTakenWhateverItsNumber) {
  auto devices = four_gpus();
  for (const size_t hidden : {1u, 2u, 3u}) devices[hidden].refusal = "cannot be used: exit status 2";
  EXPECT_EQ(gpus_in_turn(devices, "auto", "0"), (Names{"0"}));
}

TEST(Devices, WorkersOfAHostSpreadOverThem) {
  const Names gpus{"0", "1", "2", "3"};
  const auto used = [&](uint32_t ranks, uint32_t workers) {
    std::multiset<std::string> all;
    for (uint32_t rank = 0; rank < ranks; ++rank)
      for (uint32_t worker = 0; worker < workers; ++worker)
        all.insert(gpu_of_worker(gpus, rank, ranks, worker));
    return all;
  };
  const std::multiset<std::string> each_once(gpus.begin(), gpus.end());
  EXPECT_EQ(used(4, 1), each_once);
  EXPECT_EQ(used(1, 4), each_once);
  EXPECT_EQ(used(2, 2), each_once);
  for (const auto& gpu : gpus) EXPECT_EQ(used(4, 2).count(gpu), 2u) << gpu;
  // srun --gpus-per-task: each rank sees a device of its own.
  EXPECT_EQ(gpu_of_worker({"5"}, 3, 4, 0), "5");
}

}  // namespace

namespace test {
namespace {

/// Names of the renderers that took part.
std::set<std::string> renderers(const fs::path& run) {
  const auto report = nlohmann::json::parse(slurp(run / "report.json"), nullptr, false);
  return report.is_object() ? report["renderers"].get<std::set<std::string>>() : std::set<std::string>();
}

const char* const four_devices = "0: hardware\n1: hardware\n2: hardware\n3: hardware\n4: software";

TEST_F(Bake, UsesEachDeviceOnceWithoutBeingTold) {
  const std::string command =
      std::string(VEDUTA_PROGRAM) + " bake " + config + " --out " + (directory / "run").string();
  ASSERT_EQ(run(command, {{"FAKE_DEVICES", four_devices}, {"FAKE_CELL_MS", "5"}}), 0) << output;
  EXPECT_NE(output.find("1 rank x 4 workers"), std::string::npos) << output;
  EXPECT_EQ(renderers(directory / "run"),
            (std::set<std::string>{"fake on 0", "fake on 1", "fake on 2", "fake on 3"}));
}

TEST_F(Bake, UsesEachDeviceOnceWithARankForEach) {
  if (!has_mpirun()) GTEST_SKIP() << "no mpirun here";
  ASSERT_EQ(run(mpirun(4, bake("", "run", 1)), {{"FAKE_DEVICES", four_devices}, {"FAKE_CELL_MS", "5"}}), 0)
      << output;
  EXPECT_EQ(renderers(directory / "run"),
            (std::set<std::string>{"fake on 0", "fake on 1", "fake on 2", "fake on 3"}));
}

TEST_F(Bake, LeavesOutADeviceWhoseDriverCrashes) {
  ASSERT_EQ(run(bake("", "run", 3),
                {{"FAKE_DEVICES", four_devices}, {"FAKE_DEVICE_CRASHES", "1"}, {"FAKE_CELL_MS", "5"}}),
            0)
      << output;
  EXPECT_EQ(renderers(directory / "run"), (std::set<std::string>{"fake on 0", "fake on 2", "fake on 3"}));
  EXPECT_NE(output.find(", 0 retries, "), std::string::npos) << output;
}

}  // namespace
}  // namespace test
}  // namespace veduta
