#include "viewer/window/hud_panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/color_space.hpp>

#include "scene/text.h"

namespace veduta {
namespace {

const ImVec4 quiet{0.62f, 0.66f, 0.70f, 1};
const ImVec4 plain{0.94f, 0.95f, 0.96f, 1};
const ImVec4 warning{1.0f, 0.72f, 0.20f, 1};

void write(const ImVec4& colour, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopStyleColor();
}

// 1,234,567
std::string grouped(uint64_t number) {
  std::string digits = std::to_string(number);
  for (size_t at = digits.size(); at > 3;) digits.insert(at -= 3, ",");
  return digits;
}

// A panel of our own at a corner or in the middle: `pivot` 0 left or top, 1 right or bottom.
bool begin_panel(const char* name, const HudScale& scale, const glm::vec2& pivot, const ImVec2& size) {
  const float margin = 0.8f * scale.letter;
  const glm::vec2 at = glm::vec2(margin) + pivot * (scale.size - 2 * margin);
  ImGui::SetNextWindowPos({at.x, at.y}, ImGuiCond_Always, {pivot.x, pivot.y});
  ImGui::SetNextWindowSize(size);
  return ImGui::Begin(name, nullptr,
                      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav |
                          ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
}

class Figures {
 public:
  Figures(const HudFigures& figures, const HudScale& scale) : f_(figures), scale_(scale) {}

  void show() const {
    time();
    drawn();
    cell();
    visibility();
    stereo();
    place();
  }

 private:
  void row(const char* label, const std::string& text, const ImVec4& colour = plain) const {
    write(quiet, label);
    ImGui::SameLine(5.6f * scale_.letter);
    write(colour, text);
  }

  void time() const {
    const double fps = f_.recent.frames_per_second();
    row("Frame", fmt::format("{:.1f} ms, worst {:.1f}{}", f_.recent.mean_ms(), f_.recent.worst_ms(),
                             fps > 0 ? fmt::format(", {:.{}f} fps", fps, fps < 10 ? 1 : 0) : ""));
    const std::vector<float> curve = f_.recent.curve();
    // The scale moves in steps, so that the curve does not breathe with each frame.
    const float peak = curve.empty() ? 0 : *std::max_element(curve.begin(), curve.end());
    const float top = std::max(10.0f, std::exp2(std::ceil(std::log2(peak / 10))) * 10);
    const std::string label = fmt::format("{:.0f} ms", top);
    ImGui::PushStyleColor(ImGuiCol_Text, quiet);
    ImGui::PlotLines("##curve", curve.data(), static_cast<int>(curve.size()), 0, label.c_str(), 0, top,
                     {ImGui::GetContentRegionAvail().x, 2.2f * scale_.letter});
    ImGui::PopStyleColor();
  }

  void drawn() const {
    row("Drawn", fmt::format("{} triangles", grouped(f_.last.triangles)));
    row("", fmt::format("{} objects, {} draws", grouped(f_.last.objects), grouped(f_.last.draws)));
  }

  void cell() const {
    const PvsIndex& index = f_.index;
    if (f_.last.cell < 0 || static_cast<uint64_t>(f_.last.cell) >= index.cells.size()) {
      row("Cell", "none here", f_.state.pvs == PvsUse::off ? plain : warning);
      return row("", "");
    }
    const auto cell = static_cast<uint32_t>(f_.last.cell);
    row("Cell", fmt::format("{}{}", grouped(cell), f_.state.frozen ? " (frozen)" : ""));
    std::string text = fmt::format("{} objects", grouped(index.row_size(cell)));
    if (cell < index.bake_us.size()) text += fmt::format(", baked in {:.3g} ms", index.bake_us[cell] / 1e3);
    row("", text);
  }

  void visibility() const {
    static constexpr const char* pvs[] = {"off", "whole buildings", "slices"};
    static constexpr const char* culling[] = {"single location", "multiple location", "none"};
    const bool all = f_.last.all_drawn && f_.state.pvs != PvsUse::off;
    row("PVS",
        fmt::format("{}{}", pvs[static_cast<size_t>(f_.state.pvs)], all ? "; everything is drawn here" : ""),
        all ? warning : plain);
    row("Culling", culling[static_cast<size_t>(f_.state.culling)]);
    const CityStream::Status& city = f_.stream;
    const bool loading = f_.last.waiting || city.pages_missing > 0;
    row("City",
        fmt::format("{} pages, {:.0f} MB{}", grouped(city.pages_here),
                    static_cast<double>(city.bytes_here) / 1e6,
                    loading ? fmt::format("; {} to come", grouped(city.pages_missing)) : ""),
        loading ? warning : plain);
  }

  void stereo() const {
    const Optics& optics = f_.state.optics;
    const auto words = stereo_mode_words();
    row("Stereo", fmt::format("{}{}", words[static_cast<size_t>(f_.state.stereo)],
                              f_.state.swap_eyes ? ", eyes swapped" : ""));
    if (f_.state.stereo == StereoMode::mono) return;
    row("Eyes",
        fmt::format("{:.3g} mm apart, screen at {:.3g} m", optics.iod_m * 1000, optics.screen_distance_m));
    const bool too_far = uncomfortable(f_.state);
    row("Parallax",
        fmt::format("{:.2f}° at infinity{}", parallax_at_infinity_deg(optics),
                    too_far ? fmt::format(", over {:.1f}°", comfortable_parallax_deg) : ""),
        too_far ? warning : plain);
  }

  void place() const {
    const Pose& pose = f_.state.pose;
    row("At",
        fmt::format("{:.1f}, {:.1f}, {:.1f} m", pose.position_m.x, pose.position_m.y, pose.position_m.z));
    row("", fmt::format("yaw {:.0f}°, pitch {:.0f}°", pose.yaw_deg, pose.pitch_deg));
  }

  const HudFigures& f_;
  const HudScale& scale_;
};

constexpr const char* gap = "   ";  // between the columns of the help

struct HelpShape {
  size_t columns = 1;
  float shrink = 1;  // of the letters
};

// As many columns as leave the letters largest.
HelpShape shape_help(std::span<const KeyBinding> keys, const HudScale& scale) {
  float name = 0, does = 0;
  for (const KeyBinding& key : keys) {
    name = std::max(name, ImGui::CalcTextSize(key.name).x);
    does = std::max(does, ImGui::CalcTextSize((std::string(key.does) + gap).c_str()).x);
  }
  const glm::vec2 room = scale.size - 4 * scale.letter;
  const float column = name + does + 2 * scale.letter, line = ImGui::GetTextLineHeightWithSpacing() + 2;
  HelpShape best{1, 0};
  for (size_t columns = 1; columns <= 4; ++columns) {
    const size_t rows = (keys.size() + columns - 1) / columns;
    const float shrink = std::min(
        {1.0f, room.x / (static_cast<float>(columns) * column), room.y / (static_cast<float>(rows) * line)});
    if (shrink > best.shrink) best = {columns, shrink};
  }
  best.shrink = std::max(best.shrink, 0.3f);
  return best;
}

}  // namespace

bool uncomfortable(const ViewState& state) {
  return state.stereo != StereoMode::mono &&
         parallax_at_infinity_deg(state.optics) > comfortable_parallax_deg;
}

void figures_panel(const HudFigures& figures, const HudScale& scale) {
  if (begin_panel("figures", scale, {0, 0}, {21 * scale.letter, 0})) Figures(figures, scale).show();
  ImGui::End();
}

void help_panel(std::span<const KeyBinding> keys, const HudScale& scale) {
  const HelpShape shape = shape_help(keys, scale);
  const size_t rows = (keys.size() + shape.columns - 1) / shape.columns;
  ImGui::SetNextWindowBgAlpha(0.93f);  // a small picture has no room beside the figures
  if (begin_panel("help", scale, {1, 0.5f}, {0, 0})) {
    ImGui::SetWindowFontScale(shape.shrink);
    if (ImGui::BeginTable("keys", static_cast<int>(2 * shape.columns), ImGuiTableFlags_SizingFixedFit)) {
      for (size_t row = 0; row < rows; ++row) {
        ImGui::TableNextRow();
        for (size_t column = 0; column < shape.columns && column * rows + row < keys.size(); ++column) {
          const KeyBinding& binding = keys[column * rows + row];
          ImGui::TableSetColumnIndex(static_cast<int>(2 * column));
          write(warning, binding.name);
          ImGui::TableSetColumnIndex(static_cast<int>(2 * column + 1));
          write(plain, std::string(binding.does) + gap);
        }
      }
      ImGui::EndTable();
    }
  }
  ImGui::End();
}

void legend_panel(const std::vector<std::pair<std::string, std::vector<LegendEntry>>>& parts,
                  const HudScale& scale) {
  if (begin_panel("legend", scale, {0, 1}, {0, 0}))
    for (const auto& [title, entries] : parts) {
      write(quiet, title);
      for (const LegendEntry& entry : entries) {
        const glm::vec3 c = glm::convertLinearToSRGB(entry.colour);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float side = scale.letter;
        ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + 1.6f * side, at.y + side},
                                                  ImGui::GetColorU32({c.r, c.g, c.b, 1}));
        ImGui::Dummy({1.6f * side, side});
        ImGui::SameLine();
        write(plain, entry.text);
      }
    }
  ImGui::End();
}

void messages_panel(const std::vector<std::string>& lines, const HudScale& scale) {
  float width = 0;
  for (const std::string& line : lines) width = std::max(width, ImGui::CalcTextSize(line.c_str()).x);
  width = std::min(width + 1 + 2 * ImGui::GetStyle().WindowPadding.x, 0.8f * scale.size.x);
  if (begin_panel("messages", scale, {0.5f, 1}, {width, 0})) {
    ImGui::PushTextWrapPos(0);
    for (const std::string& line : lines) write(plain, line);
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
}

}  // namespace veduta
