// Vertices are what the panorama draws: four floats, the position relative to the eye and the depth limit of
// a ring, quads of two indexed triangles, clipped at the limit. Instances repeat them at other depths, so
// that a draw call is as long as it has to be for its own cost to vanish.
#include "bench/bare_loop.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "bench/bare_face.h"
#include "gl/handle.h"
#include "gl/program.h"
#include "scene/ray_scene.h"

namespace veduta::bench {
namespace {

constexpr double least_loop_s = 0.05;
constexpr int tries = 5;

/// A box to the rectangle and nearest depth that it takes on a face, then four texels of the level at which
/// the rectangle is two texels wide.
constexpr const char* test_source = R"(#version 430 core
layout(local_size_x = 64) in;
uniform int count, resolution;
layout(std430, binding = 0) readonly buffer Pyramid { float farthest[]; };
layout(std430, binding = 1) readonly buffer Boxes { float boxes[]; };
layout(std430, binding = 2) writeonly buffer Answers { uint answers[]; };
void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i >= count) return;
  vec3 lower = vec3(boxes[6 * i], boxes[6 * i + 1], boxes[6 * i + 2]);
  vec3 upper = vec3(boxes[6 * i + 3], boxes[6 * i + 4], boxes[6 * i + 5]);
  float near = max(lower.z, 0.05), far = upper.z;
  vec2 lo = min(lower.xy / near, lower.xy / far), hi = max(upper.xy / near, upper.xy / far);
  ivec2 first = ivec2(clamp((lo + 1) * 0.5 * resolution - 1, vec2(0), vec2(resolution - 1)));
  ivec2 last = ivec2(clamp((hi + 1) * 0.5 * resolution + 1, vec2(0), vec2(resolution - 1)));
  int level = 0, size = resolution, offset = 0;
  while (any(greaterThan(last - first, ivec2(1)))) {
    offset += size * size, size >>= 1, ++level;
    first >>= 1, last >>= 1;
  }
  float least = min(min(farthest[offset + first.y * size + first.x], farthest[offset + first.y * size + last.x]),
                    min(farthest[offset + last.y * size + first.x], farthest[offset + last.y * size + last.x]));
  answers[i] = least > 0.05 / near ? 0u : 1u;
}
)";

double seconds_of(const std::function<void()>& work) {
  glFinish();
  const auto begin = std::chrono::steady_clock::now();
  work();
  glFinish();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// The best rate of work(times), with as many times as take long enough; the first call warms up.
double rate(double items, const std::function<void(int times)>& work) {
  work(1);
  int times = 1;
  while (times < (1 << 16) && seconds_of([&] { work(times); }) < least_loop_s) times *= 2;
  double best = 0;
  for (int n = 0; n < tries; ++n) best = std::max(best, items * times / seconds_of([&] { work(times); }));
  return best;
}

GLuint filled_buffer(const GlBuffer& buffer, GLuint binding, size_t size, const void* data) {
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffer.id());
  glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(size), data, GL_DYNAMIC_COPY);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.id());
  return buffer.id();
}

/// Box tests a second, and what it takes to fetch one answer.
void test_boxes(int resolution, BareLimits& limits) {
  constexpr size_t count = 1 << 16;
  std::mt19937 random(1);
  std::vector<float> boxes;
  for (size_t i = 0; i < count; ++i) {
    const auto real = [&](float from, float to) { return std::uniform_real_distribution(from, to)(random); };
    const float z = real(20, 500), x = real(-z, z), y = real(-0.2f * z, 0.2f * z);
    boxes.insert(boxes.end(), {x - 5, y - 5, z - 5, x + 5, y + 5, z + 5});
  }
  const std::vector<float> pyramid(2 * static_cast<size_t>(resolution) * static_cast<size_t>(resolution),
                                   0.5f);
  const GlBuffer pyramid_buffer, boxes_buffer, answers_buffer;
  filled_buffer(pyramid_buffer, 0, pyramid.size() * sizeof(float), pyramid.data());
  filled_buffer(boxes_buffer, 1, boxes.size() * sizeof(float), boxes.data());
  filled_buffer(answers_buffer, 2, count * sizeof(uint32_t), nullptr);
  const Program test = Program::compute(test_source);
  test.use();
  glUniform1i(test.uniform("resolution"), resolution);
  glUniform1i(test.uniform("count"), count);
  limits.box_tests_per_s = rate(count, [&](int times) {
    for (int n = 0; n < times; ++n) glDispatchCompute(count / 64, 1, 1);
  });
  std::vector<double> waits;
  for (int n = 0; n < 101; ++n) {
    uint32_t answer = 0;
    waits.push_back(seconds_of([&] {
      glDispatchCompute(1, 1, 1);
      glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
      glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof answer, &answer);
    }));
  }
  std::nth_element(waits.begin(), waits.begin() + 50, waits.end());
  limits.read_back_ms = 1000 * waits[50];
}

double queries_per_s(BareFace& face) {
  face.set_quads(2, 1.0f / 16);
  constexpr int count = 256;
  std::vector<GLuint> queries(count);
  glGenQueries(count, queries.data());
  face.clear();
  const double best = rate(count, [&](int times) {
    for (int n = 0; n < times; ++n) {
      for (const GLuint query : queries) {
        glBeginQuery(GL_ANY_SAMPLES_PASSED, query);
        face.draw(1, true);
        glEndQuery(GL_ANY_SAMPLES_PASSED);
      }
      for (const GLuint query : queries) {
        GLuint passed = 0;
        glGetQueryObjectuiv(query, GL_QUERY_RESULT, &passed);
      }
    }
  });
  glDeleteQueries(count, queries.data());
  return best;
}

double rays_per_s(const City& city) {
  if (city.cells.empty() || city.scene.triangles.empty()) return 0;
  const RayScene rays(city.scene);
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  std::vector<glm::vec3> directions;
  for (int n = 0; n < 1 << 14; ++n)
    directions.push_back(glm::normalize(glm::vec3(normal(random), normal(random), normal(random) + 1e-6f)));
  std::vector<Hit> hits(directions.size());
  const glm::vec3 eye = city.cells[city.cells.size() / 2].center();
  return rate(static_cast<double>(directions.size()), [&](int times) {
    for (int n = 0; n < times; ++n) rays.first_hits(eye, directions, hits, RayOrder::scattered);
  });
}

}  // namespace

BareLimits bare_limits(int resolution, const City& city) {
  BareLimits limits;
  BareFace face(resolution);
  face.set_quads(resolution / 2);
  limits.triangles_per_s = rate(face.triangles(), [&](int times) { face.clear(), face.draw(times, true); });
  limits.streamed_triangles_per_s =
      rate(face.triangles(), [&](int times) { face.clear(), face.stream(times); });
  face.set_quads(1);
  limits.pixels_per_s = rate(face.pixels(), [&](int times) { face.clear(), face.draw(times, true); });
  limits.rejected_pixels_per_s =
      rate(face.pixels(), [&](int times) { face.clear(), face.draw(times, false); });
  limits.queries_per_s = queries_per_s(face);
  test_boxes(resolution, limits);
  limits.rays_per_s = rays_per_s(city);
  return limits;
}

}  // namespace veduta::bench
