#include "ig/hud/hud.hpp"

#include <algorithm>

#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

namespace eyepoint::ig {

namespace {

/// Pixels at scale 1.
constexpr int kMargin = 8, kPadding = 6, kWidth = 320, kGraphHeight = 44, kLabelWidth = 80;
constexpr int kLetterHeight = 13, kLineGap = 3, kLineHeight = kLetterHeight + kLineGap;
constexpr int kGraphs = 2;
constexpr int kHeight = 2 * kPadding + kGraphs * (kLineHeight + kGraphHeight + kLineGap) +
                        static_cast<int>(kHudLines) * kLineHeight;
constexpr int kRowsPerScale = 720;

constexpr ImGuiWindowFlags kPlainBox = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                       ImGuiWindowFlags_NoFocusOnAppearing;
constexpr float kBoxOpacity = 0.72F;
const ImVec4 kText{0.96F, 0.97F, 0.98F, 1.0F}, kLabel{0.66F, 0.74F, 0.82F, 1.0F};
constexpr ImU32 kLimit = IM_COL32(255, 96, 80, 255);

float scaled(int pixels, int scale) { return static_cast<float>(pixels * scale); }

ImVec2 scaled(int x, int y, int scale) { return {scaled(x, scale), scaled(y, scale)}; }

void set_style(int scale) {
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowPadding = scaled(kPadding, kPadding, scale);
    style.ItemSpacing = scaled(kPadding, kLineGap, scale);
    style.FramePadding = {0.0F, 0.0F};
    style.WindowBorderSize = 0.0F;
    style.WindowRounding = 0.0F;
    style.Colors[ImGuiCol_Text] = kText;
    style.Colors[ImGuiCol_WindowBg] = {0.03F, 0.05F, 0.08F, kBoxOpacity};
    style.Colors[ImGuiCol_FrameBg] = {1.0F, 1.0F, 1.0F, 0.08F};
    style.Colors[ImGuiCol_PlotLines] = {0.45F, 0.85F, 1.0F, 1.0F};
}

/// A graph from 0 to `top`, with a line across at `limit` where that is above 0.
void draw_graph(const char* id, const HudHistory::Ring& values, std::size_t oldest, double top,
                double limit) {
    ImGui::PlotLines(id, values.data(), static_cast<int>(values.size()), static_cast<int>(oldest), nullptr,
                     0.0F, static_cast<float>(top),
                     {ImGui::GetContentRegionAvail().x, ImGui::GetWindowHeight() * kGraphHeight / kHeight});
    if (limit <= 0.0) return;
    const ImVec2 upper_left = ImGui::GetItemRectMin(), lower_right = ImGui::GetItemRectMax();
    const float share = static_cast<float>(limit / top);
    const float y = lower_right.y - share * (lower_right.y - upper_left.y);
    ImGui::GetWindowDrawList()->AddLine({upper_left.x, y}, {lower_right.x, y}, kLimit);
}

void text(const std::string& line) { ImGui::TextUnformatted(line.data(), line.data() + line.size()); }

}  // namespace

void Hud::Release::operator()(ImGuiContext* context) const {
    ImGui::SetCurrentContext(context);
    if (ImGui::GetIO().BackendRendererUserData != nullptr) ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext(context);
}

tl::expected<Hud, std::string> Hud::create(PictureSize size) {
    Hud made{std::max(size.height_px / kRowsPerScale, 1)};
    if (ImGui_ImplOpenGL3_Init("#version 450 core")) {
        ImGui_ImplOpenGL3_NewFrame();
        return made;
    }
    return tl::unexpected(
        std::string("the HUD needs libGL.so.1, which cannot be loaded; install libgl1 to see it"));
}

Hud::Hud(int scale) : scale_(scale), context_(ImGui::CreateContext()) {
    ImGui::SetCurrentContext(context_.get());
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    ImFontConfig font;
    font.SizePixels = scaled(kLetterHeight, scale);
    io.Fonts->AddFontDefault(&font);
    set_style(scale);
}

void Hud::take(const HudReading& reading) {
    history_.add(reading.entry);
    reading_ = reading;
}

PictureRectangle Hud::rectangle() const {
    return {kMargin * scale_, kMargin * scale_, kWidth * scale_, kHeight * scale_};
}

void Hud::draw(PictureSize size) const {
    ImGui::SetCurrentContext(context_.get());
    ImGui::GetIO().DisplaySize = {static_cast<float>(size.width_px), static_cast<float>(size.height_px)};
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    ImGui::SetNextWindowPos(scaled(kMargin, kMargin, scale_));
    ImGui::SetNextWindowSize(scaled(kWidth, kHeight, scale_));
    if (ImGui::Begin("HUD", nullptr, kPlainBox)) {
        draw_graphs();
        draw_lines();
    }
    ImGui::End();
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Hud::draw_graphs() const {
    constexpr double kHeadRoom = 1.2;
    const double period_ms = 1e3 / reading_.rate_hz;
    text(fmt::format("frame {:.1f}, slowest {:.1f}, period {:.1f} ms", reading_.entry.frame_ms,
                     history_.slowest_frame_ms(), period_ms));
    draw_graph("##frame", history_.frame_ms(), history_.oldest(),
               kHeadRoom * std::max(history_.slowest_frame_ms(), period_ms), period_ms);
    text(fmt::format("tau {:.2f} px, greatest {:.2f} px", reading_.entry.drawn.tau_px,
                     history_.greatest_tau_px()));
    draw_graph("##tau", history_.tau_px(), history_.oldest(),
               kHeadRoom * std::max(history_.greatest_tau_px(), 1.0), 0.0);
}

void Hud::draw_lines() const {
    for (const HudLine& line : hud_lines(reading_, history_)) {
        ImGui::PushStyleColor(ImGuiCol_Text, kLabel);
        ImGui::TextUnformatted(line.label.data(), line.label.data() + line.label.size());
        ImGui::PopStyleColor();
        ImGui::SameLine(scaled(kLabelWidth, scale_));
        text(line.text);
    }
}

}  // namespace eyepoint::ig
