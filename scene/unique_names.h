// Names that are each there once.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace veduta {

/// Hands out each name once: a name that was given before gets the separator and the next free number, from 2
/// on. A million equal names take no longer than a million different ones.
class UniqueNames {
 public:
  explicit UniqueNames(char separator) : separator_(separator) {}

  std::string operator()(const std::string& name) {
    if (names_.insert(name).second) return name;
    uint64_t& last = last_number_.try_emplace(name, 1).first->second;
    std::string free;
    do free = name + separator_ + std::to_string(++last);
    while (!names_.insert(free).second);
    return free;
  }

 private:
  char separator_;
  std::unordered_set<std::string> names_;
  std::unordered_map<std::string, uint64_t> last_number_;
};

}  // namespace veduta
