#include "tests/hard/exact_model.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace veduta::hard {

ExactModel read_exact_model(const std::filesystem::path& obj, double unit_m) {
  std::ifstream in(obj);
  if (!in) throw std::runtime_error(obj.string() + ": cannot be read");
  ExactModel model;
  std::vector<Point> vertices;
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string statement;
    words >> statement;
    if (statement == "v") {
      Point p{};
      if (!(words >> p[0] >> p[1] >> p[2])) throw std::runtime_error(obj.string() + ": " + line);
      vertices.push_back({p[0] * unit_m, p[1] * unit_m, p[2] * unit_m});
    } else if (statement == "o") {
      model.objects.emplace_back();
      words >> model.objects.back();
    } else if (statement == "f") {
      if (model.objects.empty()) model.objects.push_back(obj.stem().string());
      std::vector<Point> face;
      for (long index = 0; words >> index;) {
        const long at = index > 0 ? index - 1 : static_cast<long>(vertices.size()) + index;
        face.push_back(vertices.at(static_cast<size_t>(at)));
      }
      const auto object = static_cast<uint32_t>(model.objects.size() - 1);
      for (size_t n = 2; n < face.size(); ++n)
        model.triangles.push_back({{face[0], face[n - 1], face[n]}, object});
    }
  }
  return model;
}

}  // namespace veduta::hard
