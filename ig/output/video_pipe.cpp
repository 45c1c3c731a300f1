#include "ig/output/video_pipe.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

#include <sys/wait.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <unistd.h>

extern char** environ;

namespace eyepoint::ig {

namespace {

/// What a child is started with; released together.
class SpawnPlan {
  public:
    explicit SpawnPlan(int standard_input) {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_adddup2(&actions_, standard_input, STDIN_FILENO);
        posix_spawnattr_init(&attributes_);
        sigset_t defaults;
        sigemptyset(&defaults);
        sigaddset(&defaults, SIGPIPE);
        posix_spawnattr_setsigdefault(&attributes_, &defaults);
        posix_spawnattr_setpgroup(&attributes_, 0);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    }
    ~SpawnPlan() {
        posix_spawn_file_actions_destroy(&actions_);
        posix_spawnattr_destroy(&attributes_);
    }
    SpawnPlan(const SpawnPlan&) = delete;
    SpawnPlan& operator=(const SpawnPlan&) = delete;

    /// 0 or an errno.
    int start(pid_t& child, std::vector<std::string>& arguments) const {
        std::vector<char*> pointers;
        for (std::string& argument : arguments) pointers.push_back(argument.data());
        pointers.push_back(nullptr);
        return posix_spawnp(&child, pointers[0], &actions_, &attributes_, pointers.data(), environ);
    }

  private:
    posix_spawn_file_actions_t actions_{};
    posix_spawnattr_t attributes_{};
};

std::vector<std::string> ffmpeg_arguments(const VideoPipe::Options& options,
                                          const std::filesystem::path& to) {
    return {options.program, "-nostdin", "-hide_banner", "-loglevel", "error", "-y",
            // what comes through the pipe
            "-f", "rawvideo", "-pixel_format", "rgb0", "-video_size",
            fmt::format("{}x{}", options.size.width_px, options.size.height_px), "-framerate",
            fmt::format("{:.9g}", options.rate_hz), "-i", "pipe:0",
            // even sides, and colours as a television reads them
            "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv,format=yuv420p",
            "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv",
            "-c:v", "libx264", "-preset", "veryfast", "-crf", "20", "-movflags", "+faststart", "-f", "mp4",
            to.string()};
}

tl::expected<void, std::string> check_writable(const std::filesystem::path& file,
                                               const std::filesystem::path& partial) {
    const int made = open(partial.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    const bool is_folder = std::filesystem::is_directory(file);
    if (made >= 0 && !is_folder) {
        close(made);
        return {};
    }
    const std::string fault = is_folder ? "it is a folder" : std::strerror(errno);
    if (made >= 0) {
        close(made);
        unlink(partial.c_str());
    }
    return tl::unexpected(
        fmt::format("{}: the video cannot be written there ({}); give --video a file in a folder that "
                    "you may write to",
                    file.string(), fault));
}

}  // namespace

tl::expected<VideoPipe, std::string> VideoPipe::start(const Options& options) {
    std::filesystem::path partial = options.file;
    partial += fmt::format(".partial-{}.mp4", getpid());
    if (auto writable = check_writable(options.file, partial); !writable)
        return tl::unexpected(writable.error());
    VideoPipe pipe{options.file, partial, options.size};
    if (auto spawned = pipe.spawn(options); !spawned) return tl::unexpected(spawned.error());
    return pipe;
}

tl::expected<void, std::string> VideoPipe::spawn(const Options& options) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
        return tl::unexpected(
            fmt::format("no pipe to {} can be made ({})", options.program, std::strerror(errno)));
    }
    pipe_ = ends[1];
    fcntl(pipe_, F_SETPIPE_SZ, 1 << 20);  // fewer turns between the two processes; a refusal does no harm
    auto arguments = ffmpeg_arguments(options, partial_);
    const int fault = SpawnPlan{ends[0]}.start(child_, arguments);
    close(ends[0]);
    if (fault == 0) return {};
    child_ = -1;
    return tl::unexpected(
        fmt::format("{} cannot be started to make the video ({}); install Debian's ffmpeg, or use "
                    "--output for pictures",
                    options.program, std::strerror(fault)));
}

VideoPipe::VideoPipe(std::filesystem::path file, std::filesystem::path partial, PictureSize size)
    : file_(std::move(file)), partial_(std::move(partial)), size_(size) {}

VideoPipe::VideoPipe(VideoPipe&& other) noexcept
    : file_(std::move(other.file_)),
      partial_(std::exchange(other.partial_, {})),
      size_(other.size_),
      pipe_(std::exchange(other.pipe_, -1)),
      child_(std::exchange(other.child_, -1)),
      any_frame_(other.any_frame_) {}

VideoPipe::~VideoPipe() {
    if (child_ > 0) kill(child_, SIGKILL);
    close_pipe();
    if (child_ > 0) waitpid(child_, nullptr, 0);
    if (!partial_.empty()) unlink(partial_.c_str());
}

void VideoPipe::close_pipe() {
    if (pipe_ >= 0) close(std::exchange(pipe_, -1));
}

tl::expected<void, std::string> VideoPipe::write(const Picture& picture) {
    if (picture.size != size_) {
        return tl::unexpected(fmt::format("{}: a frame of {}x{} does not fit a video of {}x{}",
                                          file_.string(), picture.size.width_px, picture.size.height_px,
                                          size_.width_px, size_.height_px));
    }
    any_frame_ = true;
    const std::uint8_t* next = picture.rgba.data();
    std::size_t left = picture.rgba.size();
    while (left > 0) {
        const ssize_t written = ::write(pipe_, next, left);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) {
            const int fault = errno;
            const auto ended = wait_for_child();
            return tl::unexpected(ended ? fmt::format("{}: the video cannot be written on ({})",
                                                      file_.string(), std::strerror(fault))
                                        : ended.error());
        }
        next += written;
        left -= static_cast<std::size_t>(written);
    }
    return {};
}

tl::expected<void, std::string> VideoPipe::wait_for_child() {
    close_pipe();
    int status = 0;
    while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    child_ = -1;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
    return tl::unexpected(describe_end(status));
}

std::string VideoPipe::describe_end(int status) const {
    const std::string how = WIFSIGNALED(status) ? fmt::format("was ended by signal {}", WTERMSIG(status))
                                                : fmt::format("ended with status {}", WEXITSTATUS(status));
    return fmt::format("{}: the video is not complete: ffmpeg {}; its own message is above", file_.string(),
                       how);
}

tl::expected<void, std::string> VideoPipe::finish() {
    if (child_ < 0) return {};
    if (!any_frame_) return {};
    if (auto ended = wait_for_child(); !ended) return ended;
    std::error_code fault;
    std::filesystem::rename(partial_, file_, fault);
    if (fault) {
        return tl::unexpected(
            fmt::format("{}: the video cannot be put in its place ({})", file_.string(), fault.message()));
    }
    partial_.clear();
    return {};
}

}  // namespace eyepoint::ig
