/// GDAL as the terrain compiler uses it: opened read-only, its messages caught and quoted, never printed.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

class GDALDataset;

namespace eyepoint::tools {

struct CloseDataset {
    void operator()(GDALDataset* dataset) const noexcept;
};
using Dataset = std::unique_ptr<GDALDataset, CloseDataset>;

/// Registers GDAL's drivers and silences its own printing; may be called any number of times, from any
/// thread.
void start_gdal();

/// Collects what GDAL says on the calling thread while it lives. Not to be moved between threads.
class GdalMessages {
  public:
    GdalMessages();
    ~GdalMessages();
    GdalMessages(const GdalMessages&) = delete;
    GdalMessages& operator=(const GdalMessages&) = delete;
    /// The last error or warning, on one line; "no reason given" where GDAL kept silent.
    [[nodiscard]] std::string last() const;
    void note(const char* message);

  private:
    std::string last_;
};

/// "file: fault".
[[nodiscard]] std::string gdal_refusal(const std::string& file, std::string_view fault);

/// Opens a raster file, a GDAL virtual path (/vsizip/..., /vsicurl/...) or a .zip that holds one raster.
/// On failure: one sentence with the file and GDAL's reason.
[[nodiscard]] tl::expected<Dataset, std::string> open_raster(const std::string& file);

}  // namespace eyepoint::tools
