#include "tools/terrain/gdal_session.hpp"

#include <algorithm>
#include <cctype>
#include <mutex>
#include <vector>

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_priv.h>

namespace eyepoint::tools {

namespace {

void CPL_STDCALL keep_message(CPLErr severity, CPLErrorNum, const char* message) {
    if (severity < CE_Warning) return;
    static_cast<GdalMessages*>(CPLGetErrorHandlerUserData())->note(message);
}

bool is_zip(const std::string& file) {
    if (file.size() < 4 || file.starts_with("/vsi")) return false;
    std::string ending = file.substr(file.size() - 4);
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return ending == ".zip";
}

Dataset open_read_only(const std::string& path) {
    return Dataset{static_cast<GDALDataset*>(GDALOpenEx(
        path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, nullptr, nullptr, nullptr))};
}

std::vector<std::string> zip_members(const std::string& zip) {
    std::vector<std::string> members;
    char** listing = VSIReadDirRecursive(("/vsizip/" + zip).c_str());
    for (char** member = listing; member != nullptr && *member != nullptr; ++member) {
        const std::string name = *member;
        if (!name.ends_with('/')) members.push_back("/vsizip/" + zip + "/" + name);
    }
    CSLDestroy(listing);
    return members;
}

tl::expected<Dataset, std::string> open_zip(const std::string& zip) {
    const GdalMessages messages;
    Dataset found;
    for (const std::string& member : zip_members(zip)) {
        Dataset opened = open_read_only(member);
        if (opened && found) {
            return tl::unexpected(fmt::format(
                "{}: the archive holds several rasters; name each one as /vsizip/{}/MEMBER", zip, zip));
        }
        if (opened) found = std::move(opened);
    }
    if (!found) {
        return tl::unexpected(
            fmt::format("{}: the archive holds no raster that GDAL reads ({})", zip, messages.last()));
    }
    return found;
}

}  // namespace

void CloseDataset::operator()(GDALDataset* dataset) const noexcept { GDALClose(dataset); }

void start_gdal() {
    static std::once_flag started;
    std::call_once(started, [] {
        CPLSetErrorHandler(CPLQuietErrorHandler);
        // Reading must not litter the user's data folders with .aux.xml files.
        CPLSetConfigOption("GDAL_PAM_ENABLED", "NO");
        GDALAllRegister();
    });
}

GdalMessages::GdalMessages() { CPLPushErrorHandlerEx(keep_message, this); }
GdalMessages::~GdalMessages() { CPLPopErrorHandler(); }

std::string GdalMessages::last() const { return last_.empty() ? "no reason given" : last_; }

void GdalMessages::note(const char* message) {
    last_ = message;
    std::replace(last_.begin(), last_.end(), '\n', ' ');
}

std::string gdal_refusal(const std::string& file, std::string_view fault) {
    return fmt::format("{}: {}", file, fault);
}

tl::expected<Dataset, std::string> open_raster(const std::string& file) {
    start_gdal();
    if (is_zip(file)) return open_zip(file);
    const GdalMessages messages;
    Dataset dataset = open_read_only(file);
    if (!dataset)
        return tl::unexpected(fmt::format("{}: cannot be read as a raster ({})", file, messages.last()));
    if (dataset->GetRasterCount() == 0) {
        return tl::unexpected(fmt::format(
            "{}: holds no raster of its own; name one of its subdatasets as gdalinfo lists them", file));
    }
    return dataset;
}

}  // namespace eyepoint::tools
