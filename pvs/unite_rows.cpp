#include "pvs/unite_rows.h"

#include <algorithm>
#include <utility>

namespace veduta {
namespace {

// What either of two entries of one object draws. Bytes of one kind fall together: the one that reaches
// further draws what both do. Bytes of two kinds do not: then a second entry has what the first lacks.
std::pair<VisibilityIndex, VisibilityIndex> unite(VisibilityIndex a, VisibilityIndex b) {
  const auto reaches = [](int8_t k, int8_t l) { return k == 0 || (l != 0 && l < k) ? l : k; };
  a.z = b.z = reaches(a.z, b.z);
  if (a.z == 1) return {completely_visible, {}};
  if (a.x > 0 && b.x > 0) a.x = b.x = std::max(a.x, b.x);
  if (a.x < 0 && b.x < 0) a.x = b.x = std::max(a.x, b.x);  // -1 draws from slice 2 on, -2 from 3
  if (a.y > 0 && b.y > 0) a.y = b.y = std::max(a.y, b.y);
  if (a.y < 0 && b.y < 0) a.y = b.y = std::max(a.y, b.y);
  const bool a_adds = a.x != 0 || a.y != 0, b_adds = b.x != 0 || b.y != 0;
  if (!b_adds || (a.x == b.x && a.y == b.y)) return {a, {}};
  if (!a_adds) return {b, {}};
  b.z = 0;
  return {a, b};
}

void add(const PvsEntry& entry, PvsRow& out) {
  if (!entry.index.nothing()) out.push_back(entry);
}

}  // namespace

void unite_rows(const PvsRow& a, const PvsRow& b, PvsRow& out) {
  out.clear();
  out.reserve(a.size() + b.size());
  auto i = a.begin(), j = b.begin();
  while (i != a.end() && j != b.end())
    if (i->object < j->object)
      add(*i++, out);
    else if (j->object < i->object)
      add(*j++, out);
    else {
      const auto [first, second] = unite(i->index, j->index);
      add({i->object, first}, out);
      add({i->object, second}, out);
      ++i, ++j;
    }
  out.insert(out.end(), i, a.end());
  out.insert(out.end(), j, b.end());
}

}  // namespace veduta
