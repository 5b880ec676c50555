#include "farm/fingerprint.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <fstream>
#include <map>
#include <memory>
#include <sstream>

#include "scene/error.h"
#include "scene/model_files.h"

namespace veduta {
namespace {

std::string hex(XXH128_hash_t hash) {
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

/// Of a model that is one file alone the hash of that file; else of every file of it, with their names.
std::string hash_model(const std::string& model) {
  const auto files = files_of(model);
  if (files.size() == 1 && files[0].first.empty()) return hash_file(files[0].second);
  std::string all;
  for (const auto& [name, path] : files) all += name + '\0' + hash_file(path) + '\n';
  return hex(XXH3_128bits(all.data(), all.size()));
}

}  // namespace

std::string hash_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored) || !in)
    throw Error(ExitStatus::bad_input,
                file.string() + ": cannot be opened; check scene.model in the configuration");
  const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(),
                                                                              XXH3_freeState);
  XXH3_128bits_reset(state.get());
  std::vector<char> block(1 << 20);
  while (in) {
    in.read(block.data(), static_cast<std::streamsize>(block.size()));
    XXH3_128bits_update(state.get(), block.data(), static_cast<size_t>(in.gcount()));
  }
  if (in.bad()) throw Error(ExitStatus::bad_input, file.string() + ": cannot be read to its end");
  return hex(XXH3_128bits_digest(state.get()));
}

std::string Fingerprint::text() const {
  std::string out = hash + "\n";
  for (const auto& [key, value] : parts) out += key + " = " + value + "\n";
  return out;
}

Fingerprint make_fingerprint(const Settings& settings) {
  Fingerprint made;
  made.parts.emplace_back("algorithm version", std::to_string(algorithm_version));
  for (size_t i = 0; i < settings.scene.model.size(); ++i)
    made.parts.emplace_back(fmt::format("scene.model {} content", i + 1),
                            hash_model(settings.scene.model[i]));
  for (auto& part : list_settings(settings))
    if (part.first != "scene.model") made.parts.push_back(std::move(part));
  std::string all;
  for (const auto& [key, value] : made.parts) all += key + " = " + value + "\n";
  made.hash = hex(XXH3_128bits(all.data(), all.size()));
  return made;
}

void require_same_job(const std::filesystem::path& directory, const std::string& stored,
                      const Fingerprint& ours) {
  std::istringstream lines(stored);
  std::string line;
  std::getline(lines, line);
  if (line == ours.hash) return;
  std::map<std::string, std::string> theirs;
  while (std::getline(lines, line))
    if (const size_t mark = line.find(" = "); mark != std::string::npos)
      theirs[line.substr(0, mark)] = line.substr(mark + 3);
  const auto refuse = [&](const std::string& what) {
    throw Error(ExitStatus::other_job,
                fmt::format("{}: belongs to another job: {}; use another --out, or --fresh to start over",
                            directory.string(), what));
  };
  for (const auto& [key, value] : ours.parts) {
    const auto found = theirs.find(key);
    if (found == theirs.end()) refuse(fmt::format("it has no '{}', here it is {}", key, value));
    if (found->second != value)
      refuse(fmt::format("'{}' is {} there and {} here", key, found->second, value));
    theirs.erase(found);
  }
  refuse(theirs.empty() ? "its fingerprint file is damaged"
                        : fmt::format("it has '{}', which is not here", theirs.begin()->first));
}

}  // namespace veduta
