#include "pvs/forms.h"

#include <fmt/format.h>

namespace veduta {

std::optional<std::string> sum_steps(PvsEntry* first, PvsEntry* last, size_t objects) {
  uint64_t object = 0;
  for (PvsEntry* entry = first; entry != last; ++entry) {
    if (entry != first && entry->object == 0) return fmt::format("object {} comes twice", object);
    object += entry->object;
    if (object >= objects) return fmt::format("object {} of {}", object, objects);
    entry->object = static_cast<uint32_t>(object);
  }
  return {};
}

uint16_t FormTable::number(const PvsEntry& entry) {
  if (4 * (forms_.size() + 1) > 3 * slots_.size()) grow();
  const size_t slot = find(entry);
  if (slots_[slot] == 0) {
    forms_.push_back({entry, count_[entry.object]++});
    slots_[slot] = static_cast<uint32_t>(forms_.size());
  }
  return forms_[slots_[slot] - 1].number;
}

/// The slot of a form, or the free one where it belongs.
size_t FormTable::find(const PvsEntry& entry) const {
  const auto byte = [](int8_t value) { return uint64_t{static_cast<uint8_t>(value)}; };
  const auto [x, y, z] = entry.index;
  uint64_t hash = uint64_t{entry.object} << 24 | byte(x) << 16 | byte(y) << 8 | byte(z);
  hash = (hash ^ hash >> 29) * 0x9E3779B97F4A7C15u;  // the odd number nearest to 2^64 over the golden ratio
  size_t slot = (hash >> 32) & (slots_.size() - 1);
  while (slots_[slot] != 0 && !(forms_[slots_[slot] - 1].entry == entry))
    slot = (slot + 1) & (slots_.size() - 1);
  return slot;
}

void FormTable::grow() {
  const size_t slots = slots_.empty() ? 64 : 2 * slots_.size();
  slots_ = std::vector<uint32_t>();  // before there are more of them
  slots_.resize(slots);
  for (size_t form = 0; form < forms_.size(); ++form)
    slots_[find(forms_[form].entry)] = static_cast<uint32_t>(form + 1);
}

Forms FormTable::forms() const {
  Forms out;
  out.begin.push_back(0);
  for (const uint16_t count : count_) out.begin.push_back(out.begin.back() + count);
  out.index.resize(forms_.size());
  for (const Form& form : forms_) out.index[out.begin[form.entry.object] + form.number] = form.entry.index;
  return out;
}

}  // namespace veduta
