// From one picture per eye to the one that is shown.
#pragma once

#include <vector>

#include "viewer/image.h"
#include "viewer/stereo.h"

namespace veduta {

/// Two pictures of equal size.
Image beside(const Image& left, const Image& right);

/// `pictures` are those of eyes(mode), of equal size. Side-by-side and top-bottom keep each at full size,
/// left eye first; anaglyph is for red-cyan glasses.
Image compose(StereoMode mode, const std::vector<Image>& pictures);

}  // namespace veduta
