#include "terrain/database/range_coder.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace eyepoint::terrain {

namespace {

constexpr std::uint32_t kSmallRange = 1U << 24;  ///< a byte is settled below it
constexpr int kQuickAfter = 16;                  ///< bits that the averages are of, roughly
constexpr int kSlowAfter = 128;

/// What share of the difference an average takes on after so many bits, of 2^16: that of a plain mean at
/// first.
constexpr auto kShares = [] {
    std::array<std::uint16_t, kSlowAfter> shares{};
    for (std::uint32_t n = 0; n < shares.size(); ++n)
        shares[n] = static_cast<std::uint16_t>((2U << 16) / (2 * n + 3));
    return shares;
}();

std::uint16_t moved(std::uint16_t average, bool bit, std::uint32_t share) {
    constexpr std::uint32_t kLeast = 16;
    const std::uint32_t towards = bit ? BitModel::kOne - kLeast - average : average - kLeast;
    const std::uint32_t step = (towards * share) >> 16;
    return static_cast<std::uint16_t>(bit ? average + step : average - step);
}

}  // namespace

void BitModel::learn(bool bit) {
    quick_ = moved(quick_, bit, kShares[std::min<std::size_t>(learnt_, kQuickAfter - 1)]);
    slow_ = moved(slow_, bit, kShares[learnt_]);
    if (learnt_ + 1 < kSlowAfter) ++learnt_;
}

void RangeEncoder::narrow(std::uint32_t start, std::uint32_t width) {
    low_ += start;
    if (low_ < start) {  // a carry into the bytes that are out already
        for (auto byte = bytes_.rbegin(); byte != bytes_.rend() && ++*byte == 0; ++byte) {
        }
    }
    range_ = width;
    for (; range_ < kSmallRange; range_ <<= 8, low_ <<= 8)
        bytes_.push_back(static_cast<std::uint8_t>(low_ >> 24));
}

void RangeEncoder::bit(BitModel& model, bool value) {
    const std::uint32_t ones = (range_ >> BitModel::kBits) * model.probability();
    value ? narrow(0, ones) : narrow(ones, range_ - ones);
    model.learn(value);
}

void RangeEncoder::even_bit(bool value) {
    const std::uint32_t half = range_ >> 1;
    value ? narrow(0, half) : narrow(half, range_ - half);
}

void RangeEncoder::number(NumberModel& model, std::uint64_t value) {
    const auto digits = static_cast<std::size_t>(std::bit_width(value + 1));
    for (std::size_t i = 1; i < digits; ++i) bit(model.digits[i - 1], true);
    if (digits < NumberModel::kMaxDigits) bit(model.digits[digits - 1], false);
    auto& mantissa = model.mantissa[std::min(digits, NumberModel::kLongDigits) - 1];
    std::size_t node = 1;
    for (std::size_t i = 1; i < digits; ++i) {
        const bool digit = ((value + 1) >> (digits - 1 - i) & 1U) != 0;
        if (i > NumberModel::kModelled) {
            even_bit(digit);
            continue;
        }
        bit(mantissa[node], digit);
        node = 2 * node + (digit ? 1 : 0);
    }
}

std::vector<std::uint8_t> RangeEncoder::finish() {
    for (int i = 0; i < 4; ++i, low_ <<= 8) bytes_.push_back(static_cast<std::uint8_t>(low_ >> 24));
    return std::move(bytes_);
}

RangeDecoder::RangeDecoder(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
    for (int i = 0; i < 4; ++i) shift();
}

void RangeDecoder::shift() {
    code_ <<= 8;
    if (next_ < bytes_.size()) {
        code_ |= bytes_[next_++];
    } else {
        ++missing_;
    }
}

bool RangeDecoder::bit(BitModel& model) {
    const std::uint32_t ones = (range_ >> BitModel::kBits) * model.probability();
    const bool value = code_ < ones;
    if (!value) code_ -= ones;
    range_ = value ? ones : range_ - ones;
    for (; range_ < kSmallRange; range_ <<= 8) shift();
    model.learn(value);
    return value;
}

bool RangeDecoder::even_bit() {
    const std::uint32_t half = range_ >> 1;
    const bool value = code_ < half;
    if (!value) code_ -= half;
    range_ = value ? half : range_ - half;
    for (; range_ < kSmallRange; range_ <<= 8) shift();
    return value;
}

std::uint64_t RangeDecoder::number(NumberModel& model) {
    std::size_t digits = 1;
    while (digits < NumberModel::kMaxDigits && bit(model.digits[digits - 1])) ++digits;
    auto& mantissa = model.mantissa[std::min(digits, NumberModel::kLongDigits) - 1];
    std::uint64_t value = 1;
    std::size_t node = 1;
    for (std::size_t i = 1; i < digits; ++i) {
        const bool digit = i > NumberModel::kModelled ? even_bit() : bit(mantissa[node]);
        if (i <= NumberModel::kModelled) node = 2 * node + (digit ? 1U : 0U);
        value = value << 1 | (digit ? 1U : 0U);
    }
    return value - 1;
}

}  // namespace eyepoint::terrain
