#include "worker/panorama.h"

#include <epoxy/gl.h>

#include <glm/gtc/type_ptr.hpp>
#include <glm/vector_relational.hpp>
#include <string>

#include "gl/handle.h"
#include "gl/program.h"
#include "scene/error.h"
#include "worker/cube_face.h"
#include "worker/occluder_selection.h"
#include "worker/panorama_shaders.h"

namespace veduta {
namespace {

/// Binding points of the shaders' buffers.
enum Binding : GLuint {
  pyramid_binding = 0,
  boxes_binding = 1,
  answers_binding = 2,
  slices_binding = 3,
  now_binding = 4
};

/// Vertices of quads that are drawn at a time.
constexpr size_t batch_vertices = size_t{1} << 16;

void allocate(const GlBuffer& buffer, GLuint binding, size_t bytes, const void* data) {
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffer.id());
  glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(std::max<size_t>(bytes, 4)), nullptr,
               GL_DYNAMIC_COPY);
  if (data != nullptr && bytes > 0)
    glBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(bytes), data);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.id());
}

GLuint groups(size_t items, size_t size) {
  return static_cast<GLuint>((items + size - 1) / size);
}

}  // namespace

struct Panorama::State {
  State(const std::vector<WindowOccluders>& windows, int pixels)
      : resolution(pixels),
        draw(Program::render(shader::occluder_vertex, shader::occluder_fragment)),
        reduce(Program::compute(shader::pyramid)),
        test_objects(Program::compute(std::string(shader::box_test) + shader::object_test)),
        test_slices(Program::compute(std::string(shader::box_test) + shader::slice_test)) {
    for (const WindowOccluders& window : windows)
      occluders.push_back({window.half_extent_m, OccluderSelection(window.rings)});
  }

  struct Window {
    glm::dvec3 half_extent_m;
    OccluderSelection occluders;
  };

  int resolution;
  std::vector<Window> occluders;
  Program draw, reduce, test_objects, test_slices;
  GlTexture depth;
  std::array<GlFramebuffer, face_count> framebuffers;
  GlVertexArray quads;
  GlBuffer quad_vertices, quad_indices;
  GlBuffer pyramid, boxes, answers, slices, seen_now;
  int levels = 0;
  size_t objects = 0, vertical_slices = 0;
  std::vector<uint32_t> unseen;  // the answers before any part
  std::vector<uint32_t> read_back;
  Occlusion occlusion;

  void make_targets();
  void make_quads();
  Window* smallest_around(const glm::dvec3& half_extent_m);
  void draw_face(int face, const glm::vec3& eye, Window* window);
  void build_pyramid();
  void test(const Program& program, size_t items, const glm::vec3& eye, const glm::vec3& half_extent_m);
};

void Panorama::State::make_targets() {
  const GLsizei r = resolution;
  glBindTexture(GL_TEXTURE_2D_ARRAY, depth.id());
  glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, GL_DEPTH_COMPONENT32F, r, r, face_count);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  for (int face = 0; face < face_count; ++face) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffers[face].id());
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, depth.id(), 0, face);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      throw Error(ExitStatus::defect, "occlusion: the driver takes no 32-bit float depth array of " +
                                          std::to_string(r) + " pixels");
    }
  }
  size_t texels = 0;
  for (int size = r; size > 2; size = std::max(size / 4, 1)) {
    const int next = std::max(size / 4, 1);
    texels += static_cast<size_t>(face_count) * next * next;
    ++levels;
  }
  allocate(pyramid, pyramid_binding, texels * sizeof(float), nullptr);
}

/// Room for as many quads as are drawn at a time, and the indices of the two triangles of each, once.
void Panorama::State::make_quads() {
  glBindVertexArray(quads.id());
  glBindBuffer(GL_ARRAY_BUFFER, quad_vertices.id());
  glBufferData(GL_ARRAY_BUFFER, batch_vertices * sizeof(OccluderVertex), nullptr, GL_STREAM_DRAW);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, sizeof(OccluderVertex), nullptr);
  std::vector<uint32_t> indices;
  for (uint32_t v = 0; v < batch_vertices; v += 4)
    indices.insert(indices.end(), {v, v + 1, v + 2, v, v + 2, v + 3});
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, quad_indices.id());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(uint32_t)),
               indices.data(), GL_STATIC_DRAW);
}

Panorama::State::Window* Panorama::State::smallest_around(const glm::dvec3& half_extent_m) {
  const auto volume = [](const glm::dvec3& e) { return e.x * e.y * e.z; };
  Window* smallest = nullptr;
  for (Window& window : occluders) {
    if (glm::any(glm::lessThan(window.half_extent_m, half_extent_m))) continue;
    if (smallest == nullptr || volume(window.half_extent_m) < volume(smallest->half_extent_m))
      smallest = &window;
  }
  return smallest;
}

void Panorama::State::draw_face(int face, const glm::vec3& eye, Window* window) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffers[face].id());
  glClear(GL_DEPTH_BUFFER_BIT);
  if (window == nullptr) return;
  const glm::mat3 rotation = face_from_world(face);
  glUniformMatrix3fv(draw.uniform("face_from_world"), 1, GL_FALSE, glm::value_ptr(rotation));
  const std::vector<OccluderVertex>& vertices = window->occluders.select(face, eye);
  for (size_t first = 0; first < vertices.size(); first += batch_vertices) {
    const size_t count = std::min(batch_vertices, vertices.size() - first);
    glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(count * sizeof(OccluderVertex)),
                    &vertices[first]);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(count / 4 * 6), GL_UNSIGNED_INT, nullptr);
  }
}

void Panorama::State::build_pyramid() {
  reduce.use();
  glUniform1i(reduce.uniform("depth"), 0);
  int offset = 0, size = resolution;
  int from_offset = 0;
  for (int level = 1; level <= levels; ++level) {
    const int next = std::max(size / 4, 1);
    glUniform1i(reduce.uniform("from_depth"), level == 1 ? 1 : 0);
    glUniform1i(reduce.uniform("from_offset"), from_offset);
    glUniform1i(reduce.uniform("from_size"), size);
    glUniform1i(reduce.uniform("to_offset"), offset);
    glUniform1i(reduce.uniform("to_size"), next);
    glDispatchCompute(groups(next, 8), groups(next, 8), face_count);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    from_offset = offset;
    offset += face_count * next * next;
    size = next;
  }
}

void Panorama::State::test(const Program& program, size_t items, const glm::vec3& eye,
                           const glm::vec3& half_extent_m) {
  if (items == 0) return;
  program.use();
  glUniform1i(program.uniform("depth"), 0);
  glUniform3fv(program.uniform("eye"), 1, glm::value_ptr(eye));
  glUniform3fv(program.uniform("half_extent"), 1, glm::value_ptr(half_extent_m));
  glUniform1f(program.uniform("near"), near_m);
  glUniform1i(program.uniform("resolution"), resolution);
  glUniform1i(program.uniform("levels"), levels);
  glUniform1i(program.uniform("objects"), static_cast<GLint>(objects));
  glUniform1i(program.uniform("slices"), static_cast<GLint>(vertical_slices));
  glUniform1i(program.uniform("first_slice_box"), static_cast<GLint>(objects));
  glDispatchCompute(groups(items, 64), 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

Panorama::Panorama(const std::vector<Box>& object_boxes, const SliceBoxes& slices,
                   const std::vector<WindowOccluders>& windows, int resolution)
    : state_(std::make_unique<State>(windows, resolution)) {
  State& s = *state_;
  s.make_targets();
  s.make_quads();
  s.objects = object_boxes.size();
  s.vertical_slices = slices.slices.size();
  std::vector<Box> boxes = object_boxes;
  boxes.insert(boxes.end(), slices.boxes.begin(), slices.boxes.end());
  allocate(s.boxes, boxes_binding, boxes.size() * sizeof(Box), boxes.data());
  static_assert(sizeof(VerticalSlice) == 3 * sizeof(uint32_t));
  allocate(s.slices, slices_binding, slices.slices.size() * sizeof(VerticalSlice), slices.slices.data());
  s.unseen.assign(s.objects, 0);
  for (const VerticalSlice& slice : slices.slices) s.unseen.push_back(slice.heights);
  s.read_back.resize(s.unseen.size());
  allocate(s.answers, answers_binding, s.unseen.size() * sizeof(uint32_t), s.unseen.data());
  allocate(s.seen_now, now_binding, s.objects * sizeof(uint32_t), nullptr);
  s.occlusion.visible.resize(s.objects);
  s.occlusion.occluded.resize(s.vertical_slices);

  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glClearDepth(0.0);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_CLIP_DISTANCE0);
  glViewport(0, 0, resolution, resolution);
}

Panorama::~Panorama() = default;

void Panorama::begin_cell() {
  const State& s = *state_;
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, s.answers.id());
  glBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(s.unseen.size() * sizeof(uint32_t)),
                  s.unseen.data());
}

void Panorama::add_part(const glm::vec3& center, const glm::dvec3& half_extent_m) {
  State& s = *state_;
  State::Window* window = s.smallest_around(half_extent_m);
  s.draw.use();
  glUniform1f(s.draw.uniform("near"), near_m);
  glBindVertexArray(s.quads.id());
  glBindBuffer(GL_ARRAY_BUFFER, s.quad_vertices.id());
  for (int face = 0; face < face_count; ++face) s.draw_face(face, center, window);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);  // the faces are read now
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D_ARRAY, s.depth.id());
  s.build_pyramid();
  // T2 with the window that the occluders hide for: what they hide from all of it, they hide from the part.
  const glm::vec3 hidden_for(window == nullptr ? glm::dvec3(0) : window->half_extent_m);
  s.test(s.test_objects, s.objects, center, hidden_for);
  s.test(s.test_slices, s.vertical_slices, center, hidden_for);
}

const Occlusion& Panorama::finish_cell() {
  State& s = *state_;
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, s.answers.id());
  glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0,
                     static_cast<GLsizeiptr>(s.read_back.size() * sizeof(uint32_t)), s.read_back.data());
  std::copy_n(s.read_back.begin(), s.objects, s.occlusion.visible.begin());
  std::copy(s.read_back.begin() + static_cast<std::ptrdiff_t>(s.objects), s.read_back.end(),
            s.occlusion.occluded.begin());
  return s.occlusion;
}

std::vector<float> Panorama::read_face(int face) const {
  const State& s = *state_;
  const auto r = static_cast<size_t>(s.resolution);
  std::vector<float> all(face_count * r * r);
  glBindTexture(GL_TEXTURE_2D_ARRAY, s.depth.id());
  glGetTexImage(GL_TEXTURE_2D_ARRAY, 0, GL_DEPTH_COMPONENT, GL_FLOAT, all.data());
  return {all.begin() + static_cast<std::ptrdiff_t>(face * r * r),
          all.begin() + static_cast<std::ptrdiff_t>((face + 1) * r * r)};
}

}  // namespace veduta
