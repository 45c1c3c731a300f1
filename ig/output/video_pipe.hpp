/// A video file made by an ffmpeg process that raw frames are piped to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include <sys/types.h>

#include <tl/expected.hpp>

#include "ig/picture.hpp"

namespace eyepoint::ig {

/// An H.264 (yuv420p, BT.709) MP4 file in the making. It grows beside its place (NAME.partial-PID.mp4) and is
/// renamed by finish(); without that it is removed. The child stands in a process group of its own, so that
/// Ctrl-C at the terminal does not reach it. SIGPIPE must be ignored (StopSignals): a dead child then shows
/// as a failed write. Thread use: one thread.
class VideoPipe {
  public:
    struct Options {
        std::filesystem::path file;
        PictureSize size;       ///< of every frame; an odd side gains a black row or column in the video
        double rate_hz = 30.0;  ///< slots of the frame clock a second; three decimals count
        std::string program = "ffmpeg";  ///< looked for on PATH
    };

    /// Checks that the file can be written and starts the child. On failure: one sentence with the remedy.
    [[nodiscard]] static tl::expected<VideoPipe, std::string> start(const Options& options);
    ~VideoPipe();
    VideoPipe(VideoPipe&& other) noexcept;
    VideoPipe& operator=(VideoPipe&&) = delete;

    /// One frame of the size that was stated, for the slot of the frame clock that it was drawn for, larger
    /// than the one before; the slots between show that one on, so that video time is real time. Waits while
    /// the child is behind.
    [[nodiscard]] tl::expected<void, std::string> write(const Picture& picture, std::uint64_t slot);
    /// Ends the child and puts the file in its place. Without a frame written there is no file, and no error.
    [[nodiscard]] tl::expected<void, std::string> finish();

  private:
    VideoPipe(const Options& options, std::filesystem::path partial);
    [[nodiscard]] tl::expected<void, std::string> spawn(const Options& options);
    [[nodiscard]] tl::expected<void, std::string> send(std::span<const std::uint8_t> bytes);
    [[nodiscard]] tl::expected<void, std::string> wait_for_child();
    [[nodiscard]] std::string describe_end(int status) const;
    void close_pipe();

    std::filesystem::path file_;
    std::filesystem::path partial_;
    PictureSize size_;
    double rate_hz_;
    int pipe_ = -1;
    pid_t child_ = -1;
    std::optional<std::uint64_t> first_slot_;
};

}  // namespace eyepoint::ig
