#include "tools/bench/readback.hpp"

#include <chrono>
#include <cstring>
#include <utility>
#include <vector>

#include "ig/gpu_fence.hpp"
#include "ig/picture.hpp"
#include "tools/bench/median.hpp"

namespace eyepoint::tools {

namespace {

constexpr std::size_t kTimes = 41;

template <typename Work>
double took_ms(const Work& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

ReadbackTimes time_readback(const ig::FrameBuffer& frame_buffer) {
    ig::Picture picture;
    frame_buffer.read(picture);
    const std::vector<std::uint8_t> from = picture.rgba;
    std::vector<std::uint8_t> to(from.size());
    std::vector<double> reads, copies;
    (void)ig::wait_for_gpu();
    for (std::size_t i = 0; i < kTimes; ++i) {
        reads.push_back(took_ms([&] { frame_buffer.read(picture); }));
        copies.push_back(took_ms([&] { std::memcpy(to.data(), from.data(), from.size()); }));
    }
    return {median(std::move(reads)), median(std::move(copies))};
}

}  // namespace eyepoint::tools
