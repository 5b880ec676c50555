// What the parts of a preparation owe each other, without a city: fails where the farm does not keep to it.
#pragma once

#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "scene/error.h"

namespace veduta {

/// Tiles stand in a row and air comes in at the last one, so that floods in order have to be done again. Each
/// part leaves a file; a part whose forerunners left none, or that two workers hold at once, is an error that
/// stops the bake.
class FakePreparation {
 public:
  static constexpr uint32_t tiles = 5, blocks = 3;

  explicit FakePreparation(std::filesystem::path directory) : directory_(std::move(directory)) {}
  const std::filesystem::path& directory() const { return directory_; }
  const std::vector<uint32_t>& again() const { return again_; }

  void do_part(const std::string& stage, uint32_t part) {
    if (stage == "import") {
      std::filesystem::remove_all(directory_);
      std::filesystem::create_directories(directory_);
    }
    take(stage, part);
    if (stage == "flood")
      flood(part);
    else if (stage == "cells")
      for (uint32_t tile = 0; tile < tiles; ++tile) require("flood", tile);
    else if (stage == "shrink")
      for (uint32_t tile = 0; tile < tiles; ++tile) require("cells", tile);
    else if (stage == "finish")
      for (uint32_t block = 0; block < blocks; ++block) require("shrink", block);
    if (stage != "flood") leave(stage, part);
  }
  void let_go(const std::string& stage, uint32_t part) { std::filesystem::remove(held(stage, part)); }

 private:
  std::filesystem::path file(const std::string& stage, uint32_t part) const {
    return directory_ / (stage + "-" + std::to_string(part));
  }
  std::filesystem::path held(const std::string& stage, uint32_t part) const {
    return file("held-" + stage, part);
  }
  bool there(const std::string& stage, uint32_t part) const { return exists(file(stage, part)); }
  void leave(const std::string& stage, uint32_t part) const { std::ofstream(file(stage, part)) << "done"; }
  void require(const std::string& stage, uint32_t part) const {
    if (!there(stage, part))
      throw Error(ExitStatus::bad_input, file(stage, part).string() + ": not done yet");
  }

  void take(const std::string& stage, uint32_t part) const {
    // A worker of a bake that was killed dies with its shepherd, but may be a zombie for a moment longer.
    pid_t holder = 0, shepherd = 0;
    if (std::ifstream(held(stage, part)) >> holder >> shepherd && kill(holder, 0) == 0 &&
        kill(shepherd, 0) == 0)
      throw Error(ExitStatus::bad_input, held(stage, part).string() + ": in two hands");
    std::ofstream(held(stage, part)) << getpid() << ' ' << getppid();
  }

  /// Names the neighbours without air, so that one who asks after a death hears the same.
  void flood(uint32_t tile) {
    const bool below = tile > 0, above = tile + 1 < tiles;
    if (above && !there("flood", tile + 1) && !(below && there("flood", tile - 1))) return;
    leave("flood", tile);
    if (below && !there("flood", tile - 1)) again_.push_back(tile - 1);
    if (above && !there("flood", tile + 1)) again_.push_back(tile + 1);
  }

  std::filesystem::path directory_;
  std::vector<uint32_t> again_;
};

}  // namespace veduta
