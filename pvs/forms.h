// Forms: the different three bytes with which one object occurs in rows. An entry of a row in the file names
// one of its object's by a number of two bytes. Few occur: in Den Haag 18 an object.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pvs/visibility.h"

namespace veduta {

/// The forms of all objects, as a file has them.
struct Forms {
  std::vector<uint64_t> begin;         ///< [N+1] forms of object o are begin[o] to begin[o+1]-1
  std::vector<VisibilityIndex> index;  ///< [F]

  /// Sets the index of an entry whose object is one of 0 to N-1. \return false: it has no such form.
  bool set(uint16_t form, PvsEntry& entry) const {
    const uint64_t at = begin[entry.object] + form;
    if (at >= begin[entry.object + 1]) return false;
    entry.index = index[at];
    return true;
  }
};

/// Makes objects of steps: each entry has as its object the difference to that of the one before it, the
/// first its object. \return what is wrong with them: each has to be above the one before it and below
/// `objects`.
std::optional<std::string> sum_steps(PvsEntry* first, PvsEntry* last, size_t objects);

/// Numbers the forms of each object in the order in which they come, while rows are written. Takes 18 to 23
/// bytes for each form and 2 for each object, and 3 and 8 more in the end.
class FormTable {
 public:
  explicit FormTable(size_t objects) : count_(objects) {}

  /// An object has at most 64,895 forms: one of 507 pairs of x and y of which one is 0, one of 128 z, not all
  /// 0.
  uint16_t number(const PvsEntry& entry);
  size_t size() const { return forms_.size(); }
  Forms forms() const;

 private:
  struct Form {
    PvsEntry entry;
    uint16_t number;
  };
  size_t find(const PvsEntry& entry) const;
  void grow();

  std::vector<uint16_t> count_;  ///< [N]
  std::deque<Form> forms_;       ///< [F] in the order in which they came
  std::vector<uint32_t> slots_;  ///< a power of two of them: 0 free, else number in forms_ + 1
};

}  // namespace veduta
