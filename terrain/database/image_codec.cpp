#include "terrain/database/image_codec.hpp"

#include <memory>

#include <fmt/format.h>
#include <turbojpeg.h>

namespace eyepoint::terrain {

namespace {

constexpr int kQuality = 90;
constexpr std::size_t kImageBytes = std::size_t{kImageTexels} * kImageTexels * 3;

struct CloseCodec {
    void operator()(void* codec) const { tjDestroy(codec); }
};
using Codec = std::unique_ptr<void, CloseCodec>;

}  // namespace

tl::expected<std::vector<std::uint8_t>, std::string> encode_image(std::span<const std::uint8_t> rgb) {
    if (rgb.size() != kImageBytes) {
        return tl::unexpected(fmt::format("a tile's picture has {} bytes, not {}", kImageBytes, rgb.size()));
    }
    const Codec codec{tjInitCompress()};
    std::vector<std::uint8_t> bytes(tjBufSize(kImageTexels, kImageTexels, TJSAMP_444));
    unsigned char* buffer = bytes.data();
    unsigned long size = bytes.size();
    if (!codec ||
        tjCompress2(codec.get(), rgb.data(), kImageTexels, 0, kImageTexels, TJPF_RGB, &buffer, &size,
                    TJSAMP_444, kQuality, TJFLAG_NOREALLOC | TJFLAG_BOTTOMUP | TJFLAG_ACCURATEDCT) != 0) {
        return tl::unexpected(
            fmt::format("a picture cannot be compressed ({})", tjGetErrorStr2(codec.get())));
    }
    bytes.resize(size);
    return bytes;
}

tl::expected<ImageData, std::string> decode_image(TileId tile, std::span<const std::uint8_t> bytes) {
    const Codec codec{tjInitDecompress()};
    if (!codec) return tl::unexpected(std::string{"the JPEG decoder does not start; is memory short?"});
    int width = 0;
    int height = 0;
    int sampling = 0;
    int colours = 0;
    if (tjDecompressHeader3(codec.get(), bytes.data(), bytes.size(), &width, &height, &sampling, &colours) !=
        0) {
        return tl::unexpected(fmt::format("the image is no JPEG ({})", tjGetErrorStr2(codec.get())));
    }
    if (width != kImageTexels || height != kImageTexels) {
        return tl::unexpected(fmt::format("the image is {} x {} texels, not {} x {}", width, height,
                                          kImageTexels, kImageTexels));
    }
    ImageData image{tile, std::vector<std::uint8_t>(kImageBytes)};
    if (tjDecompress2(codec.get(), bytes.data(), bytes.size(), image.rgb.data(), kImageTexels, 0,
                      kImageTexels, TJPF_RGB,
                      TJFLAG_BOTTOMUP | TJFLAG_ACCURATEDCT | TJFLAG_STOPONWARNING) != 0) {
        return tl::unexpected(fmt::format("the image does not decode ({})", tjGetErrorStr2(codec.get())));
    }
    return image;
}

}  // namespace eyepoint::terrain
