// The field in which a building is searched by name, and what was found.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "pvs/pvs_stream.h"
#include "viewer/window/hud_panels.h"
#include "viewer/window/name_search.h"

namespace veduta {

class SearchField {
 public:
  /// At the top, in the middle; between ImGui's NewFrame() and Render().
  /// \return the object that was chosen with Enter.
  std::optional<uint32_t> show(const PvsIndex& index, const HudScale& scale);
  /// It is not shown: the next time it begins empty.
  void hide();

 private:
  void list(const PvsIndex& index, const HudScale& scale) const;

  const PvsIndex* searched_ = nullptr;  ///< whose names are in `names_`
  NameSearch names_;
  std::string text_, found_text_;
  NameSearch::Found found_;
  size_t selected_ = 0;
};

}  // namespace veduta
