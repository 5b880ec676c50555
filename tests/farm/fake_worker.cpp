// A worker without GL for the tests of the farm: it speaks the protocol, and fails in the ways that its
// environment names.
//   FAKE_CELLS       number of view-cells that the preparation makes [200]
//   FAKE_CELL_MS     time that a cell takes [1]
//   FAKE_CRASH_CELLS cells ("17,40") whose bake ends in SIGKILL, each time
//   FAKE_CRASH_RATE  probability (0..1) that a cell ends in SIGSEGV
//   FAKE_BAD_RANK    the rank whose workers end in SIGSEGV over every cell
//   FAKE_BEGUN       a file: every cell that is begun is appended to it, as u32
//   FAKE_GATE        a file with a number: no cell is begun while FAKE_BEGUN has that many
//   FAKE_FAULT_RATE  probability that a cell's first or second bake ends in SIGKILL or SIGSEGV or hangs: the
//   same ones each time
//   FAKE_FAULTS      a directory that remembers how often a cell was begun
//   FAKE_HANG_CELLS  cells ("17,40") whose bake hangs, each time
//   FAKE_NO_MEMORY   a file: the worker that can create it runs out of memory at its tenth cell; "always":
//   each does
//   FAKE_HANG_ONCE   a file: the worker that can create it hangs at its tenth cell
//   FAKE_LEAVE_ONCE  a file: the worker that can create it leaves after its lease
//   FAKE_STRAY_ONCE  a file: the worker that can create it answers for a cell that there is not
//   FAKE_FAIL        a status: `prepare` answers `failed` with it
//   FAKE_FAIL_AGAIN  1: and that another try is worth it
//   FAKE_DEVICES     what --list prints; the renderer is then named after --gpu
//   FAKE_DEVICE_CRASHES  the device whose --probe ends in SIGSEGV
//   FAKE_PREPARE_MS  time that a part of the preparation takes [0]
//   FAKE_PREPARE_DIES  a part ("flood-3") that ends in SIGKILL, each time
//   FAKE_PREPARE_DIES_ONCE  a directory: each part, done for the first time, ends in SIGKILL before the
//   answer
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <sstream>
#include <thread>

#include "merge/merge.h"
#include "pvs/pvs_file.h"
#include "pvs/shard.h"
#include "scene/error.h"
#include "tests/farm/fake_preparation.h"
#include "worker/protocol.h"

namespace veduta {
namespace {

using nlohmann::json;
constexpr uint32_t object_count = 40;

std::string environment(const char* name, const char* otherwise) {
  const char* value = std::getenv(name);
  return value ? value : otherwise;
}

/// Is there a name, and no such file before?
bool first_to_create(const std::string& file) {
  return !file.empty() && open(file.c_str(), O_CREAT | O_EXCL, 0600) >= 0;
}

void answer(Verb verb, const json& value) {
  write_frame(STDOUT_FILENO, encode_frame(verb, value.dump()));
}

/// A row of tetrahedra above a row of cells.
City tiny_city(uint32_t cells) {
  City city;
  for (uint32_t i = 0; i < object_count; ++i) {
    const auto x = static_cast<float>(i);
    const auto first = static_cast<uint32_t>(city.scene.vertices.size());
    for (const glm::vec3& corner :
         {glm::vec3(x, 5, 0), glm::vec3(x + 0.9f, 5, 0), glm::vec3(x, 5.9f, 0), glm::vec3(x, 5, 2)})
      city.scene.vertices.push_back(corner);
    for (const glm::uvec3& corners :
         {glm::uvec3(0, 2, 1), glm::uvec3(0, 1, 3), glm::uvec3(1, 2, 3), glm::uvec3(0, 3, 2)})
      city.scene.triangles.push_back(corners + first);
    city.scene.material.resize(city.scene.triangles.size(), Material::wall);
    city.scene.objects.push_back({"object " + std::to_string(i), Kind::building, 4 * i, 4 * (i + 1)});
  }
  city.slices.resize(object_count);
  city.triangle_slices.resize(city.scene.triangles.size());
  for (uint32_t i = 0; i < cells; ++i) {
    const auto x = static_cast<float>(i);
    city.cells.push_back({{x, 0, 0}, {x + 1, 1, 1}});
  }
  city.navigation.free = {{0, 0, 0}, 1, 1, {{0, 0, 0}}, {0x5555}, {0}};
  city.navigation.ground = {0, 0, 1, 1, 1, {0}};
  return city;
}

std::set<uint32_t> cells_of(const char* name) {
  std::set<uint32_t> cells;
  std::istringstream list(environment(name, ""));
  for (std::string cell; std::getline(list, cell, ',');)
    cells.insert(static_cast<uint32_t>(std::stoul(cell)));
  return cells;
}

[[noreturn]] void hang() {
  for (;;) pause();
}

/// Fails the first or second bake of some cells. A third one is good, so that no cell is given up.
void fault(uint32_t cell) {
  const double rate = std::stod(environment("FAKE_FAULT_RATE", "0"));
  const std::string begun = environment("FAKE_FAULTS", "") + "/" + std::to_string(cell) + "-";
  if (rate == 0) return;
  uint32_t tries = 0;
  while (!first_to_create(begun + std::to_string(tries))) ++tries;
  std::mt19937 chance(cell * 4 + tries);
  if (tries >= 2 || std::uniform_real_distribution<>()(chance) >= rate) return;
  const auto kind = chance() % 3;
  if (kind == 0) hang();
  raise(kind == 1 ? SIGKILL : SIGSEGV);
}

/// The same row for a cell whoever bakes it.
CellRecord bake(uint32_t cell) {
  CellRecord record;
  record.cell = cell, record.bake_us = 1000;
  for (uint32_t object = 0; object < object_count; ++object)
    if ((cell * 2654435761u >> (object % 31)) & 1u) record.row.push_back({object, completely_visible});
  return record;
}

class FakeWorker {
 public:
  explicit FakeWorker(const std::vector<std::string>& arguments) {
    if (std::getenv("FAKE_DEVICES")) renderer_ += " on " + arguments.at(1);
  }

  int run() {
    answer(Verb::hello, {{"pid", getpid()}, {"version", protocol_version}});
    while (const auto frame = read_frame(STDIN_FILENO)) {
      if (frame->verb == Verb::quit) return 0;
      const json value = json::parse(frame->text());
      if (frame->verb == Verb::prepare) {
        if (const int status = prepare(value); status != 0) return status;
      } else if (frame->verb == Verb::open) {
        const City city = read_city(RunPaths{value.at("directory").get<std::string>()}.city());
        answer(Verb::opened, {{"renderer", renderer_}, {"cells", city.cells.size()}});
      } else if (frame->verb == Verb::bake) {
        for (const uint32_t cell : value.at("cells").get<std::vector<uint32_t>>()) {
          bake_cell(cell);
          if (baked_ == 10 && no_memory()) return 74;
        }
        answer(Verb::lease_done, json::object());
        if (first_to_create(environment("FAKE_LEAVE_ONCE", ""))) return 0;
      }
    }
    return 0;
  }

 private:
  int prepare(const json& request) {
    const auto stage = request.at("stage").get<std::string>();
    const auto part = request.at("part").get<uint32_t>();
    const std::string name = stage + "-" + std::to_string(part);
    if (environment("FAKE_PREPARE_DIES", "") == name) raise(SIGKILL);
    if (const int status = std::atoi(environment("FAKE_FAIL", "0").c_str()); status != 0) {
      answer(Verb::failed, {{"status", status},
                            {"message", "model.json: broken on purpose; mend it"},
                            {"again", environment("FAKE_FAIL_AGAIN", "0") == "1"}});
      return status;
    }
    const RunPaths run{request.at("directory").get<std::string>()};
    FakePreparation preparation(run.directory / "prepared.tmp");
    preparation.do_part(stage, part);
    if (stage == "finish") {
      write_city(preparation.directory() / "city.h5", tiny_city(cells_));
      std::filesystem::rename(preparation.directory(), run.prepared());
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(prepare_ms_));
    const std::string deaths = environment("FAKE_PREPARE_DIES_ONCE", "");
    if (stage != "finish" && !deaths.empty() && first_to_create(deaths + "/" + name)) raise(SIGKILL);
    preparation.let_go(stage, part);
    answer(Verb::prepared, {{"stage", stage},
                            {"part", part},
                            {"tiles", FakePreparation::tiles},
                            {"blocks", FakePreparation::blocks},
                            {"again", preparation.again()},
                            {"cells", cells_},
                            {"objects", object_count},
                            {"triangles", 4 * object_count},
                            {"seconds", 0.001 * prepare_ms_},
                            {"peak_mb", 7.0},
                            {"notes", {"a note"}}});
    return 0;
  }

  void bake_cell(uint32_t cell) {
    ++baked_;
    wait_at_gate();
    if (begun_ >= 0 && write(begun_, &cell, sizeof cell) != sizeof cell) std::abort();
    if (environment("FAKE_BAD_RANK", "none") == environment("OMPI_COMM_WORLD_RANK", "0")) raise(SIGSEGV);
    fault(cell);
    if (hang_cells_.count(cell)) hang();
    if (crash_cells_.count(cell)) raise(SIGKILL);
    if (std::uniform_real_distribution<>()(random_) < crash_rate_) raise(SIGSEGV);
    if (baked_ == 10 && first_to_create(environment("FAKE_HANG_ONCE", ""))) hang();
    std::this_thread::sleep_for(std::chrono::milliseconds(cell_ms_));
    const bool stray = first_to_create(environment("FAKE_STRAY_ONCE", ""));
    const auto record = encode(bake(stray ? cell + 1'000'000 : cell));
    write_frame(STDOUT_FILENO, encode_frame(Verb::cell_baked, record.data(), record.size()));
  }

  void wait_at_gate() const {
    const std::string gate = environment("FAKE_GATE", "");
    const auto open = [&] {
      off_t limit = 0;
      return (std::ifstream(gate) >> limit) &&
             lseek(begun_, 0, SEEK_END) < limit * static_cast<off_t>(sizeof(uint32_t));
    };
    while (!gate.empty() && !open()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  static bool no_memory() {
    const std::string when = environment("FAKE_NO_MEMORY", "");
    if (when != "always" && !first_to_create(when)) return false;
    answer(Verb::failed, {{"status", 74}, {"message", "worker: out of memory"}, {"again", true}});
    return true;
  }

  std::string renderer_ = "fake";
  std::set<uint32_t> crash_cells_ = cells_of("FAKE_CRASH_CELLS"), hang_cells_ = cells_of("FAKE_HANG_CELLS");
  int begun_ = open(environment("FAKE_BEGUN", "").c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  double crash_rate_ = std::stod(environment("FAKE_CRASH_RATE", "0"));
  uint32_t cells_ = static_cast<uint32_t>(std::stoul(environment("FAKE_CELLS", "200")));
  int prepare_ms_ = std::stoi(environment("FAKE_PREPARE_MS", "0"));
  int cell_ms_ = std::stoi(environment("FAKE_CELL_MS", "1"));
  int baked_ = 0;
  std::mt19937 random_{static_cast<uint32_t>(getpid())};
};

}  // namespace
}  // namespace veduta

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (!arguments.empty() && arguments[0] == "--list") {
    std::cout << veduta::environment("FAKE_DEVICES", "0: software (fake)") << "\n";
    return 0;
  }
  if (!arguments.empty() && arguments[0] == "--probe") {
    if (arguments.at(2) == veduta::environment("FAKE_DEVICE_CRASHES", "")) raise(SIGSEGV);
    std::cout << "a fake renderer\n";
    return 0;
  }
  try {
    return veduta::FakeWorker(arguments).run();
  } catch (const veduta::Error& error) {
    const auto status = static_cast<int>(error.status());
    veduta::answer(veduta::Verb::failed, {{"status", status}, {"message", error.what()}});
    return status;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 70;
  }
}
