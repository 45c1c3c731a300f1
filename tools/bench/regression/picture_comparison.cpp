#include "tools/bench/regression/picture_comparison.hpp"

#include <algorithm>
#include <set>
#include <system_error>

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>

namespace eyepoint::tools {

namespace {

namespace fs = std::filesystem;

std::set<std::string> names_in(const fs::path& folder) {
    std::set<std::string> names;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
        if (entry.path().extension() == ".png") names.insert(entry.path().filename().string());
    return names;
}

/// Whether two pictures are further apart than the threshold, or why they cannot be compared.
tl::expected<bool, std::string> differ(const fs::path& before, const fs::path& after,
                                       const PictureThreshold& threshold) {
    OIIO::ImageBuf one(before.string()), other(after.string());
    for (OIIO::ImageBuf* image : {&one, &other})
        if (!image->read())
            return tl::unexpected(
                fmt::format("{}: cannot be read: {}", image->name().c_str(), image->geterror()));
    if (one.spec().width != other.spec().width || one.spec().height != other.spec().height)
        return tl::unexpected(fmt::format("{} and {} differ in size", before.string(), after.string()));
    const auto result = OIIO::ImageBufAlgo::compare(one, other, threshold.step, threshold.step);
    const auto pixels = static_cast<double>(one.spec().image_pixels());
    return static_cast<double>(result.nfail) > threshold.share * pixels || result.meanerror > threshold.mean;
}

}  // namespace

tl::expected<ComparedLine, std::string> compare_picture_folders(const fs::path& before, const fs::path& after,
                                                                const PictureThreshold& threshold) {
    const std::set<std::string> names = names_in(before);
    if (names.empty()) return tl::unexpected(before.string() + " holds no picture (.png)");
    if (names != names_in(after))
        return tl::unexpected(fmt::format("{} and {} do not hold pictures of the same frames",
                                          before.string(), after.string()));
    std::size_t differing = 0;
    std::string first;
    for (const std::string& name : names) {
        const auto different = differ(before / name, after / name, threshold);
        if (!different) return tl::unexpected(different.error());
        if (*different && differing++ == 0) first = name;
    }
    const auto count = static_cast<double>(names.size());
    return ComparedLine{
        .kind = ComparedLine::Kind::Picture,
        .what = "pictures, by OpenImageIO",
        .before = count,
        .after = count,
        .change = {},
        .verdict = differing == 0 ? Verdict::Same : Verdict::Different,
        .remark = differing == 0 ? std::string{} : fmt::format("{} differ, first {}", differing, first)};
}

}  // namespace eyepoint::tools
