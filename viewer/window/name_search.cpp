#include "viewer/window/name_search.h"

#include <algorithm>

namespace veduta {
namespace {

constexpr char end_of_name = '\0';

char lower(char letter) {
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(text.begin(), text.end(), result.begin(), [](char letter) { return lower(letter); });
  return result;
}

}  // namespace

NameSearch::NameSearch(const std::vector<Object>& objects) {
  begin_.reserve(objects.size() + 1);
  begin_.push_back(0);
  for (const Object& object : objects) {
    names_ += lower(object.name);
    std::replace(names_.begin() + static_cast<ptrdiff_t>(begin_.back()), names_.end(), end_of_name, '\1');
    names_ += end_of_name;
    begin_.push_back(names_.size());
  }
}

NameSearch::Found NameSearch::find(std::string_view text, size_t most) const {
  Found found;
  const std::string wanted = lower(text);
  if (wanted.empty() || wanted.find(end_of_name) != std::string::npos) return found;
  std::vector<uint32_t> inside;
  auto name = begin_.begin();
  for (size_t at = names_.find(wanted); at != std::string::npos; at = names_.find(wanted, *name)) {
    name = std::upper_bound(name, begin_.end(), at);  // the end of the name that holds it
    const auto object = static_cast<uint32_t>(name - begin_.begin() - 1);
    std::vector<uint32_t>& list = at == begin_[object] ? found.objects : inside;
    if (list.size() < most) list.push_back(object);
    ++found.all;
  }
  inside.resize(std::min(inside.size(), most - found.objects.size()));
  found.objects.insert(found.objects.end(), inside.begin(), inside.end());
  return found;
}

}  // namespace veduta
