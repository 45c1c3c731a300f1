#include "tools/terrain/progress_bar.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace eyepoint::tools {

namespace {
constexpr std::size_t kBarColumns = 32;
constexpr auto kRedrawEvery = std::chrono::milliseconds{100};
}  // namespace

ProgressBar::ProgressBar(std::string label)
    : label_(std::move(label)), on_terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
    if (drawn_) fmt::print(stderr, "\r\x1b[K");
}

void ProgressBar::show(std::uint64_t done, std::uint64_t total) {
    const auto now = std::chrono::steady_clock::now();
    if (!on_terminal_ || total == 0 || now < next_) return;
    const double share = std::min(1.0, static_cast<double>(done) / static_cast<double>(total));
    const auto filled = static_cast<std::size_t>(share * static_cast<double>(kBarColumns));
    const double seconds = std::chrono::duration<double>(now - start_).count();
    fmt::print(stderr, "\r\x1b[K{} [{:#<{}}{:.<{}}] {:3.0f}%  {}/{}  {:.0f} s", label_, "", filled, "",
               kBarColumns - filled, share * 100.0, done, total, seconds);
    std::fflush(stderr);
    drawn_ = true;
    next_ = now + kRedrawEvery;
}

}  // namespace eyepoint::tools
