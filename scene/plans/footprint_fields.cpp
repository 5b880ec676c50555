#include "scene/plans/footprint_fields.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <span>

namespace veduta {
namespace {

// Best first. IGN (BD TOPO), OpenStreetMap, CityGML, INSPIRE, BAG, and what people write.
constexpr std::string_view heights[] = {"height",         "heightm",   "hauteur",    "measuredheight",
                                        "buildingheight", "buildingh", "bldgheight", "renderheight",
                                        "heightroof",     "hoehe"};
constexpr std::string_view floors[] = {"nbetages",
                                       "numberoffloors",
                                       "numberoffloorsvalue",
                                       "storeysaboveground",
                                       "buildinglevels",
                                       "floors",
                                       "levels",
                                       "storeys",
                                       "stories",
                                       "numfloors",
                                       "nfloors",
                                       "geschosse"};
constexpr std::string_view grounds[] = {"zminsol",      "groundh", "groundz",   "groundelevation",
                                        "groundheight", "zground", "groundelev"};
constexpr std::string_view roofs[] = {"roofh",    "roofz",    "roofheight",
                                      "zmintoit", "zmaxtoit", "roofelevation"};
constexpr std::string_view names[] = {"id",         "gmlid", "osmid", "cleabs", "identificatie",
                                      "buildingid", "bin",   "name"};

std::string plain(std::string_view name) {
  std::string word;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)))
      word.push_back(static_cast<char>(std::tolower(static_cast<unsigned char>(c))));
  return word;
}

int column_of(const std::vector<std::string>& columns, std::span<const std::string_view> words) {
  for (const std::string_view word : words)
    for (size_t i = 0; i < columns.size(); ++i) {
      const bool cut = columns[i].size() == 10 && word.starts_with(plain(columns[i]));  // by dBASE
      if (plain(columns[i]) == word || cut) return static_cast<int>(i);
    }
  return -1;
}

int column_named(const std::string& file, const std::vector<std::string>& columns, const std::string& name) {
  std::string list;
  for (size_t i = 0; i < columns.size(); ++i) {
    if (columns[i] == name) return static_cast<int>(i);
    list += (i == 0 ? "" : ", ") + columns[i];
  }
  throw bad_input(
      file, "attributes",
      "there is no '" + printable(name, 40) + "' among " + printable(list, 300) + "; give one of these");
}

}  // namespace

FootprintFields::FootprintFields(const std::string& file, const std::vector<std::string>& columns,
                                 const ImportOptions& options)
    : name_(column_of(columns, names)),
      height_(options.height_field.empty() ? column_of(columns, heights)
                                           : column_named(file, columns, options.height_field)),
      floors_(options.floors_field.empty() ? column_of(columns, floors)
                                           : column_named(file, columns, options.floors_field)),
      ground_(column_of(columns, grounds)),
      roof_(column_of(columns, roofs)) {}

std::optional<double> FootprintFields::number_in(std::string_view text) {
  const size_t begin = text.find_first_not_of(" +");
  if (begin == std::string_view::npos) return std::nullopt;
  text.remove_prefix(begin);
  double number = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string_view unit(end, static_cast<size_t>(text.data() + text.size() - end));
  if (status != std::errc() || !std::isfinite(number) || (!unit.empty() && unit != " m" && unit != "m"))
    return std::nullopt;
  return number;
}

std::optional<int> FootprintFields::floors_in(std::string_view text) {
  const std::optional<double> number = number_in(text);
  if (!number || *number < 0 || *number > 1000) return std::nullopt;
  return static_cast<int>(std::lround(*number));
}

std::optional<int> floors_of_layer(std::string_view layer) {
  const size_t digits = layer.find_last_not_of("0123456789") + 1;
  std::string word(layer.substr(0, digits));
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const bool marked = word.ends_with("_etages_") || word.ends_with("_floors_") || word.ends_with("_kat_");
  if (!marked || digits == layer.size() || layer.size() - digits > 3) return std::nullopt;
  int number = 0;
  std::from_chars(layer.data() + digits, layer.data() + layer.size(), number);
  return number;
}

}  // namespace veduta
