#include "config/keys.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <type_traits>

#include <fmt/format.h>

namespace eyepoint::config {
namespace {

using namespace std::string_view_literals;

// In the order of the enumerators.
constexpr std::array kOutputKinds = {"window"sv, "pictures"sv, "video"sv, "none"sv};
constexpr std::array kVerticalDatums = {"msl"sv, "ellipsoid"sv};
constexpr std::array kSwitches = {"off"sv, "on"sv};
constexpr std::array kTauControls = {"off"sv, "on"sv, "automatic"sv};
constexpr std::array kShadings = {"forward"sv, "deferred"sv, "automatic"sv};
constexpr std::array kShows = {"terrain"sv, "wireframe"sv, "levels"sv};
constexpr std::array kPacings = {"fixed"sv, "free"sv, "host"sv};
constexpr std::array kLodCaches = {"sound"sv, "four_corner"sv, "off"sv};
constexpr std::array kScreenErrors = {"bound"sv, "paper"sv};
constexpr std::array kTilePosts = {"9"sv, "17"sv, "33"sv};
constexpr std::array kMorphBy = {"distance"sv, "time"sv, "frames"sv};
constexpr std::array kHyperSelects = {"block"sv, "vertex"sv};
constexpr std::array kDrawTimes = {"always"sv, "on_change"sv};

template <typename Enum>
constexpr std::span<const std::string_view> names_of() {
    if constexpr (std::is_same_v<Enum, OutputKind>) {
        return kOutputKinds;
    } else if constexpr (std::is_same_v<Enum, Switch>) {
        return kSwitches;
    } else if constexpr (std::is_same_v<Enum, TauControl>) {
        return kTauControls;
    } else if constexpr (std::is_same_v<Enum, Shading>) {
        return kShadings;
    } else if constexpr (std::is_same_v<Enum, Show>) {
        return kShows;
    } else if constexpr (std::is_same_v<Enum, Pacing>) {
        return kPacings;
    } else if constexpr (std::is_same_v<Enum, LodCache>) {
        return kLodCaches;
    } else if constexpr (std::is_same_v<Enum, ScreenError>) {
        return kScreenErrors;
    } else if constexpr (std::is_same_v<Enum, TilePosts>) {
        return kTilePosts;
    } else if constexpr (std::is_same_v<Enum, MorphBy>) {
        return kMorphBy;
    } else if constexpr (std::is_same_v<Enum, HyperSelect>) {
        return kHyperSelects;
    } else if constexpr (std::is_same_v<Enum, DrawWhen>) {
        return kDrawTimes;
    } else {
        static_assert(std::is_same_v<Enum, VerticalDatum>);
        return kVerticalDatums;
    }
}

template <auto Part, auto Member>
using Field = std::remove_cvref_t<decltype(std::declval<Settings&>().*Part.*Member)>;

template <auto Part, auto Member>
Value get_field(const Settings& settings) {
    using Type = Field<Part, Member>;
    const Type& field = settings.*Part.*Member;
    if constexpr (std::is_enum_v<Type>) {
        return std::string(names_of<Type>()[static_cast<std::size_t>(field)]);
    } else if constexpr (std::is_integral_v<Type>) {
        return static_cast<std::int64_t>(field);
    } else {
        return field;
    }
}

template <auto Part, auto Member>
void set_field(Settings& settings, const Value& value) {
    using Type = Field<Part, Member>;
    Type& field = settings.*Part.*Member;
    if constexpr (std::is_enum_v<Type>) {
        const auto names = names_of<Type>();
        field = static_cast<Type>(std::ranges::find(names, std::get<std::string>(value)) - names.begin());
    } else if constexpr (std::is_integral_v<Type>) {
        field = static_cast<Type>(std::get<std::int64_t>(value));
    } else {
        field = std::get<Type>(value);
    }
}

/// The section and the accessors of one key; the rest of the row is filled in by the functions below.
template <auto Part, auto Member>
constexpr Key row(std::string_view section, std::string_view name, std::string_view description) {
    return {.section = section,
            .name = name,
            .description = description,
            .get = get_field<Part, Member>,
            .set = set_field<Part, Member>};
}

constexpr Key text(Key key) { return key; }

constexpr Key text(Key key, std::string_view form, bool (*accepts)(std::string_view)) {
    key.form = form;
    key.accepts = accepts;
    return key;
}

constexpr Key number(double minimum, double maximum, Key key) {
    key.kind = ValueKind::Number;
    key.minimum = minimum;
    key.maximum = maximum;
    return key;
}

constexpr Key whole(double minimum, double maximum, Key key) {
    key = number(minimum, maximum, key);
    key.kind = ValueKind::Whole;
    return key;
}

constexpr Key choice(std::span<const std::string_view> choices, Key key) {
    key.kind = ValueKind::Choice;
    key.choices = choices;
    return key;
}

bool not_empty(std::string_view value) { return !value.empty(); }

bool empty_or_host_and_port(std::string_view value) {
    if (value.empty()) return true;
    const auto colon = value.rfind(':');
    if (colon == std::string_view::npos || colon == 0) return false;
    const auto port = value.substr(colon + 1);
    const bool digits = std::ranges::all_of(port, [](unsigned char c) { return std::isdigit(c) != 0; });
    return digits && !port.empty() && port.size() <= 5 && std::stoi(std::string(port)) <= 65535 &&
           std::stoi(std::string(port)) > 0;
}

constexpr std::array kSections = {
    Section{"terrain", "The Earth that is drawn"},
    Section{"host", "The simulator that sends the eyepoint"},
    Section{"view", "The picture's size, and where the eye is on the vehicle"},
    Section{"lod", "How level of detail is chosen, and how levels follow each other"},
    Section{"render", "How pictures are drawn"},
    Section{"frame", "Frame rate and end of the run"},
    Section{"control", "Every frame in time: the tolerance moves"},
    Section{"environment", "Air and sun"},
    Section{"output", "Where the frames go"},
};

constexpr auto kTerrain = &Settings::terrain;
constexpr auto kHost = &Settings::host;
constexpr auto kView = &Settings::view;
constexpr auto kLod = &Settings::lod;
constexpr auto kRender = &Settings::render;
constexpr auto kFrame = &Settings::frame;
constexpr auto kControl = &Settings::control;
constexpr auto kEnvironment = &Settings::environment;
constexpr auto kOutput = &Settings::output;

constexpr double kDayS = 86400.0;

constexpr std::array kKeys = {
    text(row<kTerrain, &TerrainSettings::database>("terrain", "database", "Folder of the terrain database")),
    text(row<kTerrain, &TerrainSettings::geoid>(
        "terrain", "geoid",
        "EGM96 grid in GeographicLib's PGM form; empty: the one that comes with Eyepoint")),
    number(0.1, 100.0,
           row<kTerrain, &TerrainSettings::tau_px>(
               "terrain", "tau_px", "Largest error of the drawn terrain that is allowed, pixels")),
    whole(1, 16,
          row<kTerrain, &TerrainSettings::loader_threads>("terrain", "loader_threads",
                                                          "Threads that read blocks")),
    whole(64, 65536,
          row<kTerrain, &TerrainSettings::cache_mib>("terrain", "cache_mib",
                                                     "Memory for blocks that have been read, MiB")),

    text(row<kHost, &HostSettings::address>("host", "address", "Local address to listen on"), "an address",
         not_empty),
    whole(0, 65535,
          row<kHost, &HostSettings::port>("host", "port",
                                          "UDP port to listen on; 0: a free one, named in the ready line")),
    text(row<kHost, &HostSettings::answer_to>(
             "host", "answer_to", "\"HOST:PORT\" that CIGI answers go to; empty: whoever sent last"),
         "\"HOST:PORT\" or nothing", empty_or_host_and_port),
    choice(kVerticalDatums,
           row<kHost, &HostSettings::altitude_datum>(
               "host", "altitude_datum",
               "What the host's altitudes are above: mean sea level (EGM96) or the WGS84 ellipsoid")),
    choice(
        kSwitches,
        row<kHost, &HostSettings::extrapolation>(
            "host", "extrapolation",
            "Whether the vehicle is moved on, by its velocities, from its packet's arrival to the time that "
            "the frame is seen at (docs/frame-timing.md)")),
    number(
        0.0, kDayS,
        row<kHost, &HostSettings::end_after_silence_s>(
            "host", "end_after_silence_s", "End this long after the host's last packet, seconds; 0: never")),

    whole(16, 16384, row<kView, &ViewSettings::width_px>("view", "width_px", "Width of the picture, pixels")),
    whole(16, 16384,
          row<kView, &ViewSettings::height_px>("view", "height_px", "Height of the picture, pixels")),
    number(
        1.0, 170.0,
        row<kView, &ViewSettings::vertical_fov_deg>(
            "view", "vertical_fov_deg", "Vertical field of view, degrees, unless the host defines the view")),
    number(0.01, 100.0,
           row<kView, &ViewSettings::near_m>("view", "near_m", "Nearest distance that is drawn, metres")),
    number(-1000.0, 1000.0,
           row<kView, &ViewSettings::eye_forward_m>(
               "view", "eye_forward_m", "Eye ahead of the vehicle's reference point, body axes, metres")),
    number(-1000.0, 1000.0,
           row<kView, &ViewSettings::eye_right_m>("view", "eye_right_m", "Eye to its right, metres")),
    number(-1000.0, 1000.0,
           row<kView, &ViewSettings::eye_down_m>("view", "eye_down_m", "Eye below it, metres")),
    number(-360.0, 360.0,
           row<kView, &ViewSettings::yaw_deg>(
               "view", "yaw_deg", "View turned right against the body axes, degrees; applied first")),
    number(-360.0, 360.0,
           row<kView, &ViewSettings::pitch_deg>("view", "pitch_deg", "View turned up, degrees; second")),
    number(-360.0, 360.0,
           row<kView, &ViewSettings::roll_deg>("view", "roll_deg", "View rolled right, degrees; third")),
    whole(0, 65535,
          row<kView, &ViewSettings::cigi_view>("view", "cigi_view",
                                               "Which of a CIGI host's views this channel draws")),

    text(row<kLod, &LodSettings::method>(
             "lod", "method",
             "How blocks and their triangles are chosen: nested, tile, bintree, selective or "
             "hyperblock"),
         "the name of a method", not_empty),
    number(0.0, 1.0,
           row<kLod, &LodSettings::slack>("lod", "slack",
                                          "What a choice of level that is kept from frame to frame may "
                                          "exceed tau_px by, as a share of it")),
    choice(kSwitches, row<kLod, &LodSettings::morph>(
                          "lod", "morph", "Whether terrain slides from level to level; otherwise it jumps")),
    whole(0, 10000000,
          row<kLod, &LodSettings::triangles>("lod", "triangles",
                                             "Triangles that the method bintree draws at most, spending them "
                                             "where the error is greatest; 0: as "
                                             "many as tau_px asks for")),
    choice(
        kLodCaches,
        row<kLod, &LodSettings::cache>(
            "lod", "cache",
            "When the method selective uses a block's vertices again: by the way flown, which holds the "
            "error to tau_px and the slack; by the test of Ueng & Chuang at the block's corners; or never")),
    choice(kScreenErrors,
           row<kLod, &LodSettings::screen_error>(
               "lod", "screen_error",
               "What the method selective judges a vertex by: a bound on the error wherever it is felt, or "
               "the formula of Ueng & Chuang at the vertex")),
    choice(kTilePosts, row<kLod, &LodSettings::tile_posts>("lod", "tile_posts",
                                                           "Posts of a tile of the method tile, a side")),
    choice(kMorphBy,
           row<kLod, &LodSettings::morph_by>(
               "lod", "morph_by",
               "What moves a tile of the method tile on from level to level: the way of the eye, seconds, or "
               "drawn frames")),
    whole(1, 100000,
          row<kLod, &LodSettings::rebuilds>(
              "lod", "rebuilds", "Tiles of the method tile that may change their mesh's level in a frame")),
    choice(kHyperSelects,
           row<kLod, &LodSettings::hyper_select>(
               "lod", "hyper_select",
               "What the method hyperblock selects: blocks, by one of the triangulations made ahead; or, to "
               "compare, single vertices (QuadTIN)")),
    whole(0, 3,
          row<kLod, &LodSettings::hyper_level>(
              "lod", "hyper_level",
              "How often the method hyperblock halves a tile of 32 x 32 cells to get its blocks")),
    number(0.0, 100.0,
           row<kLod, &LodSettings::hyper_blocks_tau_px>(
               "lod", "hyper_blocks_tau_px",
               "Tolerance that the method hyperblock chooses tiles for, where it is less than tau_px: then "
               "selection takes equally long at all tolerances above. 0: tau_px")),

    choice(kShadings,
           row<kRender, &RenderSettings::shading>(
               "render", "shading",
               "Whether terrain is shaded while its triangles are drawn, or after them, once a pixel; "
               "automatic: the "
               "faster one at the first view, so that two runs may differ by a step of brightness")),
    choice(
        kShows,
        row<kRender, &RenderSettings::show>(
            "render", "show",
            "The terrain, its triangles' edges, or its levels of detail by colour; in a window the keys N, "
            "W and L")),
    choice(kSwitches,
           row<kRender, &RenderSettings::hud>(
               "render", "hud",
               "Whether figures and graphs of the run stand in the picture's corner; in a window the key H")),

    number(1.0, 1000.0, row<kFrame, &FrameSettings::rate_hz>("frame", "rate_hz", "Frames a second")),
    choice(kPacings,
           row<kFrame, &FrameSettings::pacing>(
               "frame", "pacing",
               "When frames begin: at rate_hz, each as soon as the last is done, or with each of the host's "
               "packets")),
    choice(kDrawTimes, row<kFrame, &FrameSettings::draw>(
                           "frame", "draw", "Always, or only where the picture would differ from the last")),
    whole(0, 1e12,
          row<kFrame, &FrameSettings::frames>("frame", "frames", "End after so many frames; 0: no end")),

    choice(
        kTauControls,
        row<kControl, &ControlSettings::tolerance>(
            "control", "tolerance",
            "Whether terrain.tau_px is only where the tolerance begins, and then follows what frames cost; "
            "automatic: in a window that is not free-running. Otherwise what is drawn does not depend on the "
            "machine")),
    number(0.1, 1.0,
           row<kControl, &ControlSettings::target_share>(
               "control", "target_share", "Share of a frame's period, 1 / frame.rate_hz, that it may take")),
    number(0.1, 100.0,
           row<kControl, &ControlSettings::tau_min_px>("control", "tau_min_px",
                                                       "Least tolerance that control goes to, pixels")),
    number(0.1, 100.0,
           row<kControl, &ControlSettings::tau_max_px>("control", "tau_max_px",
                                                       "Greatest tolerance that control goes to, pixels")),

    number(100.0, 1e6,
           row<kEnvironment, &EnvironmentSettings::visibility_m>("environment", "visibility_m",
                                                                 "Meteorological visibility, metres")),
    number(0.0, 360.0,
           row<kEnvironment, &EnvironmentSettings::sun_azimuth_deg>(
               "environment", "sun_azimuth_deg", "Direction of the sun from true north clockwise, degrees")),
    number(-90.0, 90.0,
           row<kEnvironment, &EnvironmentSettings::sun_elevation_deg>(
               "environment", "sun_elevation_deg", "Height of the sun above the horizon, degrees")),

    choice(kOutputKinds,
           row<kOutput, &OutputSettings::kind>(
               "output", "kind", "A window, numbered pictures, a video file, or nothing (drawn, not kept)")),
    text(row<kOutput, &OutputSettings::path>("output", "path", "Folder of the pictures, or the video file")),
    number(0.0, kDayS,
           row<kOutput, &OutputSettings::picture_every_s>(
               "output", "picture_every_s", "Pictures: one every so many seconds; 0: every frame")),
    text(row<kOutput, &OutputSettings::record>(
        "output", "record", "Frame record, one JSON line a frame (docs/frame-record.md); empty: none")),
    text(row<kOutput, &OutputSettings::trace>(
        "output", "trace",
        "Trace of where the time goes, for ui.perfetto.dev (docs/frame-timing.md); empty: none")),
};

}  // namespace

std::string Key::full_name() const { return fmt::format("{}.{}", section, name); }

std::string Key::variable() const {
    std::string result = fmt::format("{}{}_{}", kVariablePrefix, section, name);
    std::ranges::transform(result, result.begin(),
                           [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return result;
}

std::span<const Section> sections() { return kSections; }

std::span<const Key> keys() { return kKeys; }

const Key* find_key(std::string_view full_name) {
    const auto found =
        std::ranges::find_if(kKeys, [&](const Key& key) { return key.full_name() == full_name; });
    return found == kKeys.end() ? nullptr : &*found;
}

}  // namespace eyepoint::config
