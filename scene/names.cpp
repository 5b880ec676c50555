#include "scene/names.h"

#include <algorithm>
#include <cctype>
#include <span>
#include <utility>

namespace veduta {
namespace {

// "Road_5" and "road" start with the word "road", "roadhouse" does not.
bool starts_with_word(std::string_view text, std::string_view lower) {
  if (text.size() > lower.size() && std::isalpha(static_cast<unsigned char>(text[lower.size()])))
    return false;
  return text.size() >= lower.size() &&
         std::equal(lower.begin(), lower.end(), text.begin(), [](char a, char b) {
           return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b)));
         });
}

template <typename Value>
Value lookup(std::string_view name, std::span<const std::pair<std::string_view, Value>> words,
             Value otherwise) {
  for (const auto& [word, value] : words)
    if (starts_with_word(name, word)) return value;
  return otherwise;
}

constexpr std::pair<std::string_view, Kind> kinds[] = {
    {"terrain", Kind::terrain}, {"ground", Kind::terrain},
    {"relief", Kind::terrain},  {"road", Kind::road},
    {"street", Kind::road},     {"pavement", Kind::road},
    {"water", Kind::water},     {"vegetation", Kind::vegetation},
    {"tree", Kind::vegetation}, {"bridge", Kind::bridge},
    {"other", Kind::other}};

constexpr std::pair<std::string_view, Material> materials[] = {
    {"wall", Material::wall},     {"facade", Material::wall},     {"roof", Material::roof},
    {"window", Material::window}, {"glass", Material::window},    {"door", Material::door},
    {"ground", Material::ground}, {"floor", Material::ground},    {"terrain", Material::terrain},
    {"road", Material::road},     {"street", Material::road},     {"pavement", Material::road},
    {"water", Material::water},   {"tree", Material::vegetation}, {"vegetation", Material::vegetation}};

}  // namespace

Kind kind_of_name(std::string_view name) {
  return lookup<Kind>(name, kinds, Kind::building);
}

Material material_of_name(std::string_view name) {
  return lookup<Material>(name, materials, Material::unknown);
}

}  // namespace veduta
