/// Numbers as bytes by an adaptive binary range coder: a few dozen symbols already cost near their entropy,
/// where a general compressor's tables would cost more than they save (docs/database-format.md, "Range
/// coder"). After Martin, "Range encoding: an algorithm for removing redundancy from a digitised message",
/// 1979. Thread use: values; separate objects are independent.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace eyepoint::terrain {

/// How likely the next bit is 1, learnt from those before: the mean of a quick and a slow average.
class BitModel {
  public:
    /// In 1..kOne - 1, of kOne.
    [[nodiscard]] std::uint32_t probability() const { return (std::uint32_t{quick_} + slow_ + 1) >> 1; }
    void learn(bool bit);

    static constexpr int kBits = 15;
    static constexpr std::uint32_t kOne = 1U << kBits;

  private:
    std::uint16_t quick_ = kOne / 2;
    std::uint16_t slow_ = kOne / 2;
    std::uint8_t learnt_ = 0;
};

/// A model of whole numbers, small ones likely: how many binary digits number + 1 has, then those after the
/// first, the highest kModelled by models of their own (numbers of kLongDigits and more share theirs), the
/// rest as they are.
struct NumberModel {
    static constexpr std::size_t kModelled = 6;
    static constexpr std::size_t kLongDigits = 12;
    static constexpr std::size_t kMaxDigits = 63;
    std::array<BitModel, kMaxDigits> digits;
    std::array<std::array<BitModel, 1U << kModelled>, kLongDigits> mantissa;
};

class RangeEncoder {
  public:
    void bit(BitModel& model, bool value);
    /// Below 2^62.
    void number(NumberModel& model, std::uint64_t value);
    /// All bytes; the encoder is used up.
    [[nodiscard]] std::vector<std::uint8_t> finish();

  private:
    /// To a part of the range.
    void narrow(std::uint32_t start, std::uint32_t width);
    void even_bit(bool value);

    std::uint32_t low_ = 0;
    std::uint32_t range_ = 0xffffffff;
    std::vector<std::uint8_t> bytes_;
};

/// Any bytes may be given: what comes out of wrong ones are wrong numbers, below 2^63.
class RangeDecoder {
  public:
    explicit RangeDecoder(std::span<const std::uint8_t> bytes);

    [[nodiscard]] bool bit(BitModel& model);
    [[nodiscard]] std::uint64_t number(NumberModel& model);
    /// More was asked for than was written.
    [[nodiscard]] bool overrun() const { return missing_ > 0; }
    /// Everything written was asked for, and no more.
    [[nodiscard]] bool at_end() const { return missing_ == 0 && next_ == bytes_.size(); }

  private:
    [[nodiscard]] bool even_bit();
    void shift();

    std::span<const std::uint8_t> bytes_;
    std::size_t next_ = 0;
    std::size_t missing_ = 0;
    std::uint32_t code_ = 0;
    std::uint32_t range_ = 0xffffffff;
};

}  // namespace eyepoint::terrain
