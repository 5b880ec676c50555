#include "worker/box_tests.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <string>

#include "worker/depth_faces.h"
#include "worker/panorama_shaders.h"

namespace veduta {

namespace {

/// How far beside its projection a box is asked for, in pixels. T3 with sigma = 1/64 holds for a ray up to
/// 1/128 of a pixel beside the pixel whose middle an occluder covers, rounding of its vertices included: so
/// it is enough to ask the pixels that the projection touches, and a little more for the rounding of that. A
/// renderer that rounds vertices coarser than sigma allows is given the pixel beside, too.
float outward_pixels() {
  GLint subpixel_bits = 0;
  glGetIntegerv(GL_SUBPIXEL_BITS, &subpixel_bits);
  return subpixel_bits >= 6 ? 1.0f / 64 : 1.0f;
}

}  // namespace

BoxTests::Test::Test(const char* kind)
    : program(Program::compute(std::string(shader::box_test) + kind)),
      depth(program.uniform("depth")),
      eye(program.uniform("eye")),
      half_extent(program.uniform("half_extent")),
      near(program.uniform("near")),
      outward(program.uniform("outward")),
      resolution(program.uniform("resolution")),
      rows(program.uniform("rows")),
      strip_width(program.uniform("strip_width")),
      first(program.uniform("first")),
      count(program.uniform("count")) {}

void BoxTests::Test::run(const TestView& view, uint32_t first_question, uint32_t questions) const {
  glUniform1i(depth, 0);
  glUniform3fv(eye, 1, glm::value_ptr(view.eye));
  glUniform3fv(half_extent, 1, glm::value_ptr(view.half_extent_m));
  glUniform1f(near, view.near_m);
  glUniform1f(outward, outward_pixels());
  glUniform1i(resolution, view.resolution);
  glUniform2iv(rows, face_count * FacePanes::strips, view.rows[0][0].data());
  glUniform1i(strip_width, FacePanes::strip_width(view.resolution));
  glUniform1i(first, static_cast<GLint>(first_question));
  glUniform1i(count, static_cast<GLint>(questions));
  constexpr uint32_t group = 64;
  glDispatchCompute((questions + group - 1) / group, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

BoxTests::BoxTests(const std::vector<Box>& object_boxes, const std::vector<Box>& slice_boxes)
    : objects_(shader::object_test),
      slices_(shader::slice_test),
      first_answer_(slices_.program.uniform("first_answer")),
      first_slice_box_(slices_.program.uniform("first_slice_box")),
      object_count_(object_boxes.size()) {
  const auto objects = static_cast<GLsizeiptr>(object_boxes.size() * sizeof(Box)),
             slices = static_cast<GLsizeiptr>(slice_boxes.size() * sizeof(Box));
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, boxes_.id());
  glBufferData(GL_SHADER_STORAGE_BUFFER, std::max<GLsizeiptr>(objects + slices, sizeof(Box)), nullptr,
               GL_STATIC_DRAW);
  if (objects > 0) glBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, objects, object_boxes.data());
  if (slices > 0) glBufferSubData(GL_SHADER_STORAGE_BUFFER, objects, slices, slice_boxes.data());
}

void BoxTests::objects(const TestView& view, uint32_t first, uint32_t count) const {
  if (count == 0) return;
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, boxes_binding, boxes_.id());
  objects_.program.use();
  objects_.run(view, first, count);
}

void BoxTests::slices(const TestView& view, uint32_t first, uint32_t count, size_t first_answer) const {
  if (count == 0) return;
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, boxes_binding, boxes_.id());
  slices_.program.use();
  glUniform1i(first_answer_, static_cast<GLint>(first_answer));
  glUniform1i(first_slice_box_, static_cast<GLint>(object_count_));
  slices_.run(view, first, count);
}

}  // namespace veduta
