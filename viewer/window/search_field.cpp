#include "viewer/window/search_field.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "scene/text.h"

namespace veduta {
namespace {

constexpr size_t most_shown = 12;

}  // namespace

void SearchField::hide() {
  text_.clear(), found_text_.clear();
  found_ = {};
}

std::optional<uint32_t> SearchField::show(const PvsIndex& index, const HudScale& scale) {
  if (searched_ != &index) names_ = NameSearch(index.objects), searched_ = &index;
  const float width = std::min(36 * scale.letter, scale.size.x - 1.6f * scale.letter);
  ImGui::SetNextWindowPos({scale.size.x / 2, 0.8f * scale.letter}, ImGuiCond_Always, {0.5f, 0});
  ImGui::SetNextWindowSize({width, 0});
  bool entered = false;
  // By keys alone: in most stereo modes the mouse points at nothing of one eye's picture.
  if (ImGui::Begin("search", nullptr,
                   ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMouseInputs |
                       ImGuiWindowFlags_NoSavedSettings)) {
    ImGui::SetNextItemWidth(-1);
    if (!ImGui::IsAnyItemActive()) ImGui::SetKeyboardFocusHere();
    entered = ImGui::InputTextWithHint("##name", "name of a building; Enter goes there, Escape closes",
                                       &text_, ImGuiInputTextFlags_EnterReturnsTrue);
    if (text_ != found_text_) {
      found_ = names_.find(text_, most_shown), found_text_ = text_;
      selected_ = 0;
    }
    const auto pressed = [](ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); };
    if (pressed(ImGuiKey_DownArrow) && selected_ + 1 < found_.objects.size()) ++selected_;
    if (pressed(ImGuiKey_UpArrow) && selected_ > 0) --selected_;
    list(index, scale);
  }
  ImGui::End();
  if (!entered || found_.objects.empty()) return std::nullopt;
  return found_.objects[selected_];
}

void SearchField::list(const PvsIndex& index, const HudScale& scale) const {
  if (text_.empty()) return;
  const auto cell = [](int column, const std::string& text) {
    ImGui::TableSetColumnIndex(column);
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
  };
  if (ImGui::BeginTable("found", 3, ImGuiTableFlags_SizingFixedFit)) {
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("kind", ImGuiTableColumnFlags_WidthFixed, 6 * scale.letter);
    ImGui::TableSetupColumn("triangles", ImGuiTableColumnFlags_WidthFixed, 8 * scale.letter);
    for (size_t i = 0; i < found_.objects.size(); ++i) {
      const Object& object = index.objects[found_.objects[i]];
      ImGui::TableNextRow();
      if (i == selected_)
        ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg0, ImGui::GetColorU32(ImGuiCol_Header));
      cell(0, printable(object.name));
      cell(1, kind_name(object.kind));
      cell(2, fmt::format("{} triangles", object.triangle_end - object.triangle_begin));
    }
    ImGui::EndTable();
  }
  if (found_.all == 0) ImGui::TextUnformatted("no name has this in it");
  if (found_.all > found_.objects.size()) ImGui::Text("and %zu more", found_.all - found_.objects.size());
}

}  // namespace veduta
