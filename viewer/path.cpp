#include "viewer/path.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <glm/common.hpp>
#include <string_view>

#include "scene/atomic_file.h"
#include "scene/error.h"
#include "scene/text.h"

namespace veduta {
namespace {

constexpr std::string_view header = "x,y,z,yaw_deg,pitch_deg";

std::string_view trimmed(std::string_view text) {
  const size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// Five finite numbers, or what is wrong.
std::string parse_pose(std::string_view line, Pose& pose) {
  std::array<float, 5> value{};
  for (size_t i = 0; i < value.size(); ++i) {
    const size_t comma = line.find(',');
    if ((comma == std::string_view::npos) != (i + 1 == value.size()))
      return fmt::format("expected {} numbers ({})", value.size(), header);
    const std::string_view word = trimmed(line.substr(0, comma));
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value[i]);
    if (fault != std::errc() || end != word.data() + word.size() || !std::isfinite(value[i]))
      return fmt::format("\"{}\" is not a finite number", printable(word, 40));
    line.remove_prefix(comma == std::string_view::npos ? line.size() : comma + 1);
  }
  if (std::abs(value[4]) > 90) return fmt::format("pitch_deg is {}, not in -90..90", value[4]);
  pose = {{value[0], value[1], value[2]}, value[3], value[4]};
  return {};
}

}  // namespace

std::vector<Pose> read_path(const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& what) -> Error {
    return {ExitStatus::bad_input, file.string() + ": " + what};
  };
  std::ifstream stream(file);
  if (!stream) throw refuse("cannot be opened; give a CSV file with the columns " + std::string(header));

  std::vector<Pose> path;
  std::string line;
  for (size_t number = 1; std::getline(stream, line); ++number) {
    const std::string_view text = trimmed(line);
    if (number == 1) {
      if (text != header) throw refuse(fmt::format("line 1: expected the header \"{}\"", header));
      continue;
    }
    if (text.empty()) continue;
    Pose pose;
    if (const std::string fault = parse_pose(text, pose); !fault.empty())
      throw refuse(fmt::format("line {}: {}", number, fault));
    path.push_back(pose);
  }
  if (path.empty())
    throw refuse(fmt::format("no eye point; expected the header \"{}\" and one line each", header));
  return path;
}

void write_path(const std::filesystem::path& file, const std::vector<Pose>& path) {
  write_atomically(file, [&](const std::filesystem::path& part) {
    std::ofstream stream(part);
    stream << header << '\n';
    // The shortest texts that are read back as the same numbers.
    for (const Pose& pose : path)
      stream << fmt::format("{},{},{},{},{}\n", pose.position_m.x, pose.position_m.y, pose.position_m.z,
                            pose.yaw_deg, pose.pitch_deg);
    if (!stream.flush()) throw Error(ExitStatus::input_output, file.string() + ": cannot be written");
  });
}

Pose between(const Pose& a, const Pose& b, float part) {
  return {glm::mix(a.position_m, b.position_m, part),
          a.yaw_deg + part * std::remainder(b.yaw_deg - a.yaw_deg, 360.0f),
          glm::mix(a.pitch_deg, b.pitch_deg, part)};
}

std::vector<Pose> resample(const std::vector<Pose>& path, size_t frames) {
  std::vector<Pose> result;
  result.reserve(frames);
  for (size_t i = 0; i < frames; ++i) {
    const double along = frames > 1 ? static_cast<double>(i) * static_cast<double>(path.size() - 1) /
                                          static_cast<double>(frames - 1)
                                    : 0;
    const size_t before = std::min(static_cast<size_t>(along), path.size() - 1);
    const size_t after = std::min(before + 1, path.size() - 1);
    const float part = static_cast<float>(along - static_cast<double>(before));
    result.push_back(between(path[before], path[after], part));
  }
  return result;
}

}  // namespace veduta
