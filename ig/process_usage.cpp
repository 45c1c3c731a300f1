#include "ig/process_usage.hpp"

#include <ctime>
#include <fstream>
#include <string>

#include <unistd.h>

namespace eyepoint::ig {

namespace {

double read_cpu_ms(clockid_t id) {
    timespec used{};
    clock_gettime(id, &used);
    return static_cast<double>(used.tv_sec) * 1e3 + static_cast<double>(used.tv_nsec) * 1e-6;
}

}  // namespace

double process_cpu_ms() { return read_cpu_ms(CLOCK_PROCESS_CPUTIME_ID); }

double thread_cpu_ms() { return read_cpu_ms(CLOCK_THREAD_CPUTIME_ID); }

std::uint64_t resident_bytes() {
    std::uint64_t all_pages = 0, resident_pages = 0;
    std::ifstream("/proc/self/statm") >> all_pages >> resident_pages;
    return resident_pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

// Not getrusage(): its figure starts at that of the process that called exec().
std::uint64_t peak_resident_bytes() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        std::uint64_t kib = 0;
        if (word == "VmHWM:" && status >> kib) return kib * 1024;
    }
    return 0;
}

}  // namespace eyepoint::ig
