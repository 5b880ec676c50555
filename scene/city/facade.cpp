// The hot path of the generator: nothing is allocated here once the scratch memory has grown, and no name or
// attribute is looked at (rules.cpp).
#include "scene/city/facade.h"

#include <glm/geometric.hpp>

#include "scene/city/split.h"
#include "scene/text.h"

namespace veduta::city {
namespace {

constexpr uint64_t rule_number = 0;  // which random number of a shape chooses its rule
constexpr uint64_t first_split_number = 1;

size_t weighted(const std::vector<double>& weights, double number) {
  double sum = 0;
  for (const double weight : weights) sum += weight;
  double rest = number * sum;
  size_t last = 0;
  for (size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] == 0) continue;
    last = i;
    if ((rest -= weights[i]) < 0) break;
  }
  return last;
}

}  // namespace

Facade::Facade(const glm::dvec2& from, const glm::dvec2& to)
    : a(from), b(to), length_m(glm::length(to - from)) {
  const glm::dvec2 along = (b - a) / length_m;
  out = {along.y, -along.x};
}

void Facade::keep_clear_of(const glm::dvec2& previous, const glm::dvec2& next) {
  const auto cotangent = [](const glm::dvec2& p, const glm::dvec2& q) {  // of half the angle from q to -p
    const double sine = p.x * q.y - p.y * q.x, cosine = -glm::dot(p, q);
    return sine > 0 ? (1 + cosine) / sine : 0.0;
  };
  const glm::dvec2 along = (b - a) / length_m;
  clear_a = cotangent(glm::normalize(a - previous), along);
  clear_b = cotangent(along, glm::normalize(next - b));
}

void FacadeDeriver::derive(const Facade& facade, const Rectangle& rectangle, uint32_t state,
                           RandomPlace place) {
  lines_.clear();
  split(facade, rectangle, state, place, 0);
}

// The rule by weight, among those that are not too large for the rectangle.
const Choice* FacadeDeriver::choose(const State& state, const Rectangle& r, RandomPlace place) const {
  const auto possible = [&](const Choice& choice) {
    return fits(rules_->splits[choice.split], r.u1 - r.u0, r.v1 - r.v0);
  };
  double weights = 0;
  for (const Choice& choice : state.choices)
    if (possible(choice)) weights += choice.weight;
  double rest = weights * place.number(rule_number);
  const Choice* chosen = nullptr;
  for (const Choice& choice : state.choices) {
    if (!possible(choice)) continue;
    chosen = &choice;
    if ((rest -= choice.weight) < 0) break;
  }
  return chosen;
}

void FacadeDeriver::split(const Facade& facade, const Rectangle& r, uint32_t state, RandomPlace place,
                          int depth) {
  const Choice* choice =
      r.u1 - r.u0 < least_m || r.v1 - r.v0 < least_m ? nullptr : choose(rules_->states[state], r, place);
  if (choice == nullptr) return wall(facade, r);
  const Split& split = rules_->splits[choice->split];
  const auto refuse = [&] {
    throw bad_input(split.file, split.place,
                    "never ends, or splits too finely for the building; use larger sizes");
  };
  // Before there is memory for them: a wall may be as long as the plan says.
  if (most_parts(split, r.u1 - r.u0, r.v1 - r.v0) > static_cast<double>(most_cells)) refuse();
  const size_t columns_begin = lines_.size();
  uint64_t n = append_columns(split, r.u0, r.u1, place, first_split_number, lines_);
  const size_t rows_begin = lines_.size();
  n = append_rows(split, r.v0, r.v1, place, n, lines_);
  const size_t columns = rows_begin - columns_begin, rows = lines_.size() - rows_begin;
  cells_ += columns * rows;
  if (cells_ > most_cells || depth >= most_deep) refuse();
  uint64_t cell_number = 0;
  double u0 = r.u0;
  for (size_t i = 0; i < columns; ++i) {
    const double u1 = lines_[columns_begin + i];
    double v0 = r.v0;
    for (size_t j = 0; j < rows; ++j, ++cell_number) {
      const double v1 = lines_[rows_begin + j];
      const Rectangle cell{u0, u1, v0, v1};
      const size_t which = split.type == Split::Type::fixed ? cell_number
                           : choice->cells.size() == 1
                               ? 0
                               : weighted(choice->cell_weights, place.number(n + cell_number));
      const Successor next = choice->cells[which];
      if (next.is_terminal) {
        put(rules_->terminals[next.index], facade, cell);
      } else {
        this->split(facade, cell, next.index, place.child(cell_number), depth + 1);
      }
      v0 = v1;
    }
    u0 = u1;
  }
  lines_.resize(columns_begin);
}

void FacadeDeriver::put(const Terminal& terminal, const Facade& facade, const Rectangle& r) {
  if (r.u0 < terminal.recess_m * facade.clear_a ||
      facade.length_m - r.u1 < terminal.recess_m * facade.clear_b)
    return wall(facade, r);
  vertices_.clear();
  for (size_t i = 0; i < terminal.vertices.size(); ++i) {
    const glm::dvec3& p = terminal.vertices[i];
    const glm::dvec3 position = facade.at(r.u0 * (1 - p.x) + r.u1 * p.x, r.v0 * (1 - p.y) + r.v1 * p.y, p.z);
    vertices_.push_back(terminal.at_border[i] ? mesh_->shared(position) : mesh_->lone(position));
  }
  for (const Face& face : terminal.faces)
    mesh_->face({vertices_[face.corner[0]], vertices_[face.corner[1]], vertices_[face.corner[2]],
                 vertices_[face.corner[3]]},
                face.layer);
}

}  // namespace veduta::city
