// Dear ImGui lays the texts out; its own OpenGL backend draws them, on a window's context and on one without
// (it finds OpenGL's functions through libGL, which hands them to whichever context is current).
#include "viewer/window/hud.h"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "scene/error.h"
#include "scene/text.h"
#include "viewer/window/hud_panels.h"
#include "viewer/window/legend.h"
#include "viewer/window/recent_frames.h"
#include "viewer/window/search_field.h"

namespace veduta {
namespace {

constexpr double message_s = 4;
constexpr size_t most_messages = 4;

// Letters for the names of Europe's buildings, and the signs that we write.
constexpr ImWchar letters[] = {0x20, 0x24f, 0x370, 0x3ff, 0x400, 0x52f, 0x1e00, 0x1eff, 0x2010, 0x2044, 0};

// Where distributions put DejaVu Sans. Without it ImGui's own font serves, which has Latin letters only.
constexpr const char* fonts[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                 "/usr/share/fonts/TTF/DejaVuSans.ttf",
                                 "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf"};

float letter_height(const glm::vec2& size) {
  return std::clamp(std::round(std::min(size.y / 48, size.x / 44)), 10.0f, 96.0f);
}

void set_style(float letter) {
  ImGuiStyle style;
  ImGui::StyleColorsDark(&style);
  style.WindowPadding = {10, 8};
  style.ItemSpacing = {8, 3};
  style.WindowRounding = 4;
  style.WindowBorderSize = 0;
  style.Colors[ImGuiCol_WindowBg] = {0.05f, 0.06f, 0.08f, 0.78f};
  style.Colors[ImGuiCol_FrameBg] = {0.16f, 0.18f, 0.21f, 0.80f};
  style.Colors[ImGuiCol_PlotLines] = {0.55f, 0.78f, 1.0f, 1};
  style.Colors[ImGuiCol_Header] = {0.20f, 0.40f, 0.65f, 0.9f};
  style.AntiAliasedLinesUseTex = false;  // the font's texture is made anew with every size
  style.ScaleAllSizes(letter / 15);
  ImGui::GetStyle() = style;
}

}  // namespace

struct Hud::State {
  struct Message {
    std::string text;
    double left_s;
  };
  struct Shown {
    bool hud = false, help = false, search = false;
    MapShown map = MapShown::off;
    CellColour cells = CellColour::off;
    size_t messages = 0;
    glm::uvec2 picture{0};
    bool operator==(const Shown&) const = default;
  };

  ImGuiContext* context = nullptr;
  float letter = 0;
  std::optional<double> time_s;          ///< of the last layout
  bool typing = false;                   ///< is the search open?
  StereoMode stereo = StereoMode::mono;  ///< of the last layout
  std::vector<Message> messages;
  Shown shown;  ///< in the last layout
  RecentFrames recent;
  SearchField search;
  std::optional<uint32_t> chosen;
  const PvsIndex* scaled = nullptr;  ///< whose cells `scale` is of
  CellColour coloured_by = CellColour::off;
  CellScale scale;

  void use_letters(float height);
  double tick(double now_s, const FrameStats& last, const ViewState& state);
  void age_messages(double elapsed_s);
  void show(const HudFigures& figures, const HudScale& hud_scale);
  void show_legends(const ViewState& state, const PvsIndex& index, const HudScale& hud_scale);
};

void Hud::State::use_letters(float height) {
  if (height == letter) return;
  letter = height;
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  ImFontConfig config;
  config.OversampleH = 2;
  ImFont* font = nullptr;
  for (const char* file : fonts)
    if (!font && std::filesystem::exists(file))
      font = atlas.AddFontFromFileTTF(file, height, &config, letters);
  config.SizePixels = height;
  if (!font) atlas.AddFontDefault(&config);
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
  set_style(height);
}

// What is new since the last layout. Returns how long ago that was, s.
double Hud::State::tick(double now_s, const FrameStats& last, const ViewState& state) {
  const bool first = !time_s;
  const double elapsed_s = first ? 0 : std::max(0.0, now_s - *time_s);
  time_s = now_s;
  if (!first) recent.add(last.ms, elapsed_s);
  // Of other eyes and screens the controls say it, each time.
  if (std::exchange(stereo, state.stereo) != state.stereo && !first && uncomfortable(state))
    messages.push_back({"far points are more than 1.6° apart between the eyes: not comfortable", message_s});
  age_messages(elapsed_s);
  return elapsed_s;
}

void Hud::State::age_messages(double elapsed_s) {
  for (Message& message : messages) message.left_s -= elapsed_s;
  std::erase_if(messages, [](const Message& message) { return message.left_s <= 0; });
  if (messages.size() > most_messages)
    messages.erase(messages.begin(), messages.end() - static_cast<ptrdiff_t>(most_messages));
}

void Hud::State::show_legends(const ViewState& state, const PvsIndex& index, const HudScale& hud_scale) {
  std::vector<std::pair<std::string, std::vector<LegendEntry>>> parts;
  if (state.map != MapShown::off) parts.emplace_back("Map", map_legend());
  if (state.cells != CellColour::off) {
    if (scaled != &index || coloured_by != state.cells) {
      scale = cell_scale(index, state.cells);
      scaled = &index, coloured_by = state.cells;
    }
    static constexpr const char* titles[] = {"", "Cells by PVS", "Cells by time of the bake",
                                             "Cells by worker"};
    parts.emplace_back(titles[static_cast<size_t>(state.cells)], cell_legend(index, state.cells, scale));
  }
  if (!parts.empty()) legend_panel(parts, hud_scale);
}

void Hud::State::show(const HudFigures& figures, const HudScale& hud_scale) {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  const ViewState& state = figures.state;
  if (state.hud) figures_panel(figures, hud_scale);
  show_legends(state, figures.index, hud_scale);
  if (!messages.empty()) {
    std::vector<std::string> lines;
    for (const Message& message : messages) lines.push_back(message.text);
    messages_panel(lines, hud_scale);
  }
  if (state.help && !state.search) help_panel(key_bindings(), hud_scale);
  if (!state.search)
    search.hide();
  else if (const std::optional<uint32_t> object = search.show(figures.index, hud_scale))
    chosen = object;
  ImGui::Render();
}

Hud::Hud() : state_(std::make_unique<State>()) {
  IMGUI_CHECKVERSION();
  state_->context = ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // no file is written where the user happens to be
  io.LogFilename = nullptr;
  if (!ImGui_ImplOpenGL3_Init("#version 430")) {
    ImGui::DestroyContext(state_->context);
    throw Error(ExitStatus::usage, "the texts over the picture need libGL.so.1; apt-get install libgl1");
  }
  state_->use_letters(15);
}

Hud::~Hud() {
  ImGui::SetCurrentContext(state_->context);
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext(state_->context);
}

void Hud::layout(const ViewState& state, const FrameStats& last, const CityStream::Status& stream,
                 const PvsIndex& index, const glm::uvec2& picture, double time_s) {
  State& s = *state_;
  const HudScale scale{letter_height(glm::vec2(picture)), glm::vec2(picture)};
  const double elapsed_s = s.tick(time_s, last, state);
  s.use_letters(scale.letter);

  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {scale.size.x, scale.size.y};
  io.DisplayFramebufferScale = {1, 1};
  io.DeltaTime = static_cast<float>(std::clamp(elapsed_s, 1e-4, 1.0));
  const HudFigures figures{state, last, stream, index, s.recent};
  // ImGui measures what it shows for the first time, and draws it from the next time on.
  const State::Shown shown{state.hud,   state.help,        state.search, state.map,
                           state.cells, s.messages.size(), picture};
  if (std::exchange(s.shown, shown) != shown) s.show(figures, scale);
  s.show(figures, scale);
  s.typing = state.search;
}

void Hud::draw() {
  ImDrawData* const data = ImGui::GetDrawData();
  if (!data || data->TotalVtxCount == 0) return;
  // ImGui's colours are sRGB and so are the bytes of every frame buffer here: they go there as they are.
  const bool converted = glIsEnabled(GL_FRAMEBUFFER_SRGB);
  if (converted) glDisable(GL_FRAMEBUFFER_SRGB);
  ImGui_ImplOpenGL3_RenderDrawData(data);
  if (converted) glEnable(GL_FRAMEBUFFER_SRGB);
}

void Hud::say(const std::string& text) {
  state_->messages.push_back({printable(text, 200), message_s});
}

std::optional<uint32_t> Hud::chosen() {
  return std::exchange(state_->chosen, std::nullopt);
}

bool Hud::wants_keys() const {
  return state_->typing;
}

}  // namespace veduta
