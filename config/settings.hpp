/// Every setting of the image generator, with its default. docs/settings.md and config/eyepoint.toml describe
/// them.
#pragma once

#include <cstdint>
#include <string>

namespace eyepoint::config {

enum class OutputKind : std::uint8_t { Window, Pictures, Video, None };
enum class VerticalDatum : std::uint8_t { Msl, Ellipsoid };
enum class Switch : std::uint8_t { Off, On };
enum class TauControl : std::uint8_t { Off, On, Automatic };
enum class Shading : std::uint8_t { Forward, Deferred, Automatic };
enum class Show : std::uint8_t { Terrain, Wireframe, Levels };
enum class Pacing : std::uint8_t { Fixed, Free, Host };
enum class LodCache : std::uint8_t { Sound, FourCorner, Off };
enum class MorphBy : std::uint8_t { Distance, Time, Frames };
enum class TilePosts : std::uint8_t { Posts9, Posts17, Posts33 };
enum class ScreenError : std::uint8_t { Bound, Paper };
enum class HyperSelect : std::uint8_t { Block, Vertex };
enum class DrawWhen : std::uint8_t { Always, OnChange };

struct TerrainSettings {
    std::string database;              ///< folder of the terrain database
    std::string geoid;                 ///< EGM96 grid (GeographicLib PGM); empty: the one built with Eyepoint
    double tau_px = 1.0;               ///< tolerance in pixels, 0.1..100
    std::uint32_t loader_threads = 1;  ///< 1..16
    std::uint32_t cache_mib = 512;     ///< loaded blocks kept, 64..65536
};

struct HostSettings {
    std::string address = "0.0.0.0";  ///< local address to listen on
    std::uint16_t port = 5560;        ///< UDP port to listen on
    std::string answer_to;            ///< "HOST:PORT" for CIGI answers; empty: whoever sent last
    VerticalDatum altitude_datum = VerticalDatum::Msl;  ///< what the host's altitudes are above
    Switch extrapolation = Switch::On;  ///< whether the vehicle is moved on to the time a frame is seen at
    double end_after_silence_s = 0.0;   ///< end this long after the host's last packet; 0: never
};

struct ViewSettings {
    std::uint32_t width_px = 1280;  ///< 16..16384
    std::uint32_t height_px = 720;
    double vertical_fov_deg = 40.0;  ///< 1..170, unless the host defines the view
    double near_m = 0.5;             ///< 0.01..100
    double eye_forward_m = 0.0, eye_right_m = 0.0, eye_down_m = 0.0;  ///< eye in the vehicle's body axes
    double yaw_deg = 0.0, pitch_deg = 0.0, roll_deg = 0.0;            ///< view against the body axes
    std::uint16_t cigi_view = 0;  ///< which of a CIGI host's views this channel draws
};

struct LodSettings {
    std::string method = "nested";  ///< how blocks and their triangles are chosen
    double slack = 0.1;           ///< share of the tolerance that a cached choice may use on top of it, 0..1
    Switch morph = Switch::On;    ///< whether vertices slide from level to level
    std::uint32_t triangles = 0;  ///< of bintree, drawn at most; 0: as many as tau asks for; 0..10000000
    LodCache cache = LodCache::Sound;               ///< of selective: when a block's selection is kept
    ScreenError screen_error = ScreenError::Bound;  ///< of selective: what a vertex is judged by
    TilePosts tile_posts = TilePosts::Posts33;      ///< of tile: posts of a tile, a side
    MorphBy morph_by = MorphBy::Distance;           ///< of tile: what moves a morph on
    std::uint32_t rebuilds = 16;  ///< of tile: tiles that may change level in a frame, 1..100000
    HyperSelect hyper_select = HyperSelect::Block;  ///< of hyperblock: what is selected
    std::uint32_t hyper_level = 2;                  ///< of hyperblock: depth of its blocks in a tile, 0..3
    double hyper_blocks_tau_px =
        0.0;  ///< of hyperblock: tolerance that tiles are chosen for; 0: tau's; 0..100
};

struct RenderSettings {
    Shading shading =
        Shading::Automatic;     ///< whether the terrain's shader runs with the triangles or after them
    Show show = Show::Terrain;  ///< the terrain, or how it is drawn
    Switch hud = Switch::Off;   ///< whether figures of the run stand in the picture
};

struct FrameSettings {
    double rate_hz = 60.0;  ///< 1..1000
    Pacing pacing = Pacing::Fixed;
    DrawWhen draw = DrawWhen::Always;
    std::uint64_t frames = 0;  ///< end after so many; 0: no end
};

struct ControlSettings {
    TauControl tolerance = TauControl::Automatic;  ///< whether tau moves to keep frames in time
    double target_share = 0.85;                    ///< of a frame's period, that it may take, 0.1..1
    double tau_min_px = 0.5;                       ///< 0.1..100, at most tau_max_px
    double tau_max_px = 16.0;                      ///< 0.1..100
};

struct EnvironmentSettings {
    double visibility_m = 100000.0;   ///< 100..1000000
    double sun_azimuth_deg = 150.0;   ///< 0..360 from true north
    double sun_elevation_deg = 32.0;  ///< -90..90
};

struct OutputSettings {
    OutputKind kind = OutputKind::Window;
    std::string path;              ///< folder of pictures, or video file
    double picture_every_s = 0.0;  ///< pictures: one every so many seconds; 0: every frame
    std::string record;            ///< frame record file (JSON lines); empty: none
    std::string trace;             ///< trace file (Chrome's JSON trace events); empty: none
};

struct Settings {
    TerrainSettings terrain;
    HostSettings host;
    ViewSettings view;
    LodSettings lod;
    RenderSettings render;
    FrameSettings frame;
    ControlSettings control;
    EnvironmentSettings environment;
    OutputSettings output;
};

}  // namespace eyepoint::config
