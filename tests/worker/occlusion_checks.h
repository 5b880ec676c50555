// What every method has to pass: rays into the model, and worker/reference/cell_reference.h.
#pragma once

#include <gtest/gtest.h>

#include "gl/egl_context.h"
#include "tests/worker/occlusion_city.h"
#include "tests/worker/shoot.h"
#include "worker/occlusion_method.h"
#include "worker/reference/cell_reference.h"

namespace veduta::test {

/// Every method has to pass every test of occlusion.
inline const std::vector<std::string> occlusion_methods{"panorama", "zoom"};

inline bool gl_is_here() {
  try {
    EglContext("software");
    return true;
  } catch (const Error&) {
    return false;
  }
}
#define SKIP_WITHOUT_GL() \
  if (!test::gl_is_here()) GTEST_SKIP() << "no EGL device with OpenGL 4.3 here"

/// The answers of a method for cells.
inline std::vector<CellOcclusion> answers_of(const std::string& method, const OcclusionInput& input,
                                             const std::vector<uint32_t>& cells) {
  const EglContext context("software");
  const auto occlusion = make_occlusion_method(method, input);
  std::vector<CellOcclusion> answers;
  occlusion->bake(cells, [&](const CellOcclusion& answer) { answers.push_back(answer); });
  EXPECT_EQ(answers.size(), cells.size());
  return answers;
}

inline std::string words(const OcclusionCity& city, const reference::Witness& witness) {
  const auto point = [](const glm::dvec3& p) {
    return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) + ")";
  };
  return city.city().scene.objects[witness.object].name +
         (witness.slice ? ", slice " + std::to_string(*witness.slice) : "") + ", from " + point(witness.eye) +
         " to " + point(witness.point);
}

/// No ray meets what a row does not draw; nothing is hidden that no occluder hides.
inline void expect_nothing_wrong(const OcclusionCity& city, const reference::CellReference& exact,
                                 const std::vector<CellOcclusion>& answers, uint64_t rays_per_cell,
                                 size_t eyes_per_cell) {
  const VerifyReport report = shoot(city, answers, rays_per_cell);
  EXPECT_TRUE(report.passed()) << describe(report, city.file());
  for (const CellOcclusion& answer : answers) {
    const auto wrong = exact.wrongly_hidden(answer, city.eyes(answer.cell, eyes_per_cell));
    EXPECT_TRUE(wrong.empty()) << wrong.size() << " boxes of cell " << answer.cell
                               << " are wrongly hidden, first: " << words(city, wrong.front());
  }
}

/// How many boxes the reference finds wrongly hidden in answers from occluders that may not be what they
/// should.
inline size_t noticed(const OcclusionCity& city, const reference::CellReference& exact,
                      const std::string& method, const std::vector<WindowOccluders>& windows,
                      const std::vector<uint32_t>& cells, size_t eyes_per_cell) {
  size_t wrong = 0;
  for (const CellOcclusion& answer :
       answers_of(method, {city.city(), city.slices(), windows, city.settings}, cells))
    wrong += exact.wrongly_hidden(answer, city.eyes(answer.cell, eyes_per_cell)).size();
  return wrong;
}

/// Prepares the city; for each method, bakes all of its cells, checks the answers and asks.
template <typename Ask>
void check_methods(OcclusionCity& city, const Ask& ask) {
  city.prepare();
  const reference::CellReference exact(city.input());
  for (const std::string& method : occlusion_methods) {
    SCOPED_TRACE(method);
    const auto answers = answers_of(method, city.input(), city.all_cells());
    ASSERT_FALSE(answers.empty());
    expect_nothing_wrong(city, exact, answers, 60'000, 27);
    ask(answers);
  }
}

}  // namespace veduta::test
