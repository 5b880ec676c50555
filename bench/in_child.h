// Work in a process of its own, and a directory of its own.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace veduta::bench {

/// Runs in a child that has nothing of ours in memory, which answers in one line. `work` gives JSON.
/// \throw std::runtime_error what it threw.
template <typename Work>
nlohmann::ordered_json in_child(const Work& work) {
  using Json = nlohmann::ordered_json;
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no child process");
  if (child == 0) {
    Json answer;
    try {
      answer = work();
    } catch (const std::exception& error) {
      answer = {{"error", error.what()}};
    }
    const std::string text = answer.dump();
    _exit(write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size()) ? 0 : 1);
  }
  close(ends[1]);
  std::string text;
  char block[4096];
  for (ssize_t count = 0; (count = read(ends[0], block, sizeof block)) > 0;)
    text.append(block, static_cast<size_t>(count));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (text.empty()) throw std::runtime_error("a process died with status " + std::to_string(status));
  Json answer = Json::parse(text);
  if (answer.contains("error")) throw std::runtime_error(answer["error"].get<std::string>());
  return answer;
}

/// A directory that is gone in the end.
struct Scratch {
  std::filesystem::path path;
  explicit Scratch(const std::filesystem::path& where) {
    std::string name = (where / "veduta-bench-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error(where.string() + ": no directory can be made there");
    path = name;
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
};

}  // namespace veduta::bench
