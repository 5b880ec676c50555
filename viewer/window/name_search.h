// Finds objects by a part of their name.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace veduta {

/// All names of a city in one text, so that a hundred thousand are searched between two key strokes.
class NameSearch {
 public:
  struct Found {
    std::vector<uint32_t> objects;  ///< first those whose name begins with the text; each by ascending number
    size_t all = 0;                 ///< how many there are, shown or not
  };

  NameSearch() = default;
  explicit NameSearch(const std::vector<Object>& objects);

  /// Objects whose name has `text` in it, `most` at most; upper and lower case of ASCII letters are alike.
  /// None for an empty text.
  Found find(std::string_view text, size_t most) const;

 private:
  std::string names_;            ///< lower case, each ended by a byte that is in no text
  std::vector<uint64_t> begin_;  ///< [N+1] of an object's name
};

}  // namespace veduta
