// A worker that runs out of memory says so, and that another try is worth it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <new>
#include <nlohmann/json.hpp>
#include <thread>

#include "scene/error.h"
#include "tests/pvs/small_city.h"
#include "worker/protocol.h"
#include "worker/worker_loop.h"

namespace {

std::atomic<size_t> largest_allocation{SIZE_MAX};

}  // namespace

// Not inlined: GCC 12 would then take them for a mismatched pair.
[[gnu::noinline]] void* operator new(size_t size) {
  void* const memory = size > largest_allocation ? nullptr : std::malloc(size);
  if (!memory) throw std::bad_alloc();
  return memory;
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, size_t) noexcept {
  std::free(memory);
}

namespace veduta {
namespace {

TEST(WorkerMemory, WantOfItIsWorthAnotherTry) {
  const test::TemporaryDirectory directory;
  {
    std::ofstream model(directory / "city.obj");
    for (int i = 0; i < 3000; ++i)
      model << "v " << i << " 0 0\nv " << i << " 1 0\nv " << i << " 0 1\nf -1 -2 -3\n";
    std::ofstream(directory / "run.toml")
        << "[scene]\nmodel = '" << (directory / "city.obj").string() << "'\n";
  }
  int to_worker[2], from_worker[2], status = 0;
  ASSERT_EQ(pipe(to_worker), 0);
  ASSERT_EQ(pipe(from_worker), 0);
  std::thread worker([&] {
    status = run_worker(to_worker[0], from_worker[1], "software");
    close(from_worker[1]);
  });
  ASSERT_TRUE(read_frame(from_worker[0]));  // hello
  largest_allocation = 10000;
  const nlohmann::json request{
      {"directory", directory.path().string()}, {"stage", "import"}, {"part", 0}, {"threads", 1}};
  write_frame(to_worker[1], encode_frame(Verb::prepare, request.dump()));
  const auto answer = read_frame(from_worker[0]);
  worker.join();
  largest_allocation = SIZE_MAX;
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->verb, Verb::failed);
  const auto failed = nlohmann::json::parse(answer->text());
  EXPECT_EQ(failed["again"], true);
  EXPECT_EQ(failed["status"], static_cast<int>(ExitStatus::input_output));
  EXPECT_NE(failed["message"].get<std::string>().find("out of memory"), std::string::npos) << answer->text();
  EXPECT_EQ(status, static_cast<int>(ExitStatus::input_output));
  for (const int end : {to_worker[0], to_worker[1], from_worker[0]}) close(end);
}

}  // namespace
}  // namespace veduta
