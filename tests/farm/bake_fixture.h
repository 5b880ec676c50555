// The whole program with a worker that needs no GL, on a directory of its own.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/farm/processes.h"

namespace veduta::test {

class Bake : public testing::Test {
 protected:
  Bake() {
    fs::create_directories(directory);
    std::ofstream(directory / "city.json") << "a model that the fake worker does not read";
    config = write_config("demo.toml", "");
  }
  ~Bake() override {
    std::error_code ignored;
    fs::permissions(directory, fs::perms::owner_all, ignored);
    fs::remove_all(directory, ignored);
  }

  std::string write_config(const std::string& name, const std::string& more) const {
    std::ofstream(directory / name) << "[scene]\nmodel = 'city.json'\n" << more;
    return (directory / name).string();
  }
  std::string bake(const std::string& more = "", const std::string& run = "run", int workers = 2) const {
    return std::string(VEDUTA_PROGRAM) + " bake " + config + " --workers " + std::to_string(workers) +
           " --out " + (directory / run).string() + " " + more;
  }
  static std::string mpirun(int ranks, const std::string& command) {
    return "mpirun --oversubscribe --allow-run-as-root --bind-to none -n " + std::to_string(ranks) + " " +
           command;
  }
  std::unique_ptr<Process> start(const std::string& command, Environment environment = {}) const {
    environment.emplace_back("VEDUTA_WORKER", VEDUTA_FAKE_WORKER);
    return std::make_unique<Process>(command, environment, directory / "output.txt");
  }
  int run(const std::string& command, const Environment& environment = {}) {
    const auto process = start(command, environment);
    const int status = process->wait();
    output = process->output();
    return status;
  }
  std::string digest(const std::string& run_name = "run") const {
    const auto report = nlohmann::json::parse(slurp(directory / run_name / "report.json"), nullptr, false);
    return report.is_object() ? report["merge"].value("content_digest", "") : "";
  }
  /// Enough records in the shards for the bake to be in its middle.
  bool in_the_middle(const std::string& run_name = "run") const {
    return within(20, [&] {
      uint64_t bytes = 0;
      std::error_code ignored;
      for (const auto& shard : fs::directory_iterator(directory / run_name / "shards", ignored))
        bytes += shard.file_size(ignored);
      return bytes > 5000;
    });
  }
  /// The digest of an undisturbed bake.
  std::string reference() {
    EXPECT_EQ(run(bake("", "reference")), 0) << output;
    EXPECT_EQ(digest("reference").size(), 32u) << output;
    return digest("reference");
  }
  static bool has_mpirun() { return std::system("command -v mpirun > /dev/null") == 0; }

  const fs::path directory = fs::temp_directory_path() / ("veduta-bake-test-" + std::to_string(getpid()));
  std::string config, output;
  const Environment slow{{"FAKE_CELL_MS", "8"}};
};

}  // namespace veduta::test
