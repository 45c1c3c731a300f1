#include "tools/bench/control/choice_reuse.hpp"

#include <memory>
#include <utility>

#include "ig/lod_view.hpp"
#include "terrain/database/database.hpp"
#include "tools/bench/measure/flight.hpp"

namespace eyepoint::tools {

tl::expected<double, std::string> reuse_share(const std::filesystem::path& terrain,
                                              const std::string& lod_method, double slack,
                                              std::span<const ig::FlightEye> eyes,
                                              std::span<const ControlledFrame> frames) {
    auto database = terrain::Database::open(terrain);
    if (!database) return tl::unexpected(database.error());
    FlightOptions options;
    options.lod_method = lod_method;
    auto flight = LodFlight::create(std::make_shared<const terrain::Database>(*std::move(database)), options);
    if (!flight) return tl::unexpected(flight.error());
    const auto view = [&](std::size_t i) {
        return ig::lod_view(eyes[i].eyepoint.view, frames[i].tau_px, slack * frames[i].tau_px);
    };
    for (std::size_t i = 0; i < eyes.size(); ++i) (void)(*flight)->settle(view(i));
    (void)(*flight)->select(view(0));
    double reused = 0.0, in_view = 0.0;
    for (std::size_t i = 1; i < eyes.size(); ++i) {
        const terrain::Selection& selection = (*flight)->select(view(i));
        reused += selection.blocks_reused;
        in_view += selection.blocks_reused + selection.blocks_chosen;
    }
    return in_view > 0.0 ? reused / in_view : 0.0;
}

}  // namespace eyepoint::tools
