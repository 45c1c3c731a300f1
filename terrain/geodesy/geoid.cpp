#include "terrain/geodesy/geoid.hpp"

#include <system_error>

#include <GeographicLib/Geoid.hpp>

namespace eyepoint::terrain {

namespace {
constexpr bool kCubic = true;
constexpr bool kThreadSafe = true;
}  // namespace

tl::expected<Geoid, std::string> Geoid::load(const std::filesystem::path& pgm_file) {
    try {
        const auto folder = pgm_file.parent_path();
        return Geoid{std::make_unique<GeographicLib::Geoid>(
            pgm_file.stem().string(), folder.empty() ? "." : folder.string(), kCubic, kThreadSafe)};
    } catch (const std::exception& failure) {
        return tl::unexpected(pgm_file.string() + ": no geoid grid can be read there (" + failure.what() +
                              "); give one in GeographicLib's PGM form, or rebuild Eyepoint with Debian's "
                              "proj-data installed");
    }
}

std::filesystem::path Geoid::default_grid() {
    std::error_code failure;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", failure);
    if (!failure) {
        auto installed = program.parent_path().parent_path() / "share" / "eyepoint" / "egm96-15.pgm";
        if (std::filesystem::exists(installed, failure)) return installed;
    }
    return EYEPOINT_BUILD_SHARE_DIR "/egm96-15.pgm";
}

Geoid::Geoid(std::unique_ptr<GeographicLib::Geoid> grid) : grid_(std::move(grid)) {}
Geoid::~Geoid() = default;
Geoid::Geoid(Geoid&&) noexcept = default;
Geoid& Geoid::operator=(Geoid&&) noexcept = default;

double Geoid::undulation_m(double latitude_deg, double longitude_deg) const {
    return (*grid_)(latitude_deg, longitude_deg);
}

EllipsoidalHeight Geoid::to_ellipsoidal(double latitude_deg, double longitude_deg, MslHeight height) const {
    return EllipsoidalHeight{height.metres() + undulation_m(latitude_deg, longitude_deg)};
}

MslHeight Geoid::to_msl(double latitude_deg, double longitude_deg, EllipsoidalHeight height) const {
    return MslHeight{height.metres() - undulation_m(latitude_deg, longitude_deg)};
}

}  // namespace eyepoint::terrain
