#include "viewer/window/controls.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "scene/text.h"

namespace veduta {
namespace {

constexpr float degrees_per_pixel = 0.15f, degrees_per_s = 70;
constexpr float steepest_deg = 89;  // beyond it, right and left would change places
constexpr float longest_step_s = 0.1f, times_faster = 4;
constexpr float orbit_range_m = 500, orbit_guess_m = 50;  // where nothing is in the middle of the picture
constexpr float nearest_orbit_m = 1, farthest_orbit_m = 20000;

}  // namespace

Controls::Controls(const PvsIndex& index, const ViewState& begin)
    : index_(index),
      walker_(index.navigation, baked_eye_height_m(index.header.config)),
      state_(begin),
      begin_(begin.pose) {
  if (!walker_.fits(state_.pose.position_m)) {
    movement_ = Movement::fly;
    message_ = "nobody can stand here: you fly; Tab walks from the nearest place";
  }
}

void Controls::release_keys() {
  std::fill(std::begin(held_), std::end(held_), false);
}

void Controls::turn(float right_px, float up_px) {
  Pose& pose = state_.pose;
  pose.yaw_deg = std::remainder(pose.yaw_deg - degrees_per_pixel * right_px, 360.0f);
  pose.pitch_deg = std::clamp(pose.pitch_deg + degrees_per_pixel * up_px, -steepest_deg, steepest_deg);
  if (movement_ == Movement::orbit) pose.position_m = around_m_ - orbit_distance_m_ * axes(pose).forward;
}

void Controls::wheel(float steps) {
  if (movement_ == Movement::orbit) {
    orbit_distance_m_ =
        std::clamp(orbit_distance_m_ * std::pow(0.85f, steps), nearest_orbit_m, farthest_orbit_m);
    return turn(0, 0);
  }
  const bool walks = movement_ == Movement::walk;
  float& speed = walks ? walk_speed_m_s_ : fly_speed_m_s_;
  speed = std::clamp(speed * std::pow(1.25f, steps), 0.2f, walks ? 20.0f : 2000.0f);
  message_ = fmt::format("{} at {:.1f} m/s", walks ? "walking" : "flying", speed);
}

void Controls::choose(uint32_t object) {
  state_.search = false;
  if (object >= index_.bounds.size() || index_.bounds[object].empty()) return;
  state_.chosen = object;
  const Box& box = index_.bounds[object];
  if (movement_ == Movement::orbit)
    start_orbit(box.center(), 2.5f * glm::length(box.half_extent()));
  else
    look_at(box.center());
  message_ = fmt::format("{}, {:.0f} m away", printable(index_.objects[object].name),
                         glm::distance(box.center(), state_.pose.position_m));
}

glm::vec3 Controls::step(double elapsed_s) {
  const float s = std::clamp(static_cast<float>(elapsed_s), 0.0f, longest_step_s);
  if (s <= 0) return glm::vec3(0);
  const glm::vec3 before = state_.pose.position_m;
  const float turned = held_sign(turn_right, turn_left), looked = held_sign(look_up, look_down);
  const float pixels = s * degrees_per_s / degrees_per_pixel;
  if (turned != 0 || looked != 0) turn(pixels * turned, pixels * looked);
  const glm::vec3 way(held_sign(right, left), held_sign(forwards, backwards), held_sign(up, down));
  if (way != glm::vec3(0)) move(way, s * (held_[faster] ? times_faster : 1));
  return (state_.pose.position_m - before) / s;
}

std::string Controls::take_message() {
  return std::exchange(message_, {});
}

float Controls::held_sign(Held positive, Held negative) const {
  return static_cast<float>(held_[positive]) - static_cast<float>(held_[negative]);
}

// \param way right, forwards, up: -1, 0 or 1 each
void Controls::move(const glm::vec3& way, float elapsed_s) {
  Pose& pose = state_.pose;
  const Axes a = axes(pose);
  switch (movement_) {
    case Movement::walk: {
      if (way.x == 0 && way.y == 0) return;
      if (!walker_.fits(pose.position_m)) return start_walking();
      const float yaw = glm::radians(pose.yaw_deg);
      const glm::vec2 ahead(std::cos(yaw), std::sin(yaw));
      const glm::vec2 ground = glm::normalize(way.y * ahead + way.x * glm::vec2(a.right));
      pose.position_m = walker_.walk(pose.position_m, walk_speed_m_s_ * elapsed_s * ground);
      return;
    }
    case Movement::fly:
      pose.position_m += fly_speed_m_s_ * elapsed_s *
                         glm::normalize(way.x * a.right + way.y * a.forward + way.z * glm::vec3(0, 0, 1));
      return;
    case Movement::orbit:
      wheel(5 * elapsed_s * way.y);
      // To the right of what stands in the middle: it turns the other way.
      turn(-elapsed_s * degrees_per_s / degrees_per_pixel * way.x,
           -elapsed_s * degrees_per_s / degrees_per_pixel * way.z);
      return;
  }
}

void Controls::look_at(const glm::vec3& point) {
  const glm::vec3 way = point - state_.pose.position_m;
  const float level = glm::length(glm::vec2(way));
  if (level <= 0 && way.z == 0) return;
  state_.pose.yaw_deg = glm::degrees(std::atan2(way.y, way.x));
  state_.pose.pitch_deg = std::clamp(glm::degrees(std::atan2(way.z, level)), -steepest_deg, steepest_deg);
}

void Controls::start_walking() {
  const auto place = walker_.nearest(state_.pose.position_m, index_.cells);
  movement_ = place ? Movement::walk : Movement::fly;
  if (!place) {
    message_ = "this file has no free space to walk in: you fly";
    return;
  }
  const float far_m = glm::distance(*place, state_.pose.position_m);
  message_ = far_m > 1 ? fmt::format("walking, from the nearest place, {:.0f} m away", far_m) : "walking";
  state_.pose.position_m = *place;
}

void Controls::start_orbit(const glm::vec3& around, float distance_m) {
  movement_ = Movement::orbit;
  around_m_ = around;
  orbit_distance_m_ = std::clamp(distance_m, nearest_orbit_m, farthest_orbit_m);
  look_at(around);
  turn(0, 0);
}

void Controls::next_movement() {
  switch (movement_) {
    case Movement::walk:
      movement_ = Movement::fly;
      message_ = "flying, through everything";
      return;
    case Movement::fly: {
      const Pose& pose = state_.pose;
      if (state_.chosen) {
        const Box& box = index_.bounds[*state_.chosen];
        start_orbit(box.center(), 2.5f * glm::length(box.half_extent()));
        message_ = "going around " + printable(index_.objects[*state_.chosen].name);
        return;
      }
      const glm::vec3 ahead = axes(pose).forward;
      const glm::vec3 middle =
          first_surface(index_.navigation.surfaces, pose.position_m, ahead, orbit_range_m)
              .value_or(pose.position_m + orbit_guess_m * ahead);
      start_orbit(middle, glm::distance(middle, pose.position_m));
      message_ = "going around what is in the middle of the picture";
      return;
    }
    case Movement::orbit:
      return start_walking();
  }
}

}  // namespace veduta
