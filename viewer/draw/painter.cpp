// Follows thesis §5.1 (geometry in GPU buffers, index ranges chosen by the three bytes) with one buffer for
// the whole city and one multi-draw call in place of a buffer and a call per slice. Depth is reversed: 1
// near, 0 at infinity, so that the precision of floats lies where it is wanted.
#include "viewer/draw/painter.h"

#include <algorithm>
#include <map>
#include <vector>

#include "scene/error.h"
#include "viewer/draw/city_buffers.h"
#include "viewer/draw/city_painter.h"
#include "viewer/draw/eye_targets.h"
#include "viewer/draw/shaders.h"

namespace veduta {
namespace {

// A city needs no more than this, were no vertex of it shared.
uint64_t most_bytes(const PvsIndex& index) {
  const uint64_t triangles = index.objects.empty() ? 0 : index.objects.back().triangle_end;
  return triangles * 3 * (sizeof(MeshVertex) + order_count * sizeof(uint32_t));
}

void require_driver() {
  if (epoxy_gl_version() < 43)
    throw Error(ExitStatus::usage, "gpu: the driver lacks OpenGL 4.3; use --gpu software");
  if (epoxy_gl_version() < 45 && !epoxy_has_gl_extension("GL_ARB_clip_control"))
    throw Error(ExitStatus::usage, "gpu: the driver lacks GL_ARB_clip_control; use --gpu software");
}

// What the painter wants while it draws, and what others expect.
void set_state(bool drawing) {
  for (GLenum off : {GL_SCISSOR_TEST, GL_BLEND, GL_CULL_FACE, GL_STENCIL_TEST}) glDisable(off);
  for (GLenum own : {GL_FRAMEBUFFER_SRGB, GL_DEPTH_TEST}) drawing ? glEnable(own) : glDisable(own);
  glClipControl(GL_LOWER_LEFT, drawing ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
  glClearDepth(drawing ? 0 : 1);
  glDepthFunc(drawing ? GL_GREATER : GL_LESS);
  glDepthMask(GL_TRUE);
}

struct ObjectRun {
  uint32_t first = 0, last = 0;  ///< [first, last)
};

}  // namespace

struct Painter::State {
  State(const PvsIndex& index, uint64_t buffer_bytes, int most_samples, bool layers)
      : one_pass(layers),
        samples(most_samples),
        buffers(std::min(buffer_bytes, most_bytes(index))),
        city(index, layers),
        map(index, layers),
        object_here(index.objects.size()) {}

  /// Calls draw(first eye, eyes) with their target bound: once for all eyes together, or for each. Together
  /// pays on software GL as well: 0.90 to 0.97 of the processor time of a frame of three cities.
  template <typename Draw>
  void for_eyes(bool together, const Draw& draw) const {
    if (together && one_pass && views.size() > 1) {
      targets->bind_layers();
      draw(0, static_cast<uint32_t>(views.size()));
      return;
    }
    for (size_t eye = 0; eye < views.size(); ++eye) {
      targets->bind_eye(eye);
      draw(static_cast<int>(eye), 1u);
    }
  }
  /// The same, with the commands loaded that are for these eyes.
  template <typename Draw>
  void for_lists(std::span<const CommandList> lists, const Draw& draw) {
    for_eyes(lists.size() == 1, [&](int first, uint32_t eyes) {
      if (first == 0 || lists.size() > 1) buffers.load(lists[lists.size() > 1 ? first : 0], eyes);
      draw(first);
      buffers.draw();
    });
  }
  void whole_picture() const { glViewport(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height)); }
  void set_here(uint32_t page, bool here);
  void draw_city(std::span<const CommandList> lists, bool in_red);
  void draw_overlay();

  const bool one_pass;
  const int samples;
  CityBuffers buffers;
  CityPainter city;
  OverlayPainter overlay;
  MapPainter map;
  std::optional<EyeTargets> targets;
  std::vector<EyeView> views;
  uint32_t width = 0, height = 0;
  bool resolved = false;
  std::map<uint32_t, ObjectRun> page_objects;
  std::vector<bool> object_here;
};

Painter::Painter(const PvsIndex& index, uint64_t buffer_bytes, int samples, bool allow_one_pass) {
  require_driver();
  state_ =
      std::make_unique<State>(index, buffer_bytes, samples, allow_one_pass && layers_from_vertex_shader());
}

Painter::~Painter() = default;

std::optional<PagePlace> Painter::add(const Page& page) {
  remove(page.number);
  const std::optional<PagePlace> place = state_->buffers.add(page);
  if (!place || page.vertices.empty()) return place;
  const auto [least, greatest] =
      std::minmax_element(page.vertices.begin(), page.vertices.end(),
                          [](const MeshVertex& a, const MeshVertex& b) { return a.object < b.object; });
  state_->page_objects[page.number] = {least->object, greatest->object + 1};
  state_->set_here(page.number, true);
  return place;
}

void Painter::remove(uint32_t page) {
  state_->buffers.remove(page);
  state_->set_here(page, false);
}

void Painter::State::set_here(uint32_t page, bool here) {
  const auto found = page_objects.find(page);
  if (found == page_objects.end()) return;
  for (uint32_t object = found->second.first; object < found->second.last; ++object)
    object_here[object] = here;
  if (!here) page_objects.erase(found);
}

void Painter::begin(std::span<const EyeView> views, uint32_t width, uint32_t height) {
  State& s = *state_;
  s.views.assign(views.begin(), views.end());
  s.width = width, s.height = height, s.resolved = false;
  if (!s.targets || !s.targets->fits(views.size(), width, height)) {
    s.targets.reset();  // before the new ones are made: there may not be room for both
    s.targets.emplace(views.size(), width, height, s.samples);
  }
  set_state(true);
  s.whole_picture();
  s.targets->bind_layers();
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void Painter::draw_city(std::span<const CommandList> lists) {
  state_->draw_city(lists, false);
}

void Painter::draw_missing(std::span<const CommandList> lists) {
  state_->draw_city(lists, true);  // the same triangle has the same depth again, so what was drawn stays
}

void Painter::State::draw_city(std::span<const CommandList> lists, bool in_red) {
  city.use(views, in_red);
  for_lists(lists, [&](int first) { city.set_first_eye(first); });
}

void Painter::draw_sky() {
  const State& s = *state_;
  s.city.use_sky(s.views);
  s.for_eyes(true, [&](int first, uint32_t eyes) { s.city.draw_sky(first, eyes); });
}

void Painter::draw_boxes(std::span<const ColouredBox> boxes) {
  state_->overlay.load(boxes, {});
  state_->draw_overlay();
}

void Painter::draw_lines(std::span<const ColouredLine> lines) {
  state_->overlay.load({}, lines);
  state_->draw_overlay();
}

void Painter::State::draw_overlay() {
  const float line_px = std::max(1.5f, 2.0f * static_cast<float>(height) / 720);
  for (size_t eye = 0; eye < views.size(); ++eye) {
    const EyeView& view = views[eye];
    const float near_m = view.clip_from_offset[3].z;
    targets->bind_eye(eye);
    overlay.draw({view.position_m, view.clip_from_offset, 1.01f * near_m, {width, height}, line_px},
                 OverlayPainter::Depth::tested);
  }
}

void Painter::draw_map(const MapView& view, const CommandList& all, std::span<const MapColour> colours,
                       std::span<const ColouredBox> boxes, std::span<const ColouredLine> lines,
                       const glm::ivec4& rectangle) {
  State& s = *state_;
  constexpr int frame_px = 2;
  const auto clear = [&](int beyond, float grey) {
    glScissor(rectangle.x - beyond, rectangle.y - beyond, rectangle.z + 2 * beyond, rectangle.w + 2 * beyond);
    glClearColor(grey, grey, grey, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  };
  glDepthMask(GL_TRUE);
  glEnable(GL_SCISSOR_TEST);
  s.targets->bind_layers();
  clear(frame_px, 0.05f);
  clear(0, 0.16f);  // beyond the ground
  glViewport(rectangle.x, rectangle.y, rectangle.z, rectangle.w);
  const OverlayPainter::View look = s.map.look(view, rectangle);
  s.map.load(colours);
  s.map.use(look);
  s.for_lists({&all, 1}, [&](int first) { s.map.set_first_eye(first); });
  s.overlay.load_triangles(s.map.absent(colours, s.object_here));
  s.for_eyes(false, [&](int, uint32_t) { s.overlay.draw(look, OverlayPainter::Depth::as_surface); });
  s.overlay.load(boxes, lines);
  s.for_eyes(false, [&](int, uint32_t) { s.overlay.draw(look, OverlayPainter::Depth::ignored); });
  glDisable(GL_SCISSOR_TEST);
  s.whole_picture();
}

uint32_t Painter::end() {
  State& s = *state_;
  if (!s.resolved) s.targets->resolve();
  s.resolved = true;
  set_state(false);
  glBindVertexArray(0);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  return s.targets->pictures();
}

void Painter::bind_picture(size_t eye) {
  end();
  state_->whole_picture();
  state_->targets->bind_picture(eye);
}

size_t Painter::eye_count() const {
  return state_->views.size();
}

bool Painter::one_pass() const {
  return state_->one_pass;
}

std::string Painter::renderer() const {
  const GLubyte* name = glGetString(GL_RENDERER);
  return name ? reinterpret_cast<const char*>(name) : "unknown";
}

}  // namespace veduta
