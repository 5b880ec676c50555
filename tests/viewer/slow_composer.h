// Composition of two pictures, pixel by pixel and by the words of viewer/draw/composer.h: what the shader is
// tested against.
#pragma once

#include <array>
#include <vector>

#include "viewer/draw/composer.h"
#include "viewer/image.h"

namespace veduta::slow {

/// `pictures` are those of eyes(mode), of eye_picture_size(mode, size).
Image compose(StereoMode mode, bool swap_eyes, std::vector<Image> pictures, const glm::uvec2& size,
              const glm::ivec2& screen_position);

}  // namespace veduta::slow
