#include "ig/output/video_pipe.hpp"

#include <array>
#include <cerrno>
#include <cmath>
#include <concepts>
#include <cstring>
#include <initializer_list>
#include <string_view>
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

/// Frame slots a second as a fraction that holds three decimals, so 29.97 and 59.94 are what they say.
constexpr std::uint32_t kRateDenominator = 1000;
std::uint32_t rate_numerator(double rate_hz) {
    return static_cast<std::uint32_t>(std::lround(rate_hz * kRateDenominator));
}

std::vector<std::string> ffmpeg_arguments(const VideoPipe::Options& options,
                                          const std::filesystem::path& to) {
    // Even sides, colours as a television reads them, and every slot of the frame clock filled: by the frame
    // before, where one was late.
    const std::string filters = fmt::format(
        "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv,format=yuv420p,"
        "fps={}/{}:start_time=0:eof_action=pass",
        rate_numerator(options.rate_hz), kRateDenominator);
    std::vector<std::string> arguments{options.program, "-nostdin", "-hide_banner",
                                       "-loglevel",     "error",    "-y"};
    const auto add = [&](std::initializer_list<std::string> more) {
        arguments.insert(arguments.end(), more);
    };
    add({"-f", "ivf", "-i", "pipe:0"});
    add({"-vf", filters, "-fps_mode", "passthrough"});
    add({"-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv"});
    add({"-c:v", "libx264", "-preset", "veryfast", "-crf", "20", "-movflags", "+faststart"});
    add({"-f", "mp4", to.string()});
    return arguments;
}

/// Bytes of a little-endian format.
class LittleEndian {
  public:
    template <std::unsigned_integral Integer>
    LittleEndian& put(Integer value) {
        for (std::size_t byte = 0; byte < sizeof(Integer); ++byte) {
            bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * byte)));
        }
        return *this;
    }
    LittleEndian& put(std::string_view text) {
        bytes_.insert(bytes_.end(), text.begin(), text.end());
        return *this;
    }
    [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }

  private:
    std::vector<std::uint8_t> bytes_;
};

// IVF (wiki.multimedia.cx/index.php/Duck_IVF): the simplest container that gives each raw frame its time.
std::vector<std::uint8_t> ivf_file_header(PictureSize size, double rate_hz) {
    LittleEndian header;
    header.put("DKIF").put(std::uint16_t{0}).put(std::uint16_t{32}).put("RGBA");
    header.put(static_cast<std::uint16_t>(size.width_px)).put(static_cast<std::uint16_t>(size.height_px));
    header.put(rate_numerator(rate_hz)).put(kRateDenominator);
    header.put(std::uint32_t{0}).put(std::uint32_t{0});  // frame count unknown; unused
    return header.bytes();
}

std::vector<std::uint8_t> ivf_frame_header(std::size_t bytes, std::uint64_t slot) {
    return LittleEndian{}.put(static_cast<std::uint32_t>(bytes)).put(slot).bytes();
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
    VideoPipe pipe{options, partial};
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

VideoPipe::VideoPipe(const Options& options, std::filesystem::path partial)
    : file_(options.file), partial_(std::move(partial)), size_(options.size), rate_hz_(options.rate_hz) {}

VideoPipe::VideoPipe(VideoPipe&& other) noexcept
    : file_(std::move(other.file_)),
      partial_(std::exchange(other.partial_, {})),
      size_(other.size_),
      rate_hz_(other.rate_hz_),
      pipe_(std::exchange(other.pipe_, -1)),
      child_(std::exchange(other.child_, -1)),
      first_slot_(other.first_slot_) {}

VideoPipe::~VideoPipe() {
    if (child_ > 0) kill(child_, SIGKILL);
    close_pipe();
    if (child_ > 0) waitpid(child_, nullptr, 0);
    if (!partial_.empty()) unlink(partial_.c_str());
}

void VideoPipe::close_pipe() {
    if (pipe_ >= 0) close(std::exchange(pipe_, -1));
}

tl::expected<void, std::string> VideoPipe::write(const Picture& picture, std::uint64_t slot) {
    if (picture.size != size_) {
        return tl::unexpected(fmt::format("{}: a frame of {}x{} does not fit a video of {}x{}",
                                          file_.string(), picture.size.width_px, picture.size.height_px,
                                          size_.width_px, size_.height_px));
    }
    const bool is_first = !first_slot_;
    if (is_first) first_slot_ = slot;
    std::vector<std::uint8_t> header =
        is_first ? ivf_file_header(size_, rate_hz_) : std::vector<std::uint8_t>{};
    const auto frame_header = ivf_frame_header(picture.rgba.size(), slot - *first_slot_);
    header.insert(header.end(), frame_header.begin(), frame_header.end());
    if (auto sent = send(header); !sent) return sent;
    return send(picture.rgba);
}

tl::expected<void, std::string> VideoPipe::send(std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(pipe_, bytes.data(), bytes.size());
        if (written >= 0) {
            bytes = bytes.subspan(static_cast<std::size_t>(written));
        } else if (errno != EINTR) {
            const std::string fault = std::strerror(errno);
            if (auto ended = wait_for_child(); !ended) return ended;
            return tl::unexpected(
                fmt::format("{}: the video cannot be written on ({})", file_.string(), fault));
        }
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
    if (child_ < 0 || !first_slot_) return {};
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
