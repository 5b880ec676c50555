#include "worker/panorama.h"

#include <epoxy/gl.h>

#include <chrono>
#include <cmath>
#include <optional>

#include "gl/handle.h"
#include "worker/box_tests.h"
#include "worker/depth_faces.h"
#include "worker/face_panes.h"
#include "worker/occluder_selection.h"

namespace veduta {
namespace {

/// Makes the buffer at least as large; what it held is lost when it grows. Twice as much as is asked for, so
/// that it seldom does.
void reserve(GLenum target, const GlBuffer& buffer, size_t& capacity, size_t bytes) {
  glBindBuffer(target, buffer.id());
  if (bytes <= capacity) return;
  capacity = 2 * bytes;
  glBufferData(target, static_cast<GLsizeiptr>(capacity), nullptr, GL_STREAM_DRAW);
}

void put(GLenum target, size_t bytes, const void* data) {
  if (bytes > 0) glBufferSubData(target, 0, static_cast<GLsizeiptr>(bytes), data);
}

/// The fewest pixels along a face for which no pixel of a ring is wider than its h where it is drawn (T3);
/// a power of two.
int pixels_for(const ClusteredWindow& window) {
  double needed = FacePanes::alignment;
  for (const ClusteredRing& ring : window.rings)
    needed = std::max(needed, ring.depth_limit_m * (1 + snapping) / ring.h_m * (1 - 1e-6));
  int pixels = FacePanes::alignment;
  while (pixels < needed) pixels *= 2;
  return pixels;
}

}  // namespace

struct Panorama::State {
  State(const std::vector<Box>& objects, const std::vector<Box>& slices, const ClusteredOccluders& occluders)
      : object_boxes(objects), slice_boxes(slices), tests(objects, slices) {
    int resolution = FacePanes::alignment;  // of the largest
    for (size_t w = 0; w < occluders.windows().size(); ++w) {
      const ClusteredWindow& window = occluders.windows()[w];
      const int pixels = pixels_for(window);
      windows.push_back({window.half_extent_m, pixels, OccluderSelection(occluders, w), FacePanes(pixels)});
      resolution = std::max(resolution, pixels);
    }
    faces.emplace(resolution, near_m);
  }
  ~State() {
    for (const Slot& slot : in_flight) glDeleteSync(slot.fence);
  }

  struct Window {
    glm::dvec3 half_extent_m;
    int resolution;
    OccluderSelection occluders;
    FacePanes panes;
  };
  /// A batch under way.
  struct Slot {
    GlBuffer objects, slices, answers;
    size_t objects_capacity = 0, slices_capacity = 0, answers_capacity = 0;
    GLsync fence = nullptr;
    std::vector<uint32_t> read_back;
  };

  std::span<const Box> object_boxes, slice_boxes;
  BoxTests tests;
  std::vector<Window> windows;
  std::optional<DepthFaces> faces;
  std::array<Slot, slots> in_flight;
  std::vector<OccluderVertex> vertices;
  std::vector<PaneDraw> draws;
  OcclusionCounters counters;
  bool measuring = false;
  std::chrono::steady_clock::time_point stage_began;

  void choose_panes(const QuestionBatch& batch, const QuestionBatch::Part& part, Window& window);
  void select(const QuestionBatch::Part& part, Window& window);
  void ask_part(const QuestionBatch& batch, const QuestionBatch::Part& part);
  /// Counts fragments of occluders that are nearer than those before; waits for them.
  template <typename DrawAll>
  void count_pixels(const DrawAll& draw_all);
  /// Adds the time since the last call to a stage, of what the renderer has finished.
  void stage(double OcclusionCounters::*ms);
};

void Panorama::State::stage(double OcclusionCounters::*ms) {
  if (!measuring) return;
  glFinish();
  const auto now = std::chrono::steady_clock::now();
  counters.*ms += std::chrono::duration<double, std::milli>(now - stage_began).count();
  stage_began = now;
}

template <typename DrawAll>
void Panorama::State::count_pixels(const DrawAll& draw_all) {
  if (!measuring) return draw_all();
  const GlQuery query;
  glBeginQuery(GL_SAMPLES_PASSED, query.id());
  draw_all();
  glEndQuery(GL_SAMPLES_PASSED);
  GLuint passed = 0;
  glGetQueryObjectuiv(query.id(), GL_QUERY_RESULT, &passed);
  counters.pixels += passed;
}

void Panorama::State::choose_panes(const QuestionBatch& batch, const QuestionBatch::Part& part,
                                   Window& window) {
  window.panes.clear();
  if (part.everywhere) {
    window.panes.add_all();
    return;
  }
  const glm::vec3 half_extent(window.half_extent_m);  // T2, as in the shader
  const auto add = [&](const Box& box) {
    if (box.empty()) return;
    const glm::vec3 middle = box.center() - part.center;
    const glm::vec3 half = glm::max(box.half_extent() - half_extent, glm::vec3(0));
    window.panes.add({middle - half, middle + half}, near_m);
  };
  for (uint32_t q = part.first_object; q < part.first_object + part.objects; ++q)
    add(object_boxes[batch.objects[q]]);
  for (uint32_t q = part.first_slice; q < part.first_slice + part.slices; ++q) {
    const SliceQuestion& slice = batch.slices[q];
    // Boxes of a slice grow with the height: the highest that is asked for holds the others.
    if (slice.low < slice.high) add(slice_boxes[slice.first_box + slice.high - 1]);
  }
}

void Panorama::State::select(const QuestionBatch::Part& part, Window& window) {
  vertices.clear(), draws.clear();
  const float pixel = 2.0f / static_cast<float>(window.resolution);
  for (const Pane& pane : window.panes.make()) {
    const auto ratio = [&](int border) { return static_cast<float>(border) * pixel - 1; };
    const FaceView view{ratio(pane.x0), ratio(pane.x1), ratio(pane.y0), ratio(pane.y1)};
    const std::vector<OccluderVertex>& chosen = window.occluders.select(pane.face, part.center, view);
    draws.push_back({pane, vertices.size(), chosen.size()});
    vertices.insert(vertices.end(), chosen.begin(), chosen.end());
  }
}

void Panorama::State::ask_part(const QuestionBatch& batch, const QuestionBatch::Part& part) {
  Window& window = windows[part.window];
  choose_panes(batch, part, window);
  select(part, window);
  stage(&OcclusionCounters::host_ms);
  count_pixels([&] { faces->draw(draws, vertices, window.resolution); });
  faces->reduce(draws, window.resolution);
  stage(&OcclusionCounters::occluders_ms);
  const TestView view{part.center, glm::vec3(window.half_extent_m), near_m, window.resolution,
                      window.panes.rows()};
  tests.objects(view, part.first_object, part.objects);
  stage(&OcclusionCounters::boxes_ms);
  tests.slices(view, part.first_slice, part.slices, batch.objects.size() + part.first_slice);
  stage(&OcclusionCounters::slices_ms);
  ++counters.parts;
  counters.occluder_triangles += vertices.size() / 2;
  counters.boxes += part.objects + part.slices;
}

Panorama::Panorama(const std::vector<Box>& object_boxes, const SliceBoxes& slices,
                   const ClusteredOccluders& occluders)
    : state_(std::make_unique<State>(object_boxes, slices.boxes, occluders)) {}

Panorama::~Panorama() = default;

void Panorama::ask(const QuestionBatch& batch, int slot) {
  State& s = *state_;
  State::Slot& flight = s.in_flight[slot];
  s.stage_began = std::chrono::steady_clock::now();
  constexpr GLenum storage = GL_SHADER_STORAGE_BUFFER;
  const size_t answers = std::max<size_t>(batch.objects.size() + batch.slices.size(), 1);
  flight.read_back.resize(batch.objects.size() + batch.slices.size());
  reserve(storage, flight.objects, flight.objects_capacity,
          std::max<size_t>(batch.objects.size(), 1) * sizeof(uint32_t));
  put(storage, batch.objects.size() * sizeof(uint32_t), batch.objects.data());
  static_assert(sizeof(SliceQuestion) == 4 * sizeof(uint32_t));
  reserve(storage, flight.slices, flight.slices_capacity,
          std::max<size_t>(batch.slices.size(), 1) * sizeof(SliceQuestion));
  put(storage, batch.slices.size() * sizeof(SliceQuestion), batch.slices.data());
  reserve(storage, flight.answers, flight.answers_capacity, answers * sizeof(uint32_t));
  glBindBufferBase(storage, objects_binding, flight.objects.id());
  glBindBufferBase(storage, slices_binding, flight.slices.id());
  glBindBufferBase(storage, answers_binding, flight.answers.id());
  for (const QuestionBatch::Part& part : batch.parts) s.ask_part(batch, part);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glDeleteSync(flight.fence);
  flight.fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  glFlush();
}

const std::vector<uint32_t>& Panorama::answers(int slot) {
  State& s = *state_;
  State::Slot& flight = s.in_flight[slot];
  s.stage_began = std::chrono::steady_clock::now();
  if (flight.fence != nullptr) {
    glClientWaitSync(flight.fence, GL_SYNC_FLUSH_COMMANDS_BIT, GL_TIMEOUT_IGNORED);
    glDeleteSync(std::exchange(flight.fence, nullptr));
  }
  if (!flight.read_back.empty()) {
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, flight.answers.id());
    glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0,
                       static_cast<GLsizeiptr>(flight.read_back.size() * sizeof(uint32_t)),
                       flight.read_back.data());
  }
  ++s.counters.read_backs;
  s.stage(&OcclusionCounters::read_back_ms);
  return flight.read_back;
}

std::vector<float> Panorama::read_face(int face) const {
  return state_->faces->read(face);
}
int Panorama::resolution(uint32_t window) const {
  return state_->windows[window].resolution;
}
const OcclusionCounters& Panorama::counters() const {
  return state_->counters;
}
OcclusionCounters& Panorama::counters() {
  return state_->counters;
}
void Panorama::measure() {
  state_->measuring = true;
}

}  // namespace veduta
