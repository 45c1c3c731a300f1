#include "net/pcap_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <pcap/pcap.h>
#include <unistd.h>

#include "net/nanoseconds.hpp"
#include "net/udp_datagram.hpp"

namespace eyepoint::net {

struct ClosePcap {
    void operator()(pcap_t* capture) const { pcap_close(capture); }
};
using Capture = std::unique_ptr<pcap_t, ClosePcap>;

namespace {

constexpr int kSnapshotBytes = 262144;

std::optional<LinkLayer> link_layer_of(int type) {
    switch (type) {
        case DLT_EN10MB:
            return LinkLayer::Ethernet;
        case DLT_LINUX_SLL:
            return LinkLayer::LinuxCooked;
        case DLT_LINUX_SLL2:
            return LinkLayer::LinuxCooked2;
        case DLT_RAW:
        case DLT_IPV4:
        case DLT_IPV6:
            return LinkLayer::RawIp;
        case DLT_NULL:
        case DLT_LOOP:
            return LinkLayer::BsdLoopback;
        default:
            return std::nullopt;
    }
}

void take_frame(PcapRecording& recording, const pcap_pkthdr& header, const u_char* bytes,
                LinkLayer link_layer) {
    if (header.caplen < header.len) {
        ++recording.cut_packets;
        return;
    }
    const auto content =
        look_into_frame({reinterpret_cast<const std::byte*>(bytes), header.caplen}, link_layer);
    if (content.kind == FrameContent::Kind::Fragment) ++recording.fragments;
    if (content.kind == FrameContent::Kind::Other) ++recording.other_packets;
    if (content.kind != FrameContent::Kind::Udp) return;
    CapturedDatagram& datagram = recording.datagrams.emplace_back();
    // The capture is opened with nanosecond times: tv_usec holds nanoseconds.
    datagram.time_ns = header.ts.tv_sec * kNanosecondsPerSecond + header.ts.tv_usec;
    datagram.source_address = content.udp.source_address;
    datagram.destination_address = content.udp.destination_address;
    datagram.source_port = content.udp.source_port;
    datagram.destination_port = content.udp.destination_port;
    datagram.payload.assign(content.udp.payload.begin(), content.udp.payload.end());
}

}  // namespace

tl::expected<PcapRecording, std::string> read_pcap(const std::filesystem::path& file) {
    std::array<char, PCAP_ERRBUF_SIZE> error{};
    const Capture capture(
        pcap_open_offline_with_tstamp_precision(file.c_str(), PCAP_TSTAMP_PRECISION_NANO, error.data()));
    if (!capture) {
        return tl::unexpected(
            fmt::format("cannot read {} as a pcap or pcapng capture: {}", file.string(), error.data()));
    }
    const int type = pcap_datalink(capture.get());
    const auto link_layer = link_layer_of(type);
    if (!link_layer) {
        const char* type_name = pcap_datalink_val_to_name(type);
        return tl::unexpected(
            fmt::format("{} was captured on link type {}, expected Ethernet, Linux cooked, raw IP or "
                        "BSD loopback",
                        file.string(), type_name != nullptr ? type_name : std::to_string(type)));
    }
    PcapRecording recording;
    pcap_pkthdr* header = nullptr;
    const u_char* bytes = nullptr;
    int result = 0;
    while ((result = pcap_next_ex(capture.get(), &header, &bytes)) == 1) {
        take_frame(recording, *header, bytes, *link_layer);
    }
    recording.truncated = result == PCAP_ERROR;
    return recording;
}

// The file under its temporary name.
struct PcapWriter::Output {
    std::filesystem::path file;
    std::filesystem::path unfinished;
    Capture format;
    pcap_dumper_t* dumper = nullptr;

    Output(std::filesystem::path final_place, Capture capture)
        : file(std::move(final_place)), unfinished(file), format(std::move(capture)) {
        unfinished += fmt::format(".{}.part", ::getpid());
    }
    Output(const Output&) = delete;
    Output& operator=(const Output&) = delete;
    ~Output() {
        if (dumper == nullptr) return;
        pcap_dump_close(dumper);
        std::error_code ignored;
        std::filesystem::remove(unfinished, ignored);
    }
    [[nodiscard]] tl::unexpected<std::string> failure() const {
        return tl::unexpected(fmt::format("cannot write {}: {}", file.string(), std::strerror(errno)));
    }
};

PcapWriter::PcapWriter(std::unique_ptr<Output> output) : output_(std::move(output)) {}
PcapWriter::PcapWriter(PcapWriter&&) noexcept = default;
PcapWriter& PcapWriter::operator=(PcapWriter&&) noexcept = default;
PcapWriter::~PcapWriter() = default;

tl::expected<PcapWriter, std::string> PcapWriter::create(const std::filesystem::path& file) {
    auto output =
        std::make_unique<Output>(file, Capture(pcap_open_dead_with_tstamp_precision(
                                           DLT_EN10MB, kSnapshotBytes, PCAP_TSTAMP_PRECISION_MICRO)));
    output->dumper = pcap_dump_open(output->format.get(), output->unfinished.c_str());
    if (output->dumper == nullptr) {
        return tl::unexpected(
            fmt::format("cannot write {}: {}", file.string(), pcap_geterr(output->format.get())));
    }
    return PcapWriter(std::move(output));
}

tl::expected<void, std::string> PcapWriter::write(const CapturedDatagram& datagram) {
    const auto frame = make_udp_frame({datagram.source_address, datagram.destination_address,
                                       datagram.source_port, datagram.destination_port, datagram.payload});
    if (!frame) {
        return tl::unexpected(fmt::format("a datagram of {} bytes is longer than UDP carries ({})",
                                          datagram.payload.size(), kMaxUdpPayloadBytes));
    }
    pcap_pkthdr header{};
    header.ts.tv_sec = datagram.time_ns / kNanosecondsPerSecond;
    header.ts.tv_usec = datagram.time_ns % kNanosecondsPerSecond / 1000;
    header.caplen = header.len = static_cast<bpf_u_int32>(frame->size());
    pcap_dump(reinterpret_cast<u_char*>(output_->dumper), &header,
              reinterpret_cast<const u_char*>(frame->data()));
    if (std::ferror(pcap_dump_file(output_->dumper)) != 0) return output_->failure();
    return {};
}

tl::expected<void, std::string> PcapWriter::finish() {
    std::FILE* stream = pcap_dump_file(output_->dumper);
    if (pcap_dump_flush(output_->dumper) != 0 || ::fsync(::fileno(stream)) != 0) return output_->failure();
    if (std::rename(output_->unfinished.c_str(), output_->file.c_str()) != 0) return output_->failure();
    pcap_dump_close(std::exchange(output_->dumper, nullptr));
    return {};
}

}  // namespace eyepoint::net
